//! Draws the eyedropper panel.

use std::path::Path;
use std::sync::Arc;

use documents::file::disk;
use eframe::egui::{Align2, DragValue, Key, Ui, vec2};
use spectra::swatch_file::{SwatchFile, SwatchFileError, read_aco, read_ase, read_gpl};

use super::super::context::PanelContext;
use super::super::tools::Mode;
use super::picked::show_picked;
use super::search::SearchPanel;
use super::swatch::swatch;
use super::target::{Color, TargetColor};
use crate::language::{tr, tr_format};
use crate::theme;

/// State of the eyedropper panel: target colour, swatches and recipe search.
#[derive(Debug, Default)]
pub struct Eyedropper {
    target: Option<TargetColor>,
    /// Colour of the reference picture that was last made the target.
    last_reference_color: Option<[f64; 3]>,
    text: String,
    fault: Option<String>,
    swatches: Vec<TargetColor>,
    search: SearchPanel,
}

impl Eyedropper {
    /// Whether a file holds colour swatches, by its extension: `.gpl`, `.ase`, `.aco`.
    #[must_use]
    pub fn takes(path: &Path) -> bool {
        reader(path).is_some()
    }

    /// Loads the swatches of another painting program's palette. An error is shown in
    /// the panel.
    pub fn open_swatches(&mut self, path: &Path) {
        self.fault = None;
        match colors(path) {
            Ok(palette) => self.swatches = wanted_of(&palette),
            Err(fault) => self.fault = Some(fault),
        }
    }

    /// Shows colours of another painting program as targets.
    pub fn set_swatches(&mut self, colors: &SwatchFile) {
        self.swatches = wanted_of(colors);
    }

    /// Target colour of the recipe search.
    #[must_use]
    pub fn target(&self) -> Option<&TargetColor> {
        self.target.as_ref()
    }

    /// Makes a colour the target and searches recipes for it.
    pub fn set_target(&mut self, ui: &Ui, cx: &PanelContext<'_>, wanted: TargetColor) {
        self.search.begin(ui, cx.painting, &wanted);
        self.target = Some(wanted);
        self.fault = None;
    }

    /// Draws the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        if cx.tools.reference_color != self.last_reference_color {
            self.last_reference_color = cx.tools.reference_color;
            if let Some(linear) = self.last_reference_color {
                self.set_target(
                    ui,
                    cx,
                    TargetColor::screen(tr("From the reference picture"), linear),
                );
            }
        }
        pick_controls(ui, cx);
        match cx.tools.picked.clone() {
            None => {
                ui.weak(tr(
                    "Click with the eyedropper, or with Alt held, to pick colour and paint.",
                ));
            }
            Some(picked) => {
                if show_picked(ui, cx, &picked) {
                    let name = tr_format!(
                        "Picked at {x_mm:.1}, {y_mm:.1} mm",
                        x_mm = picked.x_mm,
                        y_mm = picked.y_mm
                    );
                    let color = Color::Reflectance(Arc::new(picked.reflectance.clone()));
                    self.set_target(ui, cx, TargetColor { name, color });
                }
            }
        }
        ui.separator();
        self.target_row(ui, cx);
        self.search.show(ui, cx, self.target.as_ref());
    }

    fn target_row(&mut self, ui: &mut Ui, cx: &PanelContext<'_>) {
        let grid = cx.painting.library.grid;
        let viewing = &cx.painting.light.viewing;
        ui.horizontal(|ui| {
            if let Some(wanted) = &self.target {
                let color = wanted.shown(grid, viewing);
                let patch = swatch(ui, tr("Target colour"), vec2(40.0, 22.0), &[color]);
                let [l, a, b] = wanted.lab(grid, viewing).to_array();
                patch.on_hover_text(format!("{}: Lab {l:.2} {a:.2} {b:.2}", wanted.name));
            }
            let field = theme::text_field(&mut self.text)
                .hint_text(tr("Target: #rrggbb or L,a,b"))
                .desired_width(f32::INFINITY)
                .align(Align2::LEFT_CENTER);
            let field = ui.add(field).on_hover_text(
                tr("Target colour: sRGB as #rrggbb, or CIELAB as L,a,b under the light of the \
                 painting. Enter searches recipes for it"),
            );
            if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
                match TargetColor::from_text(&self.text) {
                    Some(wanted) => self.set_target(ui, cx, wanted),
                    None => {
                        let found = self.text.trim();
                        self.fault = Some(tr_format!("A colour is #rrggbb or L,a,b, found `{found}`; try #4a7d8c or 52,-10,8", found));
                    }
                }
            }
        });
        if let Some(wanted) = &self.target {
            ui.weak(&wanted.name).on_hover_text(tr("Origin of the target colour"));
        }
        if let Some(fault) = &self.fault {
            ui.label(fault);
        }
        self.swatch_rows(ui, cx);
    }

    fn swatch_rows(&mut self, ui: &mut Ui, cx: &PanelContext<'_>) {
        if self.swatches.is_empty() {
            return;
        }
        let grid = cx.painting.library.grid;
        let viewing = &cx.painting.light.viewing;
        let mut clicked = None;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(3.0, 3.0);
            for one in &self.swatches {
                let color = one.shown(grid, viewing);
                let patch = swatch(ui, &one.name, vec2(18.0, 18.0), &[color]);
                let hover = tr_format!("{name}. Click to search recipes for it", name = one.name);
                if patch.on_hover_text(hover).clicked() {
                    clicked = Some(one.clone());
                }
            }
        });
        if let Some(wanted) = clicked {
            self.set_target(ui, cx, wanted);
        }
    }
}

fn pick_controls(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    ui.horizontal(|ui| {
        let picking = cx.tools.mode == Mode::Pick;
        let pick = ui.selectable_label(picking, tr("Eyedropper"));
        if pick.on_hover_text(tr("A click picks colour and paint; also with Alt held")).clicked() {
            cx.tools.mode = if picking { Mode::Paint } else { Mode::Pick };
        }
        let radius = DragValue::new(&mut cx.tools.pick_radius_mm)
            .range(0.0..=10.0)
            .speed(0.02)
            .fixed_decimals(1)
            .prefix(tr("radius "))
            .suffix(" mm");
        let radius = ui.add(radius).accessible_name(tr("Radius of the eyedropper"));
        radius.on_hover_text(tr("Radius of the averaged disc; 0 is one cell"));
    });
}

type Reader = fn(&str, &[u8]) -> Result<SwatchFile, SwatchFileError>;

fn reader(path: &Path) -> Option<Reader> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    match ending.as_str() {
        "gpl" => Some(read_gpl),
        "ase" => Some(read_ase),
        "aco" => Some(read_aco),
        _ => None,
    }
}

fn colors(path: &Path) -> Result<SwatchFile, String> {
    let name = path.display().to_string();
    let reader = reader(path)
        .ok_or_else(|| tr_format!("{name}: expected a .gpl, .ase or .aco file", name))?;
    let bytes = disk::read(path).map_err(|error| format!("{name}: {error}"))?;
    reader(&name, &bytes).map_err(|error| error.to_string())
}

/// Converts swatches to target colours. Spot inks without a colour are skipped.
fn wanted_of(palette: &SwatchFile) -> Vec<TargetColor> {
    let swatches = palette.swatches.iter();
    let wanted = swatches.filter_map(|one| {
        let rgb = one.color.srgb()?;
        let name = if one.name.is_empty() { rgb.to_hex() } else { one.name.clone() };
        Some(TargetColor::screen(&name, rgb.linear().0))
    });
    wanted.collect()
}
