//! The whole dialog.

use eframe::egui::{Context, Grid, Image, RichText, Ui, vec2};

use super::answer::NewAnswer;
use super::dialog::NewDialog;
use super::preview::CELLS;
use crate::files::dialogs::{Choice, dialog, grid_row};
use crate::files::new_canvas::KeptCanvases;
use crate::language::{tr, tr_format};
use crate::theme;

/// Width of the dialog in points.
const WIDTH: f32 = 760.0;

/// Width of the settings in points.
const SETTINGS: f32 = 476.0;

impl NewDialog {
    /// Shows the dialog.
    pub(in crate::files) fn show(
        &mut self,
        ctx: &Context,
        kept: &mut KeptCanvases,
    ) -> Option<NewAnswer> {
        self.update(ctx);
        let begin = (tr("Begin"), tr("Begins to paint on the new canvas (Enter)"));
        let mut answer = None;
        let choice = dialog(ctx, tr("New painting"), begin, None, |ui| {
            ui.set_width(WIDTH.min(ctx.content_rect().width() - 40.0));
            ui.horizontal_top(|ui| {
                ui.vertical(|ui| {
                    ui.set_width(SETTINGS);
                    let grid = Grid::new("new painting").num_columns(2).spacing([12.0, 7.0]);
                    grid.show(ui, |ui| {
                        grid_row(ui, tr("Preset"), |ui| self.preset_row(ui, kept));
                        self.size_rows(ui);
                        answer = self.ground_rows(ui);
                        grid_row(ui, tr("Pigments"), |ui| self.pigments(ui));
                    });
                });
                ui.vertical(|ui| self.ground_picture(ui));
            });
            self.size_line(ui);
        });
        match choice {
            Some(Choice::Yes) if self.new.fits() => Some(NewAnswer::Begin),
            Some(Choice::Yes) | None => answer,
            Some(Choice::No | Choice::Cancelled) => Some(NewAnswer::Cancelled),
        }
    }

    fn pigments(&mut self, ui: &mut Ui) {
        let same = &mut self.new.same_pigments;
        ui.radio_value(same, true, tr("As now"))
            .on_hover_text(tr("Keeps the library and the tubes"));
        let oils = ui.radio_value(same, false, tr("Van Gogh's oils"));
        oils.on_hover_text(tr("The library that comes with the program"));
    }

    /// The lit piece of the ground.
    fn ground_picture(&self, ui: &mut Ui) {
        let room = vec2(CELLS[0] as f32, CELLS[1] as f32);
        let (rect, _) = ui.allocate_exact_size(room, eframe::egui::Sense::hover());
        ui.painter().rect_filled(rect, 0.0, theme::SURROUND);
        if let Some(texture) = &self.preview.texture {
            let size = texture.size_vec2();
            let place = eframe::egui::Rect::from_center_size(rect.center(), size.min(room));
            let alt = Image::from_texture(texture).alt_text(tr("Piece of the ground"));
            ui.put(place, alt.fit_to_exact_size(place.size()));
        }
        let text = match (&self.preview.problem, self.new.kind()) {
            (Some(problem), _) => problem.text.clone(),
            (None, Some(_)) => {
                let mm = self.new.canvas.cell_mm * CELLS[0] as f64;
                tr_format!("{mm:.1} mm of the ground in the light of the painting", mm)
            }
            (None, None) => tr("The whole canvas in the light of the painting").to_owned(),
        };
        ui.label(RichText::new(text).weak().small());
    }
}
