//! Draws the history panel.

use eframe::egui::{
    Align, DragValue, ProgressBar, Rect, ScrollArea, Sense, TextStyle, Ui, pos2, vec2,
};
use paint::strokes::Action;

use super::pictures::{Pictures, fitted_size};
use crate::keymap::hint;
use crate::language::{action_label, tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::{button, row, row_height};
use crate::panels::fitted_text::text;
use crate::theme;
use session::{Command, PaintingState};

const MIB: f64 = 1024.0 * 1024.0;

/// Height of a row, in points.
const ROW: f32 = 36.0;

/// Width of the picture in a row, in points.
const PICTURE: f32 = 54.0;

/// Size that the picture of a row below the pointer is enlarged to, in points.
const ENLARGED: eframe::egui::Vec2 = vec2(300.0, 240.0);

/// Least height of the list, in points.
const LEAST: f32 = 160.0;

/// State of the history panel.
#[derive(Debug, Clone, Default)]
pub struct History {
    /// Number of done actions that the list last scrolled to, and its height then in points.
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
        // A list that just grew would spring back to where it ended before.
        ui.spacing_mut().scroll.kinetic.rubber_band = false;
        // The lines above and below the list stay in the panel.
        let high = row_height(ui, ROW);
        let others = 3.0 * ui.spacing().interact_size.y + 12.0;
        let most = (ui.clip_rect().height() - others).max(LEAST);
        // In a lower list the current row would be out of sight.
        let moved = self.shown.replace((done, most)) != Some((done, most));
        let mut list = ScrollArea::vertical().max_height(most).auto_shrink([false, true]);
        if moved {
            // Invisible rows are not laid out, so the offset is computed from the row
            // number.
            let before = done as f32 * (high + 1.0) - 0.5 * (most - high);
            list = list.vertical_scroll_offset(before.max(0.0));
        }
        list.show_rows(ui, high, count + 1, |ui, rows| {
            for index in rows {
                let label = match index {
                    0 => tr("beginning"),
                    _ => &action_label(&cx.painting.history[index - 1]),
                };
                let response = row(ui, high, &format!("{index} {label}"), index == done);
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

/// Words on the outline of the picture after the first `index` actions.
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
