//! Drawing and input of the file browser.

use std::path::Path;

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{
    Align, Button, ComboBox, Context, Event, Frame, Id, Key, Layout, Modal, Modifiers, RichText,
    Ui, Vec2, vec2,
};

use super::places_view;
use super::state::{Answer, Browser};
use super::thumbnails::Thumbnails;
use crate::files::browser_look::BrowserOrder;
use crate::files::default_button;
use crate::language::{tr, tr_format};
use crate::theme;

const WIDTH: f32 = 860.0;
const HEIGHT: f32 = 440.0;

impl Browser {
    /// Whether it asks where to save.
    #[must_use]
    pub(crate) fn is_saving(&self) -> bool {
        self.options.saving
    }

    /// Shows the dialog above everything else. Returns the painter's answer, after which
    /// the caller closes the dialog.
    pub(crate) fn show(&mut self, ctx: &Context, thumbnails: &mut Thumbnails) -> Option<Answer> {
        self.update();
        let mut answer = None;
        let taken = default_button::keyboard_taken(ctx);
        let modal = Modal::new(Id::unique("file browser")).show(ctx, |ui| {
            ui.set_width(WIDTH.min(ctx.content_rect().width() - 40.0));
            ui.heading(self.options.title);
            answer = self.path_line(ui);
            self.look_line(ui);
            ui.add_space(2.0);
            let height = HEIGHT.min(ctx.content_rect().height() - 250.0);
            // A fixed height, so that the buttons below do not move.
            let size = vec2(ui.available_width(), height);
            let across = Layout::left_to_right(Align::Min);
            ui.allocate_ui_with_layout(size, across, |ui| {
                ui.set_min_size(size);
                ui.allocate_ui_with_layout(vec2(places_view::WIDTH, height), down(), |ui| {
                    answer = answer.take().or_else(|| self.places_view(ui, height));
                });
                Frame::new().fill(ui.visuals().extreme_bg_color).inner_margin(4).show(ui, |ui| {
                    let size = ui.available_size();
                    ui.allocate_ui_with_layout(size, down(), |ui| {
                        ui.set_min_size(size);
                        answer =
                            answer.take().or_else(|| self.entries_view(ui, size.y, thumbnails));
                    });
                });
            });
            ui.add_space(2.0);
            answer = answer.take().or_else(|| self.last_lines(ui));
        });
        answer = answer.or_else(|| self.keys(ctx, taken));
        if answer.is_none() && modal.should_close() {
            answer = Some(Answer::Cancelled);
        }
        answer
    }

    /// The current folder, and the button to the folder above.
    fn path_line(&mut self, ui: &mut Ui) -> Option<Answer> {
        let mut answer = None;
        ui.horizontal(|ui| {
            let up = Button::new(tr("Up")).min_size(theme::at_least(ui, Vec2::ZERO));
            let up = ui.add(up).on_hover_text(tr("The folder above (Backspace)"));
            if up.clicked() {
                self.up();
            }
            let edit = theme::text_field(&mut self.typed_folder).desired_width(f32::INFINITY);
            let typed = ui.add(edit).accessible_name(tr("Folder"));
            let typed = typed.on_hover_text(tr("The folder; Enter opens what is typed"));
            if typed.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
                answer = self.enter_typed();
            }
        });
        answer
    }

    /// The letters that names must have, the order, and the form of the files.
    fn look_line(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let edit = theme::text_field(&mut self.typed_filter).hint_text(tr("Filter by name"));
            let edit = ui.add(edit.desired_width(260.0)).accessible_name(tr("Filter by name"));
            edit.on_hover_text(tr(
                "Shows only names with these letters; typing into the list does too",
            ));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                for (grid, name, tip) in [
                    (true, tr("Grid"), tr("Shows the files as pictures")),
                    (false, tr("List"), tr("Shows the files in rows, with size and age")),
                ] {
                    ui.selectable_value(&mut self.look.grid, grid, name).on_hover_text(tip);
                }
                ui.separator();
                for (order, name, tip) in [
                    (BrowserOrder::Date, tr("Date"), tr("The file that changed last comes first")),
                    (BrowserOrder::Name, tr("Name"), tr("In the order of the names")),
                ] {
                    ui.selectable_value(&mut self.look.order, order, name).on_hover_text(tip);
                }
                ui.weak(tr("Order"));
            });
        });
    }

    /// The name, the filter, problems and the buttons.
    fn last_lines(&mut self, ui: &mut Ui) -> Option<Answer> {
        if let Some(problem) = &self.problem {
            ui.label(&problem.text);
            if let Some(hint) = &problem.hint {
                ui.label(RichText::new(hint).weak());
            }
        }
        if let Some(path) = self.replacing.clone() {
            return self.question(ui, &path);
        }
        let mut answer = None;
        ui.horizontal(|ui| {
            if self.options.saving {
                ui.label(tr("Name"));
                let edit = theme::text_field(&mut self.name).desired_width(260.0);
                let edit = ui.add(edit).on_hover_text(tr("The file's name; Enter saves"));
                if !std::mem::replace(&mut self.name_focused, true) {
                    edit.request_focus();
                    select_all(ui, edit.id, &self.name);
                }
                if edit.changed() {
                    self.selected = None;
                    self.problem = None;
                }
                if edit.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
                    answer = self.save();
                }
                let folder = ui.button(tr("New folder"));
                if folder.on_hover_text(tr("Creates a folder of this name and opens it")).clicked()
                {
                    self.make_folder();
                }
            }
            let filters = self.options.filters;
            if filters.len() > 1 {
                let chosen = filters.get(self.filter).map_or("", |filter| tr(filter.label));
                ComboBox::from_id_salt("kind")
                    .selected_text(chosen)
                    .show_ui(ui, |ui| {
                        for (index, filter) in filters.iter().enumerate() {
                            ui.selectable_value(&mut self.filter, index, tr(filter.label));
                        }
                    })
                    .response
                    .on_hover_text(tr("Which files are shown"));
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let ready = self.options.saving || self.selected.is_some();
                let verb = if self.options.saving { tr("Save") } else { tr("Open") };
                let accept = ui.add_enabled(ready, Button::new(verb).min_size(vec2(72.0, 0.0)));
                if accept.on_hover_text(tr("Choose this file (Enter)")).clicked() {
                    answer = if self.options.saving { self.save() } else { self.enter() };
                }
                if ui.button(tr("Cancel")).on_hover_text(tr("Choose no file (Esc)")).clicked() {
                    answer = Some(Answer::Cancelled);
                }
            });
        });
        answer
    }

    /// Asks if an existing file may be replaced.
    fn question(&mut self, ui: &mut Ui, path: &Path) -> Option<Answer> {
        let mut answer = None;
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        ui.horizontal(|ui| {
            ui.label(tr_format!("{name} already exists.", name = name.unwrap_or_default()));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                // The button that changes nothing is where `Save` was, so that a second
                // click replaces no file.
                let keep = ui.button(tr("Keep"));
                if keep.on_hover_text(tr("Keeps the file; choose another name")).clicked() {
                    self.replacing = None;
                }
                let replace = ui.button(tr("Replace"));
                if replace.on_hover_text(tr("Replaces the file (Enter)")).clicked() {
                    answer = Some(Answer::File(path.to_owned()));
                }
            });
        });
        answer
    }

    /// Handles keys, unless they are typed into a field that had the keyboard (`taken`).
    fn keys(&mut self, ctx: &Context, taken: bool) -> Option<Answer> {
        let pressed = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let page = 12;
        let line = self.columns as isize;
        for (key, steps) in [
            (Key::ArrowDown, line),
            (Key::ArrowUp, -line),
            (Key::PageDown, page),
            (Key::PageUp, -page),
        ] {
            if pressed(key) {
                self.step(steps);
            }
        }
        if !taken {
            for (key, steps) in [(Key::ArrowRight, 1), (Key::ArrowLeft, -1)] {
                if self.look.grid && pressed(key) {
                    self.step(steps);
                }
            }
            if pressed(Key::Backspace) && self.typed_filter.pop().is_none() {
                self.up();
            }
            self.type_letters(ctx);
        }
        if default_button::pressed(ctx, taken) { self.enter() } else { None }
    }

    /// Adds letters that are typed into the list to the filter.
    fn type_letters(&mut self, ctx: &Context) {
        let focused = ctx.memory(|memory| memory.focused().is_some());
        if self.options.saving || focused {
            return;
        }
        ctx.input(|input| {
            for event in &input.events {
                if let Event::Text(text) = event {
                    self.typed_filter.push_str(text);
                }
            }
        });
    }
}

/// Selects all text of a field, so that typing replaces it.
fn select_all(ui: &Ui, field: Id, text: &str) {
    let mut state = TextEditState::load(ui.ctx(), field).unwrap_or_default();
    let ends = [0, text.chars().count()].map(CCursor::new);
    state.cursor.set_char_range(Some(CCursorRange::two(ends[0], ends[1])));
    state.store(ui.ctx(), field);
}

fn down() -> Layout {
    Layout::top_down(Align::Min)
}
