//! Draws the file browser (places, recent files, entries as rows or pictures) and handles its
//! input.

use std::path::Path;

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{
    Align, Align2, Button, Color32, ComboBox, Context, Event, Frame, Id, Image, Key, Label, Layout,
    Modal, Modifiers, Painter, Pos2, Rect, Response, RichText, Role, ScrollArea, Sense, Shape,
    Stroke, TextStyle, Ui, Vec2, WidgetInfo, WidgetText, pos2, vec2,
};
use web_time::SystemTime;

use super::listing::Entry;
use super::state::{Answer, Browser, PlaceKind};
use super::thumbnails::{Thumbnail, Thumbnails};
use crate::files::dialogs;
use crate::files::preferences::BrowserOrder;
use crate::files::problem::{ago, size};
use crate::language::{tr, tr_format};
use crate::theme;

const WIDTH: f32 = 860.0;
const HEIGHT: f32 = 440.0;

impl Browser {
    #[must_use]
    pub(crate) fn is_saving(&self) -> bool {
        self.options.saving
    }

    /// Shows the dialog above everything else. If this returns an answer, close the dialog.
    pub(crate) fn show(&mut self, ctx: &Context, thumbnails: &mut Thumbnails) -> Option<Answer> {
        self.update();
        let mut answer = None;
        let taken = dialogs::keyboard_taken(ctx);
        let modal = Modal::new(Id::unique("file browser")).show(ctx, |ui| {
            ui.set_width(WIDTH.min(ctx.content_rect().width() - 40.0));
            ui.heading(self.options.title);
            answer = self.path_line(ui);
            self.look_line(ui);
            ui.add_space(2.0);
            let height = HEIGHT.min(ctx.content_rect().height() - 250.0);
            // The height is fixed, so that the buttons below do not move.
            let size = vec2(ui.available_width(), height);
            let across = Layout::left_to_right(Align::Min);
            ui.allocate_ui_with_layout(size, across, |ui| {
                ui.set_min_size(size);
                ui.allocate_ui_with_layout(vec2(PLACES_WIDTH, height), down(), |ui| {
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

    /// Shows the current folder, and the button to the folder above.
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

    /// Shows the field that filters names, the order of the files, and the choice between list and
    /// pictures.
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

    /// Shows the name, the filter, problems and the buttons.
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

    /// Asks whether to replace an existing file.
    fn question(&mut self, ui: &mut Ui, path: &Path) -> Option<Answer> {
        let mut answer = None;
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        ui.horizontal(|ui| {
            ui.label(tr_format!("{name} already exists.", name = name.unwrap_or_default()));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                // The button that changes nothing takes the place of `Save`, so that a second click
                // does not replace a file.
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

    /// Handles keys, unless you type them into a field that had the keyboard (`taken`).
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
        if dialogs::pressed(ctx, taken) { self.enter() } else { None }
    }

    /// If you type letters into the list, this adds them to the filter.
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

    /// Shows the entries in the chosen form.
    pub(super) fn entries_view(
        &mut self,
        ui: &mut Ui,
        height: f32,
        thumbnails: &mut Thumbnails,
    ) -> Option<Answer> {
        let entries: Vec<Entry> = self.shown_entries().into_iter().cloned().collect();
        let gap = ui.spacing().item_spacing;
        let grid = self.look.grid;
        self.columns = if grid {
            (((ui.available_width() + gap.x) / (TILE.x + gap.x)) as usize).max(1)
        } else {
            1
        };
        let row = if grid { TILE.y } else { ROW };
        let scroll = std::mem::take(&mut self.scroll_to_selected);
        let at = entries.iter().position(|entry| Some(&entry.name) == self.selected.as_ref());
        let mut area = ScrollArea::vertical().auto_shrink(false).max_height(height);
        if let Some(at) = at.filter(|_| scroll) {
            let line = (at / self.columns) as f32;
            let middle = line * (row + gap.y) - 0.5 * (height - row);
            area = area.vertical_scroll_offset(middle.max(0.0));
        }
        let columns = self.columns;
        let mut answer = None;
        area.show_rows(ui, row, entries.len().div_ceil(columns), |ui, rows| {
            for line in rows {
                let first = line * columns;
                let last = (first + columns).min(entries.len());
                ui.horizontal(|ui| {
                    for entry in &entries[first..last] {
                        let clicked = if grid {
                            self.tile(ui, entry, thumbnails)
                        } else {
                            self.row(ui, entry, thumbnails)
                        };
                        let clicked = clicked.on_hover_text(if entry.folder {
                            tr("Double click to open the folder").to_owned()
                        } else {
                            tr_format!(
                                "{name}\nDouble click to choose this file",
                                name = entry.name
                            )
                        });
                        if clicked.clicked() {
                            self.select(entry);
                        }
                        if clicked.double_clicked() {
                            answer = self.enter();
                        }
                    }
                });
            }
        });
        if entries.is_empty() {
            let empty = match (self.update(), self.typed_filter.trim()) {
                (true, _) => tr("Reading ..."),
                (false, "") => tr("No files of this kind"),
                (false, _) => tr("No names with these letters"),
            };
            ui.put(ui.min_rect().shrink(8.0), Label::new(RichText::new(empty).weak()));
        }
        answer
    }

    fn row(&self, ui: &mut Ui, entry: &Entry, thumbnails: &mut Thumbnails) -> Response {
        let selected = self.selected.as_ref() == Some(&entry.name);
        let name = if entry.folder { format!("{}/", entry.name) } else { entry.name.clone() };
        let details = RichText::new(details(entry)).small();
        // You could not read faint text on the selected row.
        let details = if selected { details } else { details.weak() };
        let (place, _) = ui.allocate_exact_size(vec2(ROW + 8.0, ROW), Sense::hover());
        self.sign(ui, place.shrink(1.0), entry, thumbnails);
        let button = Button::selectable(selected, name)
            .right_text(details)
            .truncate()
            .min_size(vec2(ui.available_width(), ROW));
        ui.add(button)
    }

    fn tile(&self, ui: &mut Ui, entry: &Entry, thumbnails: &mut Thumbnails) -> Response {
        let selected = self.selected.as_ref() == Some(&entry.name);
        let (rect, response) = ui.allocate_exact_size(TILE, Sense::click());
        let name = if entry.folder { format!("{}/", entry.name) } else { entry.name.clone() };
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, selected, &name));
        let colors = theme::colors(ui.ctx());
        let fill = match (selected, response.hovered()) {
            (true, _) => colors.chosen,
            (false, true) => colors.button,
            (false, false) => Color32::TRANSPARENT,
        };
        ui.painter().rect_filled(rect, f32::from(theme::CORNER_RADIUS), fill);
        let below = rect.bottom() - NAME;
        let picture = Rect::from_min_max(rect.min, pos2(rect.right(), below)).shrink(5.0);
        self.sign(ui, picture, entry, thumbnails);
        let text = WidgetText::from(name).into_galley(
            ui,
            Some(eframe::egui::TextWrapMode::Truncate),
            rect.width() - 8.0,
            TextStyle::Body,
        );
        let middle = pos2(rect.center().x, below + 0.5 * NAME - 2.0);
        let at = Align2::CENTER_CENTER.anchor_size(middle, text.size());
        let color = if selected { colors.strong } else { colors.text };
        ui.painter().galley(at.min, text, color);
        response
    }

    fn sign(&self, ui: &Ui, rect: Rect, entry: &Entry, thumbnails: &mut Thumbnails) {
        let faint = theme::colors(ui.ctx()).faint;
        match thumbnails.of(ui.ctx(), &self.folder, entry) {
            Thumbnail::Ready(texture) => {
                let own = texture.size_vec2();
                let fitted = own * (rect.width() / own.x).min(rect.height() / own.y).min(1.0);
                let place = Rect::from_center_size(rect.center(), fitted);
                Image::from_texture(texture).paint_at(ui, place);
            }
            Thumbnail::Awaited => draw(ui.painter(), rect, false, faint.gamma_multiply(0.5)),
            Thumbnail::Plain => draw(ui.painter(), rect, entry.folder, faint),
        }
    }

    /// Draws the column of places. Click a folder to open it, or a file to choose it.
    pub(super) fn places_view(&mut self, ui: &mut Ui, height: f32) -> Option<Answer> {
        ui.set_width(PLACES_WIDTH);
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
            // Another thread finds the names of places, in English.
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

pub(super) fn draw(painter: &Painter, rect: Rect, folder: bool, color: Color32) {
    let side = rect.width().min(rect.height()) * 0.8;
    let size = if folder { vec2(side, 0.78 * side) } else { vec2(0.72 * side, side) };
    let corner = rect.center() - 0.5 * size;
    let stroke = Stroke::new((side / 22.0).clamp(1.0, 2.0), color);
    let lines: [&[(f32, f32)]; 2] = if folder {
        [
            &[
                (0.0, 1.0),
                (0.0, 0.0),
                (0.36, 0.0),
                (0.48, 0.16),
                (1.0, 0.16),
                (1.0, 1.0),
                (0.0, 1.0),
            ],
            &[(0.0, 0.34), (1.0, 0.34)],
        ]
    } else {
        [
            &[(0.0, 0.0), (0.62, 0.0), (1.0, 0.28), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)],
            &[(0.62, 0.0), (0.62, 0.28), (1.0, 0.28)],
        ]
    };
    for line in lines {
        let places: Vec<Pos2> = line
            .iter()
            .copied()
            .map(|(x, y)| pos2(corner.x + x * size.x, corner.y + y * size.y))
            .collect();
        painter.add(Shape::line(places, stroke));
    }
}

const ROW: f32 = 34.0;

const TILE: Vec2 = vec2(126.0, 124.0);

const NAME: f32 = 20.0;

fn details(entry: &Entry) -> String {
    let age = entry.changed.map(|then| ago(then, SystemTime::now())).unwrap_or_default();
    if entry.folder { age } else { format!("{}   {age}", size(entry.bytes)) }
}

pub(super) const PLACES_WIDTH: f32 = 160.0;

fn heading(ui: &mut Ui, name: &str) {
    ui.add_space(6.0);
    ui.label(RichText::new(name).weak().small());
}

fn place_button(name: &str, here: bool) -> Button<'_> {
    Button::selectable(here, name).truncate().min_size(vec2(PLACES_WIDTH - 10.0, 0.0))
}
