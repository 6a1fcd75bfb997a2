//! The entries of the folder: a list of rows, or a grid of pictures.

use web_time::SystemTime;

use eframe::egui::{
    Align2, Button, Color32, Image, Label, Rect, Response, RichText, Role, ScrollArea, Sense,
    TextStyle, Ui, Vec2, WidgetInfo, WidgetText, pos2, vec2,
};

use super::glyph;
use super::listing::Entry;
use super::state::{Answer, Browser};
use super::thumbnails::{Thumbnail, Thumbnails};
use crate::files::age::{ago, size};
use crate::language::{tr, tr_format};
use crate::theme;

/// Height of a row of the list, in points.
const ROW: f32 = 34.0;

/// Size of a tile of the grid, in points.
const TILE: Vec2 = vec2(126.0, 124.0);

/// Height of the name below a picture of the grid, in points.
const NAME: f32 = 20.0;

impl Browser {
    /// The entries in the form that the painter chose.
    pub(super) fn entries_view(
        &mut self,
        ui: &mut Ui,
        height: f32,
        thumbnails: &mut Thumbnails,
    ) -> Option<Answer> {
        let entries: Vec<Entry> = self.shown().into_iter().cloned().collect();
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
        // Faint text is not legible on the selected row.
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

    /// Draws the picture of an entry, or a plain sign.
    fn sign(&self, ui: &Ui, rect: Rect, entry: &Entry, thumbnails: &mut Thumbnails) {
        let faint = theme::colors(ui.ctx()).faint;
        match thumbnails.of(ui.ctx(), &self.folder, entry) {
            Thumbnail::Ready(texture) => {
                let own = texture.size_vec2();
                let fitted = own * (rect.width() / own.x).min(rect.height() / own.y).min(1.0);
                let place = Rect::from_center_size(rect.center(), fitted);
                Image::from_texture(texture).paint_at(ui, place);
            }
            Thumbnail::Awaited => glyph::draw(ui.painter(), rect, false, faint.gamma_multiply(0.5)),
            Thumbnail::Plain => glyph::draw(ui.painter(), rect, entry.folder, faint),
        }
    }
}

/// Size and age of an entry in words.
fn details(entry: &Entry) -> String {
    let age = entry.changed.map(|then| ago(then, SystemTime::now())).unwrap_or_default();
    if entry.folder { age } else { format!("{}   {age}", size(entry.bytes)) }
}
