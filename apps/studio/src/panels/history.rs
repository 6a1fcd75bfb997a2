//! The history panel (list of actions with pictures, undo, redo and memory) and the panel of
//! revisions.

use std::sync::Arc;

use eframe::egui::{
    Align, Color32, ColorImage, Context, DragValue, Image, Layout, Painter, Pos2, ProgressBar,
    Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, TextureHandle, TextureId,
    TextureOptions, Ui, Vec2, pos2, vec2,
};
use paint::strokes::Action;
use session::{Command, HistoryShot, PaintingState, Thumbnail};
use web_time::SystemTime;

use crate::files::{FileRequest, ListedRevision, RevisionList, ago, size};
use crate::keymap::hint;
use crate::language::{action_label, tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::{button, row as panel_row, row_height, text};
use crate::theme;

const MIB: f64 = 1024.0 * 1024.0;

const ROW: f32 = 36.0;

const PICTURE: f32 = 54.0;

/// If you point at a row, its picture is enlarged to this size, in points.
const ENLARGED: Vec2 = vec2(300.0, 240.0);

const LEAST: f32 = 160.0;

/// State of the history panel.
#[derive(Debug, Clone, Default)]
pub struct History {
    /// Number of done actions at the last scroll, and the height of the list then in points.
    shown: Option<(usize, f32)>,
    pictures: Pictures,
}

impl History {
    /// Draws the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        buttons(ui, cx);
        ui.scope(|ui| self.list(ui, cx));
        memory(ui, cx);
    }

    fn list(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let done = cx.painting.history_done;
        let count = cx.painting.history.len();
        let mut clicked = None;
        ui.spacing_mut().item_spacing.y = 1.0;
        // A list that just grew would spring back to its former end.
        ui.spacing_mut().scroll.kinetic.rubber_band = false;
        // The lines above and below the list stay in the panel.
        let high = row_height(ui, ROW);
        let others = 3.0 * ui.spacing().interact_size.y + 12.0;
        let most = (ui.clip_rect().height() - others).max(LEAST);
        // In a lower list you would not see the current row.
        let moved = self.shown.replace((done, most)) != Some((done, most));
        let mut list = ScrollArea::vertical().max_height(most).auto_shrink([false, true]);
        if moved {
            // We do not lay out invisible rows, so we compute the offset from the row number.
            let before = done as f32 * (high + 1.0) - 0.5 * (most - high);
            list = list.vertical_scroll_offset(before.max(0.0));
        }
        list.show_rows(ui, high, count + 1, |ui, rows| {
            for index in rows {
                let label = match index {
                    0 => tr("beginning"),
                    _ => &action_label(&cx.painting.history[index - 1]),
                };
                let response = panel_row(ui, high, &format!("{index} {label}"), index == done);
                let color = if index > done {
                    theme::colors(ui.ctx()).faint
                } else {
                    theme::colors(ui.ctx()).text
                };
                let inner = response.rect.shrink2(vec2(6.0, 0.0));
                let (number, inner) = inner.split_left_right_at_x(inner.left() + 28.0);
                let (picture, label_rect) = inner.split_left_right_at_x(inner.left() + PICTURE);
                let label_rect = Rect::from_min_max(
                    pos2(label_rect.left() + 8.0, label_rect.top()),
                    label_rect.max,
                );
                let shot = cx.painting.history_shots.shots.get(index).and_then(Option::as_ref);
                self.pictures.draw(ui.painter(), picture.shrink2(vec2(0.0, 2.0)), shot);
                text(
                    ui,
                    number,
                    Align::Min,
                    TextStyle::Small,
                    if index == done { color } else { theme::colors(ui.ctx()).faint },
                    &index.to_string(),
                );
                text(ui, label_rect, Align::Min, TextStyle::Body, color, label);
                if response.clicked() && index != done {
                    clicked = Some(index);
                }
                let tip = match index.cmp(&done) {
                    std::cmp::Ordering::Less => tr("Undoes all later actions"),
                    std::cmp::Ordering::Equal => tr("Current state of the painting"),
                    std::cmp::Ordering::Greater => tr("Redoes all actions up to here"),
                };
                response.on_hover_ui(|ui| {
                    ui.label(tip);
                    if let Some(shot) = shot {
                        let size = fitted_size(&shot.picture, ENLARGED);
                        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
                        self.pictures.draw(ui.painter(), rect, Some(shot));
                        if let Some(note) = note(index, cx.painting) {
                            ui.weak(note);
                        }
                    }
                });
            }
        });
        if let Some(index) = clicked {
            cx.command(Command::GoTo(index));
        }
    }
}

/// Text about the picture after the first `index` actions: whether its outline shows a change.
fn note(index: usize, painting: &PaintingState) -> Option<&'static str> {
    let shots = &painting.history_shots.shots;
    let before = shots.get(index.checked_sub(1)?)?.is_some();
    match shots.get(index)?.as_ref()?.changed {
        Some(_) => Some(tr("The outline holds what the action changed.")),
        None => before.then_some(tr("The action changed nothing on the canvas.")),
    }
}

fn buttons(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    let done = cx.painting.history_done;
    let count = cx.painting.history.len();
    ui.horizontal(|ui| {
        let disabled_reason = (done == 0).then_some(tr("there is nothing to undo"));
        let tip = match done {
            0 => tr_format!("Undoes the last action{hint}", hint = hint(ui.ctx(), "undo")),
            _ => tr_format!(
                "Undoes: {action}{hint}",
                action = action_label(&cx.painting.history[done - 1]),
                hint = hint(ui.ctx(), "undo")
            ),
        };
        if button(ui, tr("Undo"), &tip, disabled_reason) {
            cx.act(Action::Undo {});
        }
        let disabled_reason = (done == count).then_some(tr("there is nothing to redo"));
        let tip = match cx.painting.history.get(done) {
            None => {
                tr_format!("Redoes the last undone action{hint}", hint = hint(ui.ctx(), "redo"))
            }
            Some(label) => tr_format!(
                "Redoes: {action}{hint}",
                action = action_label(label),
                hint = hint(ui.ctx(), "redo")
            ),
        };
        if button(ui, tr("Redo"), &tip, disabled_reason) {
            cx.act(Action::Redo {});
        }
        ui.weak(tr_format!("{done} of {count}", done, count));
    });
}

fn memory(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    let (used, allowed) = cx.painting.undo_bytes;
    let share = if allowed > 0 { used as f32 / allowed as f32 } else { 0.0 };
    let shots = &cx.painting.history_shots;
    let [pictures, most] = [shots.bytes, shots.most_bytes].map(|bytes| bytes as f64 / MIB);
    ui.add_space(4.0);
    ui.weak(tr_format!("Pictures take {pictures:.1} of {most:.0} MiB", pictures, most)).on_hover_text(
        tr("Memory of the pictures in the list. When it is full, the oldest are dropped; their actions \
         can still be undone."),
    );
    ui.horizontal(|ui| {
        let used_text = format!("{:.0} MiB", used as f64 / MIB);
        let bar = ProgressBar::new(share).desired_width(ui.available_width() - 110.0);
        let bar = bar.desired_height(14.0).fill(theme::colors(ui.ctx()).chosen).text(used_text);
        ui.add(bar).accessible_name(tr("Memory of undo")).on_hover_text(tr(
            "Memory used by undo. When it is full, the oldest actions can no longer be undone.",
        ));
        ui.label(tr("of"));
        let mut mebibytes = allowed as f64 / MIB;
        let field = DragValue::new(&mut mebibytes).range(16.0..=1_048_576.0).speed(16.0);
        let field = field.clamp_existing_to_range(false);
        let response = ui
            .add(field.fixed_decimals(0).suffix(" MiB").update_while_editing(false))
            .accessible_name(tr("Memory allowed"))
            .on_hover_text(tr("Memory limit of undo"));
        if response.changed() {
            cx.command(Command::SetUndoBytes((mebibytes * MIB).round() as u64));
        }
    });
}

/// Most textures that we keep. The least recently drawn ones go first.
const MOST: usize = 96;

/// Textures of the pictures drawn last, the latest at the end.
#[derive(Clone, Default)]
struct Pictures(Vec<(Arc<Thumbnail>, TextureHandle)>);

impl std::fmt::Debug for Pictures {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Pictures").field(&self.0.len()).finish()
    }
}

impl Pictures {
    /// Draws a picture as large as fits into `area`, with an outline around the change. A missing
    /// picture leaves an empty frame.
    fn draw(&mut self, painter: &Painter, area: Rect, shot: Option<&HistoryShot>) {
        let Some(HistoryShot { picture, changed }) = shot else {
            let line = Stroke::new(1.0, theme::colors(painter.ctx()).line);
            painter.rect_stroke(area.shrink(2.0), 0.0, line, StrokeKind::Inside);
            return;
        };
        let place = fitted(picture, area);
        let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        painter.image(self.texture(painter.ctx(), picture), place, whole, Color32::WHITE);
        if let Some([left, top, width, height]) = changed.map(|changed| changed.map(|n| n as f32)) {
            let scale = place.width() / picture.width as f32;
            let corner = place.min + vec2(left, top) * scale;
            let outline = Rect::from_min_size(corner, vec2(width, height) * scale);
            // Dark beside light, you see it on any paint.
            let outline = outline.expand(1.0).intersect(place.expand(1.0));
            let dark = Stroke::new(1.0, Color32::from_black_alpha(200));
            painter.rect_stroke(outline, 0.0, dark, StrokeKind::Outside);
            painter.rect_stroke(outline, 0.0, Stroke::new(1.0, Color32::WHITE), StrokeKind::Inside);
        }
    }

    fn texture(&mut self, context: &Context, picture: &Arc<Thumbnail>) -> TextureId {
        let found = self.0.iter().position(|(kept, _)| Arc::ptr_eq(kept, picture));
        let entry = match found {
            Some(index) => self.0.remove(index),
            None => {
                let pixels: Vec<u8> = picture.pixels.iter().flatten().copied().collect();
                let size = [picture.width, picture.height];
                let image = ColorImage::from_rgba_unmultiplied(size, &pixels);
                let texture = context.load_texture("history", image, TextureOptions::LINEAR);
                (Arc::clone(picture), texture)
            }
        };
        let texture = entry.1.id();
        self.0.push(entry);
        let surplus = self.0.len().saturating_sub(MOST);
        self.0.drain(..surplus);
        texture
    }
}

/// The largest size of a picture that fits into `room`.
fn fitted_size(picture: &Thumbnail, room: Vec2) -> Vec2 {
    let size = vec2(picture.width.max(1) as f32, picture.height.max(1) as f32);
    size * (room.x / size.x).min(room.y / size.y)
}

fn fitted(picture: &Thumbnail, area: Rect) -> Rect {
    Rect::from_center_size(area.center(), fitted_size(picture, area.size()))
}

/// Longer side of a thumbnail, in points.
const THUMBNAIL: f32 = 72.0;

/// Draws the panel: revisions, newest first, with buttons to open and delete them.
pub fn show(ui: &mut Ui, cx: &mut PanelContext<'_>, list: &RevisionList) {
    let keep = ui.button(tr("Keep revision"));
    let tip =
        tr("Keeps a numbered copy beside the painting's file; asks for a file name if it has none");
    if keep.on_hover_text(tip).clicked() {
        cx.file(FileRequest::KeepRevision);
    }
    if list.revisions.is_empty() {
        ui.label(RichText::new(tr("No revisions yet")).weak());
    }
    let now = SystemTime::now();
    for listed in &list.revisions {
        ui.separator();
        row(ui, cx, listed, now);
    }
}

fn row(ui: &mut Ui, cx: &mut PanelContext<'_>, listed: &ListedRevision, now: SystemTime) {
    let revision = &listed.revision;
    let number = revision.number;
    ui.horizontal(|ui| {
        let square = vec2(THUMBNAIL, THUMBNAIL);
        match &listed.texture {
            Some(texture) => {
                let picture = Image::from_texture(texture).fit_to_exact_size(square);
                let alt = tr_format!("Revision {number}", number);
                ui.add(picture.max_size(square).alt_text(alt))
                    .on_hover_text(revision.path.display().to_string());
            }
            None => {
                ui.allocate_space(vec2(THUMBNAIL, THUMBNAIL / 2.0));
            }
        }
        ui.with_layout(Layout::top_down(Align::Min), |ui| {
            ui.label(tr_format!("Revision {number}", number));
            let age = revision.kept.map(|kept| ago(kept, now)).unwrap_or_default();
            let details = format!("{age}, {}", size(revision.bytes));
            ui.label(RichText::new(details).weak().small());
            ui.horizontal(|ui| {
                let open = ui.button(tr_format!("Open {number}", number));
                if open.on_hover_text(tr("Opens it as a new painting")).clicked() {
                    cx.file(FileRequest::OpenRevision(revision.path.clone()));
                }
                let delete = ui.button(tr_format!("Delete {number}", number));
                if delete.on_hover_text(tr("Deletes it after a confirmation")).clicked() {
                    cx.file(FileRequest::DeleteRevision(revision.path.clone()));
                }
            });
        });
    });
}
