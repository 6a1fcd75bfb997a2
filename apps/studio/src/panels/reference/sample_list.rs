//! The list of marked samples below the picture.

use eframe::egui::Role;
use eframe::egui::{
    Button, Label, RichText, ScrollArea, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2,
};

use super::super::context::PanelContext;
use super::super::controls::{button, named_button};
use super::command::sample_command;
use super::next_step::next_step;
use super::overlay::screen_color;
use super::state::Reference;
use crate::files::{DrawingKind, FileRequest};
use crate::keymap::hint;
use crate::language::{tr, tr_format};
use crate::theme;

/// Width of the figure and the button at the right of a sample, in points.
const RIGHT: f32 = 104.0;

impl Reference {
    /// Draws the list of samples with its buttons.
    pub(super) fn sample_list(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let (Some(path), Some(picture)) = (self.path.clone(), &self.picture) else { return };
        let size = picture.file_size();
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            for (spacing, name, tip) in [
                (false, tr("Scribble"), tr("A line over a passage is a new sample; a click selects one")),
                (
                    true,
                    tr("Spacing"),
                    tr("A line between the middles of two neighbouring strokes, or a click on each, \
                     tells how far apart the strokes of the selected sample are; also with Shift"),
                ),
            ] {
                let chosen = Button::selectable(self.spacing == spacing, name);
                if ui.add(chosen).on_hover_text(tip).clicked() {
                    (self.spacing, self.first_place) = (spacing, None);
                }
            }
            let nothing = (!self.samples.can_undo()).then_some(tr("There is no mark to undo"));
            let tip = tr_format!("Undoes the last mark{hint}", hint = hint(ui.ctx(), "undo"));
            if named_button(ui, tr("Undo"), tr("Undo mark"), &tip, nothing) {
                self.undo();
            }
            let empty = self.samples.marks().is_empty().then_some(tr("There is no mark to save"));
            if button(ui, tr("Save marks\u{2026}"), tr("Saves the marks beside the picture"), empty) {
                cx.file(FileRequest::SaveDrawing(self.samples.drawn(&path)));
            }
            if button(ui, tr("Open marks\u{2026}"), tr("Opens a file of marks for this picture"), None) {
                cx.file(FileRequest::OpenDrawing(DrawingKind::Marks, path.clone()));
            }
        });
        if self.samples.marks().is_empty() {
            ui.label(RichText::new(tr("Draw a line over a passage whose strokes you like")).weak());
        }
        if let Some(fault) = self.samples.fault() {
            ui.label(RichText::new(&fault.text).color(theme::colors(ui.ctx()).strong));
            ui.label(RichText::new(fault.hint.as_deref().unwrap_or_default()).weak());
        } else if let Some(file) = self.samples.file() {
            next_step(ui, tr("Takes the samples"), &sample_command(&path, file));
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let mut removed = None;
            for index in 0..self.samples.marks().len() {
                if self.sample_row(ui, index, size) {
                    removed = Some(index);
                }
            }
            if let Some(index) = removed {
                self.renaming = None;
                self.samples.remove(index, size);
            }
        });
    }

    /// Draws the row of a sample. Returns whether it is to be removed.
    fn sample_row(&mut self, ui: &mut Ui, index: usize, size: [usize; 2]) -> bool {
        let mark = &self.samples.marks()[index];
        let name = mark.name.clone();
        let spacing = mark.spacing_px();
        ui.horizontal(|ui| {
            if patch(ui, &name, index, index == self.samples.selected) {
                self.samples.selected = index;
            }
            self.name_field(ui, index, &name, size);
            let (words, tip) = match spacing {
                Some(px) => (format!("{px:.1} px"), tr("Distance of neighbouring strokes")),
                None => {
                    (tr("estimated").to_owned(), tr("The distance of strokes will be estimated"))
                }
            };
            ui.add_sized(vec2(62.0, 18.0), Label::new(RichText::new(words).weak()))
                .on_hover_text(tip);
            let delete = tr_format!("Delete {name}", name);
            named_button(ui, "\u{d7}", &delete, tr("Removes the sample"), None)
        })
        .inner
    }

    /// Draws the field in which a sample is renamed.
    fn name_field(&mut self, ui: &mut Ui, index: usize, name: &str, size: [usize; 2]) {
        let own = self.renaming.take_if(|(renamed, _)| *renamed == index);
        let mut typed = own.map_or_else(|| name.to_owned(), |(_, typed)| typed);
        let width = (ui.available_width() - RIGHT).max(40.0);
        let field = ui.add(theme::text_field(&mut typed).desired_width(width));
        let field = field.on_hover_text(tr("Name of the sample, different from all others"));
        if field.gained_focus() {
            self.samples.selected = index;
        }
        if field.has_focus() {
            self.renaming = Some((index, typed));
        } else if field.lost_focus() && typed.trim() != name {
            // A name that another sample has is not taken.
            self.samples.rename(index, &typed, size);
        }
    }
}

/// Draws the colour of a sample as a button. Returns whether it was clicked.
fn patch(ui: &mut Ui, name: &str, index: usize, selected: bool) -> bool {
    let (rect, response) =
        ui.allocate_exact_size(theme::at_least(ui, vec2(20.0, 20.0)), Sense::click());
    let words = tr_format!("Select {name}", name);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, selected, &words));
    let width = if selected { 2.0 } else { 0.0 };
    let edge = Stroke::new(width, theme::colors(ui.ctx()).strong);
    ui.painter().rect(rect.shrink(2.0), 2, screen_color(index), edge, StrokeKind::Outside);
    response.on_hover_text(tr("Selects the sample; Spacing is for the selected one")).clicked()
}
