//! The column of places and recent files.

use std::path::Path;

use eframe::egui::{Button, RichText, ScrollArea, Ui, vec2};

use super::places::PlaceKind;
use super::state::{Answer, Browser};
use crate::language::tr;

/// Width of the column, in points.
pub(super) const WIDTH: f32 = 160.0;

impl Browser {
    /// Draws the column; a click opens the folder, or chooses the file.
    pub(super) fn places_view(&mut self, ui: &mut Ui, height: f32) -> Option<Answer> {
        ui.set_width(WIDTH);
        let mut answer = None;
        ScrollArea::vertical().id_salt("places").max_height(height).auto_shrink(false).show(
            ui,
            |ui| {
                self.folders(ui);
                answer = self.recent_files(ui);
            },
        );
        answer
    }

    fn folders(&mut self, ui: &mut Ui) {
        let mut kind = PlaceKind::Own;
        for place in self.places.clone() {
            if place.kind != kind {
                kind = place.kind;
                heading(ui, if kind == PlaceKind::Drive { tr("Drives") } else { tr("Folders") });
            }
            let here = place.path == self.folder;
            // The names of places are found on another thread, in English.
            let name = if kind == PlaceKind::Own { tr(&place.name) } else { &place.name };
            let button = ui.add(place_button(name, here));
            if button.on_hover_text(place.path.display().to_string()).clicked() {
                self.go(place.path);
            }
        }
    }

    fn recent_files(&mut self, ui: &mut Ui) -> Option<Answer> {
        let mut answer = None;
        if !self.recent.is_empty() {
            heading(ui, tr("Recent files"));
        }
        for path in self.recent.clone() {
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
            let button = ui.add(place_button(&name.unwrap_or_default(), false));
            if button.on_hover_text(path.display().to_string()).clicked() {
                answer = self.enter_recent(&path);
            }
        }
        answer
    }

    fn enter_recent(&mut self, path: &Path) -> Option<Answer> {
        if !self.options.saving {
            return Some(Answer::File(path.to_owned()));
        }
        if let Some(folder) = path.parent() {
            self.go(folder.to_owned());
        }
        None
    }
}

fn heading(ui: &mut Ui, name: &str) {
    ui.add_space(6.0);
    ui.label(RichText::new(name).weak().small());
}

fn place_button(name: &str, here: bool) -> Button<'_> {
    Button::selectable(here, name).truncate().min_size(vec2(WIDTH - 10.0, 0.0))
}
