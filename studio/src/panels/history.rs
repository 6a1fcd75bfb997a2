//! The history panel: list of actions, undo, redo and undo memory.

use eframe::egui::{Align, DragValue, ProgressBar, ScrollArea, TextStyle, Ui, vec2};
use render::paint::strokes::Action;

use super::PanelContext;
use super::controls::{button, row, text};
use crate::theme;
use session::Command;

const MIB: f64 = 1024.0 * 1024.0;

/// Height of a row, in points.
const ROW: f32 = 20.0;

/// State of the history panel.
#[derive(Debug, Clone, Default)]
pub struct History {
    /// Number of done actions that the list last scrolled to.
    shown: Option<usize>,
}

impl History {
    /// Draws the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        buttons(ui, cx);
        ui.scope(|ui| self.list(ui, cx));
        memory(ui, cx);
    }

    fn list(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let (done, count) = (cx.painting.history_done, cx.painting.history.len());
        let moved = self.shown != Some(done);
        self.shown = Some(done);
        let mut clicked = None;
        ui.spacing_mut().item_spacing.y = 1.0;
        let mut list = ScrollArea::vertical().max_height(260.0).auto_shrink([false, true]);
        if moved {
            // Invisible rows are not laid out, so the offset is computed from the row
            // number.
            let before = (done as f32 - 5.0).max(0.0);
            list = list.vertical_scroll_offset(before * (ROW + 1.0));
        }
        list.show_rows(ui, ROW, count + 1, |ui, rows| {
            for index in rows {
                let label = match index {
                    0 => "beginning",
                    _ => cx.painting.history[index - 1].as_str(),
                };
                let response = row(ui, ROW, &format!("{index} {label}"), index == done);
                let color = if index > done {
                    theme::colors(ui.ctx()).faint
                } else {
                    theme::colors(ui.ctx()).text
                };
                let inner = response.rect.shrink2(vec2(6.0, 0.0));
                let (number, label_rect) = inner.split_left_right_at_x(inner.left() + 34.0);
                text(
                    ui,
                    number,
                    Align::Min,
                    TextStyle::Small,
                    theme::colors(ui.ctx()).faint,
                    &index.to_string(),
                );
                text(ui, label_rect, Align::Min, TextStyle::Body, color, label);
                if response.clicked() && index != done {
                    clicked = Some(index);
                }
                let tip = match index.cmp(&done) {
                    std::cmp::Ordering::Less => "Undoes all later actions",
                    std::cmp::Ordering::Equal => "Current state of the painting",
                    std::cmp::Ordering::Greater => "Redoes all actions up to here",
                };
                response.on_hover_text(tip);
            }
        });
        if let Some(index) = clicked {
            cx.command(Command::GoTo(index));
        }
    }
}

fn buttons(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    let (done, count) = (cx.painting.history_done, cx.painting.history.len());
    ui.horizontal(|ui| {
        let disabled_reason = (done == 0).then_some("there is nothing to undo");
        let tip = match done {
            0 => "Undoes the last action (Ctrl+Z)".to_owned(),
            _ => format!("Undoes: {} (Ctrl+Z)", cx.painting.history[done - 1]),
        };
        if button(ui, "Undo", &tip, disabled_reason) {
            cx.act(Action::Undo {});
        }
        let disabled_reason = (done == count).then_some("there is nothing to redo");
        let tip = match cx.painting.history.get(done) {
            None => "Redoes the last undone action (Ctrl+Shift+Z)".to_owned(),
            Some(label) => format!("Redoes: {label} (Ctrl+Shift+Z)"),
        };
        if button(ui, "Redo", &tip, disabled_reason) {
            cx.act(Action::Redo {});
        }
        ui.weak(format!("{done} of {count}"));
    });
}

fn memory(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    let (used, allowed) = cx.painting.undo_bytes;
    let share = if allowed > 0 { used as f32 / allowed as f32 } else { 0.0 };
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let used_text = format!("{:.0} MiB", used as f64 / MIB);
        let bar = ProgressBar::new(share).desired_width(ui.available_width() - 110.0);
        let bar = bar.desired_height(14.0).fill(theme::colors(ui.ctx()).chosen).text(used_text);
        ui.add(bar).accessible_name("Memory of undo").on_hover_text(
            "Memory used by undo. When it is full, the oldest actions can no longer be undone.",
        );
        ui.label("of");
        let mut mebibytes = allowed as f64 / MIB;
        let field = DragValue::new(&mut mebibytes).range(16.0..=1_048_576.0).speed(16.0);
        let field = field.clamp_existing_to_range(false);
        let response = ui
            .add(field.fixed_decimals(0).suffix(" MiB").update_while_editing(false))
            .accessible_name("Memory allowed")
            .on_hover_text("Memory limit of undo");
        if response.changed() {
            cx.command(Command::SetUndoBytes((mebibytes * MIB).round() as u64));
        }
    });
}
