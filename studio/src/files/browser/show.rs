//! Drawing and input of the file browser.

use std::path::Path;
use std::time::SystemTime;

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{
    Align, Button, ComboBox, Context, Event, Frame, Id, Key, Label, Layout, Modal, Modifiers,
    RichText, ScrollArea, TextEdit, Ui, vec2,
};

use super::listing::home_folder;
use super::state::{Answer, Browser};
use crate::files::age::{ago, size};

const WIDTH: f32 = 720.0;
const HEIGHT: f32 = 380.0;
const PLACES_WIDTH: f32 = 160.0;

impl Browser {
    /// Shows the dialog above everything else. Returns the painter's answer, after which
    /// the caller closes the dialog.
    pub(crate) fn show(&mut self, ctx: &Context) -> Option<Answer> {
        self.update();
        let mut answer = None;
        let modal = Modal::new(Id::unique("file browser")).show(ctx, |ui| {
            ui.set_width(WIDTH.min(ctx.content_rect().width() - 40.0));
            ui.heading(self.options.title);
            answer = self.path_line(ui);
            ui.add_space(2.0);
            let height = HEIGHT.min(ctx.content_rect().height() - 220.0);
            // A fixed height, so that the buttons below do not move.
            let size = vec2(ui.available_width(), height);
            let across = Layout::left_to_right(Align::Min);
            ui.allocate_ui_with_layout(size, across, |ui| {
                ui.set_min_size(size);
                ui.allocate_ui_with_layout(vec2(PLACES_WIDTH, height), down(), |ui| {
                    answer = answer.take().or_else(|| self.places(ui));
                });
                Frame::new().fill(ui.visuals().extreme_bg_color).inner_margin(4).show(ui, |ui| {
                    let size = ui.available_size();
                    ui.allocate_ui_with_layout(size, down(), |ui| {
                        ui.set_min_size(size);
                        answer = answer.take().or_else(|| self.list(ui, size.y));
                    });
                });
            });
            ui.add_space(2.0);
            answer = answer.take().or_else(|| self.last_lines(ui));
        });
        answer = answer.or_else(|| self.keys(ctx));
        if answer.is_none() && modal.should_close() {
            answer = Some(Answer::Cancelled);
        }
        answer
    }

    /// The current folder, and the button to the folder above.
    fn path_line(&mut self, ui: &mut Ui) -> Option<Answer> {
        let mut answer = None;
        ui.horizontal(|ui| {
            let up = ui.button("Up").on_hover_text("The folder above (Backspace)");
            if up.clicked() {
                self.up();
            }
            let edit = TextEdit::singleline(&mut self.typed_folder).desired_width(f32::INFINITY);
            let typed = ui.add(edit).on_hover_text("The folder; Enter opens what is typed");
            if typed.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
                answer = self.enter_typed();
            }
        });
        answer
    }

    /// The home folder and recent files.
    fn places(&mut self, ui: &mut Ui) -> Option<Answer> {
        ui.set_width(PLACES_WIDTH);
        let mut answer = None;
        if ui.add(place_button("Home")).on_hover_text("Your home folder").clicked() {
            self.go(home_folder());
        }
        if self.recent.is_empty() {
            return None;
        }
        ui.add_space(6.0);
        ui.label(RichText::new("Recent").weak().small());
        for path in self.recent.clone() {
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
            let button = ui.add(place_button(&name.unwrap_or_default()));
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

    /// The list of folders and files.
    fn list(&mut self, ui: &mut Ui, height: f32) -> Option<Answer> {
        let mut answer = None;
        let entries: Vec<_> = self.shown().into_iter().cloned().collect();
        let row = ui.spacing().interact_size.y;
        let scroll = std::mem::take(&mut self.scroll_to_selected);
        let at = entries.iter().position(|entry| Some(&entry.name) == self.selected.as_ref());
        let mut area = ScrollArea::vertical().auto_shrink(false).max_height(height);
        if let Some(at) = at.filter(|_| scroll) {
            let step = row + ui.spacing().item_spacing.y;
            area = area.vertical_scroll_offset((at as f32 * step - height / 2.0).max(0.0));
        }
        let now = SystemTime::now();
        area.show_rows(ui, row, entries.len(), |ui, rows| {
            for entry in &entries[rows] {
                let selected = self.selected.as_ref() == Some(&entry.name);
                let name =
                    if entry.folder { format!("{}/", entry.name) } else { entry.name.clone() };
                let mut details = entry.changed.map(|then| ago(then, now)).unwrap_or_default();
                if !entry.folder {
                    details = format!("{}   {details}", size(entry.bytes));
                }
                let details = RichText::new(details).weak().small();
                let button = Button::selectable(selected, name)
                    .right_text(details)
                    .truncate()
                    .min_size(vec2(ui.available_width(), row));
                let clicked = ui.add(button).on_hover_text(if entry.folder {
                    "Double click to open the folder"
                } else {
                    "Double click to choose this file"
                });
                if clicked.clicked() {
                    self.select(entry);
                }
                if clicked.double_clicked() {
                    answer = self.enter();
                }
            }
        });
        if entries.is_empty() {
            let empty = if self.update() { "Reading ..." } else { "No files of this kind" };
            ui.put(ui.min_rect().shrink(8.0), Label::new(RichText::new(empty).weak()));
        }
        answer
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
                ui.label("Name");
                let edit = TextEdit::singleline(&mut self.name).desired_width(260.0);
                let edit = ui.add(edit).on_hover_text("The file's name; Enter saves");
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
                let folder = ui.button("New folder");
                if folder.on_hover_text("Creates a folder of this name and opens it").clicked() {
                    self.make_folder();
                }
            }
            let filters = self.options.filters;
            if filters.len() > 1 {
                let chosen = filters.get(self.filter).map_or("", |filter| filter.label);
                ComboBox::from_id_salt("kind")
                    .selected_text(chosen)
                    .show_ui(ui, |ui| {
                        for (index, filter) in filters.iter().enumerate() {
                            ui.selectable_value(&mut self.filter, index, filter.label);
                        }
                    })
                    .response
                    .on_hover_text("Which files are shown");
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let ready = self.options.saving || self.selected.is_some();
                let verb = if self.options.saving { "Save" } else { "Open" };
                let accept = ui.add_enabled(ready, Button::new(verb).min_size(vec2(72.0, 0.0)));
                if accept.on_hover_text("Choose this file (Enter)").clicked() {
                    answer = if self.options.saving { self.save() } else { self.enter() };
                }
                if ui.button("Cancel").on_hover_text("Choose no file (Esc)").clicked() {
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
            ui.label(format!("{} already exists.", name.unwrap_or_default()));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                // The button that changes nothing is where `Save` was, so that a second
                // click replaces no file.
                let keep = ui.button("Keep");
                if keep.on_hover_text("Keeps the file; choose another name").clicked() {
                    self.replacing = None;
                }
                let replace = ui.button("Replace");
                if replace.on_hover_text("Replaces the file (Enter)").clicked() {
                    answer = Some(Answer::File(path.to_owned()));
                }
            });
        });
        answer
    }

    /// Handles keys, unless they are typed into a field.
    fn keys(&mut self, ctx: &Context) -> Option<Answer> {
        let typing = ctx.egui_wants_keyboard_input();
        let pressed = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let page = 12;
        for (key, steps) in
            [(Key::ArrowDown, 1), (Key::ArrowUp, -1), (Key::PageDown, page), (Key::PageUp, -page)]
        {
            if pressed(key) {
                self.step(steps);
            }
        }
        if typing {
            return None;
        }
        if pressed(Key::Backspace) {
            self.up();
        }
        // Enter counts only when it is pressed anew, not when a held key repeats.
        let held = ctx.input(|input| {
            let again = |event: &Event| matches!(event, Event::Key { repeat: true, .. });
            input.events.iter().any(again)
        });
        if pressed(Key::Enter) && !held { self.enter() } else { None }
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

fn place_button(name: &str) -> Button<'_> {
    Button::selectable(false, name).truncate().min_size(vec2(PLACES_WIDTH, 0.0))
}
