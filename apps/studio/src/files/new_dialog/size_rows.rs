//! Rows of the dialog for format, size and cells.

use eframe::egui::{Button, ComboBox, DragValue, RichText, Ui, Vec2};

use super::dialog::NewDialog;
use super::memory::in_mib;
use crate::files::dialogs::grid_row;
use crate::files::new_canvas::{FORMATS, Format, LengthUnit, MAX_CELLS, SIDE_MM};
use crate::language::{tr, tr_format};
use crate::theme;

impl NewDialog {
    /// Adds the rows for format, size and cells.
    pub(super) fn size_rows(&mut self, ui: &mut Ui) {
        grid_row(ui, tr("Format"), |ui| self.format(ui));
        grid_row(ui, tr("Size"), |ui| {
            let unit = self.new.unit;
            let canvas = &mut self.new.canvas;
            side(ui, tr("Width"), unit, &mut canvas.width_mm);
            ui.label("x");
            side(ui, tr("Height"), unit, &mut canvas.height_mm);
            for unit in LengthUnit::ALL {
                let tip = tr("Unit of the size");
                let chosen = self.new.unit == unit;
                let button = Button::selectable(chosen, unit.sign())
                    .min_size(theme::at_least(ui, Vec2::ZERO));
                if ui.add(button).on_hover_text(tip).clicked() {
                    self.new.unit = unit;
                }
            }
        });
        grid_row(ui, tr("Cell"), |ui| {
            let drag = DragValue::new(&mut self.new.canvas.cell_mm).range(0.02..=2.0).speed(0.01);
            let tip = tr("Width of a cell; 0.1 mm is 254 per inch. Smaller is finer and slower");
            let drag = ui.add(drag.suffix(" mm")).accessible_name(tr("Width of a cell"));
            drag.on_hover_text(tip);
            let (width, height) = self.new.canvas.cells();
            let millions = self.new.cell_count() as f64 / 1e6;
            ui.label(tr_format!(
                "{width} x {height} cells, {millions:.1} million",
                width,
                height,
                millions
            ));
        });
        grid_row(ui, tr("Memory"), |ui| {
            let [canvas, layer] = self.new.memory().map(in_mib);
            ui.label(tr_format!("{canvas}, and {layer} for each dry layer", canvas, layer));
        });
    }

    fn format(&mut self, ui: &mut Ui) {
        let canvas = &self.new.canvas;
        let current = Format::of(canvas.width_mm, canvas.height_mm);
        let shown = current.map_or(tr("Own size"), |format| tr(format.name));
        let combo = ComboBox::from_id_salt("format").selected_text(shown).width(150.0);
        let combo = combo.show_ui(ui, |ui| {
            let mut group = "";
            for format in &FORMATS {
                if format.group != group {
                    group = format.group;
                    ui.label(RichText::new(tr(group)).weak().small());
                }
                let mm = format!("{} x {} mm", format.short_mm, format.long_mm);
                let row = ui.selectable_label(current == Some(format), tr(format.name));
                if row.on_hover_text(mm).clicked() {
                    self.new.set_format(format);
                }
            }
        });
        combo
            .response
            .accessible_name(tr("Format of the canvas"))
            .on_hover_text(tr("Paper and canvases by name"));
        let upright = self.new.is_upright();
        for (own, name, tip) in [
            (true, tr("Portrait"), tr("Higher than wide")),
            (false, tr("Landscape"), tr("Wider than high")),
        ] {
            if ui.selectable_label(upright == own, name).on_hover_text(tip).clicked() {
                self.new.set_upright(own);
            }
        }
    }

    /// A warning about the size, if there is one.
    pub(super) fn size_problem(&self) -> Option<String> {
        if !self.new.fits() {
            return Some(tr_format!(
                "Too many cells: at most {most} million. Choose larger cells or a smaller size.",
                most = MAX_CELLS / 1_000_000
            ));
        }
        let [canvas, layer] = self.new.memory();
        let free = self.free_bytes.filter(|free| *free < canvas + layer)?;
        let free = in_mib(free);
        Some(tr_format!("With one layer this needs more memory than is free now, {free}.", free))
    }

    /// Draws the problem of the size in a line that is always there.
    pub(super) fn size_line(&self, ui: &mut Ui) {
        let text = self.size_problem().unwrap_or_default();
        ui.label(RichText::new(text).strong().color(theme::colors(ui.ctx()).strong));
    }
}

fn side(ui: &mut Ui, name: &str, unit: LengthUnit, mm: &mut f64) {
    let [least, most] = SIDE_MM.map(|side| side / unit.in_mm());
    let mut value = *mm / unit.in_mm();
    let decimals = if unit == LengthUnit::Mm { 1 } else { 2 };
    let drag = DragValue::new(&mut value).range(least..=most).max_decimals(decimals);
    let drag = ui.add(drag.speed(1.0 / unit.in_mm())).accessible_name(name);
    if drag.on_hover_text(tr_format!("{name} of the canvas", name)).changed() {
        *mm = value * unit.in_mm();
    }
}
