//! The list of guides below the picture.

use eframe::egui::{Button, DragValue, RichText, ScrollArea, Ui};

use super::super::context::PanelContext;
use super::super::controls::{button, named_button};
use super::command::paint_command;
use super::next_step::next_step;
use super::state::Reference;
use crate::files::{DrawingKind, FileRequest};
use crate::keymap::hint;
use crate::language::{tr, tr_format};

impl Reference {
    /// Draws the list of guides with its buttons.
    pub(super) fn guide_list(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let (Some(path), Some(picture)) = (self.path.clone(), &self.picture) else { return };
        let size = picture.file_size();
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            let nothing = (!self.combing.can_undo()).then_some(tr("There is no guide to undo"));
            let tip = &tr_format!("Undoes the last guide{hint}", hint = hint(ui.ctx(), "undo"));
            if named_button(ui, tr("Undo"), tr("Undo guide"), tip, nothing) {
                self.undo();
            }
            let empty =
                self.combing.combed().lines.is_empty().then_some(tr("There is no guide to save"));
            if button(
                ui,
                tr("Save guides\u{2026}"),
                tr("Saves the guides beside the picture"),
                empty,
            ) {
                cx.file(FileRequest::SaveDrawing(self.combing.drawn(&path, size)));
            }
            if button(
                ui,
                tr("Open guides\u{2026}"),
                tr("Opens a file of guides for this picture"),
                None,
            ) {
                cx.file(FileRequest::OpenDrawing(DrawingKind::Guides, path.clone()));
            }
        });
        self.camera_row(ui);
        if self.combing.combed().lines.is_empty() {
            let words = tr("Draw lines as strokes should run, from their start to their end");
            ui.label(RichText::new(words).weak());
        }
        if let Some(file) = self.combing.file() {
            let command = paint_command(&path, self.combing.combed().camera, file);
            next_step(ui, tr("Paints along the guides"), &command);
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let mut removed = None;
            for index in 0..self.combing.combed().lines.len() {
                if self.guide_row(ui, index) {
                    removed = Some(index);
                }
            }
            if let Some(index) = removed {
                self.combing.remove(index);
            }
        });
    }

    /// Draws the camera of a view of a model.
    fn camera_row(&mut self, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            let camera = self.combing.combed().camera;
            let mut is_view = camera.is_some();
            let view = ui.checkbox(&mut is_view, tr("View of a model"));
            let tip =
                tr("The picture shows a model, seen from the camera that it was painted with");
            if view.on_hover_text(tip).changed() {
                self.combing.set_view(is_view);
            }
            let Some(mut camera) = camera.filter(|_| is_view) else { return };
            let mut changed = false;
            let [around, above, view] = &mut camera;
            for (value, range, name, tip) in [
                (
                    around,
                    -360.0..=360.0,
                    tr("around"),
                    tr("Degrees around the model, 0 from the front"),
                ),
                (above, -90.0..=90.0, tr("above"), tr("Degrees above the horizon")),
                (view, 1.0..=170.0, tr("view"), tr("Angle of the field of view in degrees")),
            ] {
                let drag = DragValue::new(value).range(range).speed(1.0).max_decimals(1);
                let drag = ui.add(drag.prefix(format!("{name} ")).suffix("\u{b0}"));
                changed |= drag.on_hover_text(tip).changed();
            }
            if changed {
                self.combing.set_camera(camera);
            }
        });
    }

    /// Draws the row of a guide. Returns whether it is to be removed.
    fn guide_row(&mut self, ui: &mut Ui, index: usize) -> bool {
        let line = &self.combing.combed().lines[index];
        let lengths = line.windows(2).map(|ends| {
            let [[x, y], [to_x, to_y]] = [ends[0], ends[1]];
            (to_x - x).hypot(to_y - y)
        });
        let length: f64 = lengths.sum();
        let number = index + 1;
        ui.horizontal(|ui| {
            let chosen = Button::selectable(
                self.combing.selected == index,
                tr_format!("Guide {number}, {length:.0} px", number, length),
            );
            if ui.add(chosen).on_hover_text(tr("Selects the guide")).clicked() {
                self.combing.selected = index;
            }
            let name = tr_format!("Reverse guide {number}", number);
            let tip = tr("Strokes flow the other way");
            if named_button(ui, tr("Reverse"), &name, tip, None) {
                self.combing.reverse(index);
            }
            named_button(
                ui,
                "\u{d7}",
                &tr_format!("Delete guide {number}", number),
                tr("Removes the guide"),
                None,
            )
        })
        .inner
    }
}
