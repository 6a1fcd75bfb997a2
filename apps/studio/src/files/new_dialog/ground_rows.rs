//! Rows of the dialog for the ground: its kind, relief and colour.

use std::path::Path;

use eframe::egui::{Color32, ComboBox, DragValue, Sense, Ui, vec2};
use paint::ground::{GroundKind, GroundRelief, PaperFinish, Primer, TonedPrimer};

use super::answer::{CanvasPicture, NewAnswer};
use super::dialog::NewDialog;
use super::mixture_rows;
use crate::files::dialogs::grid_row;
use crate::files::new_canvas::{TONES, Tone};
use crate::files::work::file_name;
use crate::language::tr;

impl NewDialog {
    /// Adds the rows for the ground. Returns a request for a picture.
    pub(super) fn ground_rows(&mut self, ui: &mut Ui) -> Option<NewAnswer> {
        let mut answer = None;
        grid_row(ui, tr("Ground"), |ui| answer = self.kind(ui));
        grid_row(ui, tr("Relief"), |ui| self.relief(ui));
        grid_row(ui, tr("Colour"), |ui| self.tone(ui));
        self.own_tone(ui);
        grid_row(ui, tr("First layer"), |ui| {
            let chosen = self.first_layer(ui);
            answer = answer.or(chosen);
        });
        answer
    }

    fn kind(&mut self, ui: &mut Ui) -> Option<NewAnswer> {
        for (kind, name, tip) in [
            (GroundKind::Linen, tr("Linen"), tr("Primed linen in plain weave")),
            (GroundKind::Panel, tr("Panel"), tr("A primed panel, nearly flat")),
            (GroundKind::Paper, tr("Paper"), tr("Watercolour paper")),
            (GroundKind::Wood, tr("Wood"), tr("Varnished walnut")),
        ] {
            let chosen = self.new.kind() == Some(kind);
            if ui.selectable_label(chosen, name).on_hover_text(tip).clicked() && !chosen {
                self.new.set_kind(kind);
            }
        }
        let own = self.new.kind().is_none();
        let picture =
            ui.selectable_label(own, tr("Picture\u{2026}")).accessible_name(tr("Relief picture"));
        let tip = tr("Takes the relief from the greys of a picture, white the highest");
        picture.on_hover_text(tip).clicked().then_some(NewAnswer::Choose(CanvasPicture::Relief))
    }

    fn relief(&mut self, ui: &mut Ui) {
        let most = if self.new.kind().is_none() { 20.0 } else { 2.0 };
        let drag = DragValue::new(self.new.relief_mm()).range(0.0..=most).speed(0.005);
        let drag =
            ui.add(drag.max_decimals(3).suffix(" mm")).accessible_name(tr("Height of the relief"));
        drag.on_hover_text(tr("From the hollows of the ground to its heights"));
        if let GroundRelief::Linen(linen) = &mut self.new.canvas.ground.relief {
            let drag = DragValue::new(&mut linen.threads_per_cm).range(2.0..=60.0).speed(0.1);
            let drag = ui.add(drag.max_decimals(1).suffix(tr(" threads/cm")));
            drag.accessible_name(tr("Threads")).on_hover_text(tr("8 is coarse, 14 usual, 25 fine"));
        }
        if let GroundRelief::Paper(paper) = &mut self.new.canvas.ground.relief {
            for (finish, name) in [
                (PaperFinish::Rough, tr("Rough")),
                (PaperFinish::ColdPressed, tr("Cold")),
                (PaperFinish::HotPressed, tr("Hot")),
            ] {
                let tip = tr("How it was pressed; this sets the height of its relief");
                if ui.selectable_label(paper.finish == finish, name).on_hover_text(tip).clicked() {
                    (paper.finish, paper.relief_mm) = (finish, finish.relief_mm());
                }
            }
        }
        if let GroundRelief::Image(picture) = &self.new.canvas.ground.relief {
            ui.weak(file_name(Path::new(&picture.path))).on_hover_text(&picture.path);
        }
        if let Some(seed) = self.new.seed() {
            let drag = ui.add(DragValue::new(seed).prefix(tr("seed "))).accessible_name(tr("Seed"));
            drag.on_hover_text(tr("Each number gives another piece of the same ground"));
        }
    }

    fn tone(&mut self, ui: &mut Ui) {
        let library = self.own_library().clone();
        let colors: [Option<[u8; 3]>; TONES.len()] =
            std::array::from_fn(|index| self.tone_color(index));
        let primer = &mut self.new.canvas.ground.reflectance;
        let tone = Tone::of(primer.as_ref());
        let shown = match (tone, &primer) {
            (Some(tone), _) => tr(tone.name),
            (None, Some(Primer::Toned(_))) => tr("Own film"),
            (None, _) => tr("Plain colour"),
        };
        let combo = ComboBox::from_id_salt("tone").selected_text(shown).width(170.0);
        let combo = combo.show_ui(ui, |ui| {
            for (own, color) in TONES.iter().zip(colors) {
                let there = own.is_in(&library);
                let row = ui.add_enabled_ui(there, |ui| {
                    ui.horizontal(|ui| {
                        swatch(ui, color);
                        ui.selectable_label(tone == Some(own), tr(own.name))
                    })
                    .inner
                });
                if row.inner.on_hover_text(tr(own.description)).clicked() {
                    *primer = own.primer();
                }
            }
            let own_film = matches!(primer, Some(Primer::Toned(_))) && tone.is_none();
            let row = ui.selectable_label(own_film, tr("Own film"));
            let tip = tr("A film of pigments of your own; begins with the tone that is chosen");
            if row.on_hover_text(tip).clicked() && !own_film {
                *primer = match primer.take() {
                    Some(Primer::Toned(mut toned)) => {
                        // So that it is no longer the tone of that name.
                        toned.film.height_mm *= 1.01;
                        Some(Primer::Toned(toned))
                    }
                    _ => mixture_rows::first_film(&library),
                };
            }
            let row = ui.selectable_label(shown == tr("Plain colour"), tr("Plain colour"));
            if row.on_hover_text(tr("Any colour, without pigments")).clicked() {
                *primer = Some(mixture_rows::first_color());
            }
        });
        combo
            .response
            .accessible_name(tr("Colour of the ground"))
            .on_hover_text(tone.map_or(tr("Colour of the priming"), |tone| tone.description));
    }

    /// Adds rows for a colour of the painter's own.
    fn own_tone(&mut self, ui: &mut Ui) {
        let library = self.own_library().clone();
        let primer = &mut self.new.canvas.ground.reflectance;
        let named = Tone::of(primer.as_ref()).is_some();
        match primer {
            Some(Primer::Toned(TonedPrimer { film })) if !named => {
                mixture_rows::film_rows(ui, film, &library);
            }
            Some(Primer::Color(color)) => mixture_rows::color_row(ui, color),
            _ => {}
        }
    }

    fn first_layer(&mut self, ui: &mut Ui) -> Option<NewAnswer> {
        let tip = tr("Lays the colours of a picture as a thin dry layer, mixed of the tubes");
        let choose = match &self.new.first_layer {
            None => {
                ui.weak(tr("none"));
                ui.button(tr("Picture\u{2026}")).accessible_name(tr("First layer picture"))
            }
            Some(path) => {
                let name = file_name(path);
                ui.add(eframe::egui::Label::new(name).truncate())
                    .on_hover_text(path.display().to_string());
                if ui.button(tr("Remove")).on_hover_text(tr("Begins without a layer")).clicked() {
                    self.new.first_layer = None;
                }
                ui.button(tr("Other\u{2026}")).accessible_name(tr("First layer picture"))
            }
        };
        choose.on_hover_text(tip).clicked().then_some(NewAnswer::Choose(CanvasPicture::FirstLayer))
    }
}

/// Draws a small field of a colour; empty while it is not known.
fn swatch(ui: &mut Ui, color: Option<[u8; 3]>) {
    let side = ui.spacing().interact_size.y - 4.0;
    let (rect, _) = ui.allocate_exact_size(vec2(1.4 * side, side), Sense::hover());
    if let Some([red, green, blue]) = color {
        ui.painter().rect_filled(rect, 2.0, Color32::from_rgb(red, green, blue));
    }
}
