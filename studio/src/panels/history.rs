//! The history: what was done, and going back.

use eframe::egui::{Align, DragValue, ProgressBar, ScrollArea, TextStyle, Ui, vec2};
use render::paint::strokes::Action;

use super::Desk;
use super::controls::{button, row, text};
use crate::theme;
use session::Command;

const MIB: f64 = 1024.0 * 1024.0;

/// Height of a row, in points.
const ROW: f32 = 20.0;

/// The panel of the history.
#[derive(Debug, Clone, Default)]
pub struct History {
    /// The place that the list last scrolled to.
    shown: Option<usize>,
}

impl History {
    /// Shows it.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        buttons(ui, desk);
        ui.scope(|ui| self.list(ui, desk));
        memory(ui, desk);
    }

    fn list(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let (done, count) = (desk.easel.history_done, desk.easel.history.len());
        let moved = self.shown != Some(done);
        self.shown = Some(done);
        let mut wanted = None;
        ui.spacing_mut().item_spacing.y = 1.0;
        let mut list = ScrollArea::vertical().max_height(260.0).auto_shrink([false, true]);
        if moved {
            // Rows out of sight are not laid out, so the place is told by number.
            let before = (done as f32 - 5.0).max(0.0);
            list = list.vertical_scroll_offset(before * (ROW + 1.0));
        }
        list.show_rows(ui, ROW, count + 1, |ui, rows| {
            for place in rows {
                let label = match place {
                    0 => "beginning",
                    _ => desk.easel.history[place - 1].as_str(),
                };
                let response = row(ui, ROW, &format!("{place} {label}"), place == done);
                let color = if place > done { theme::FAINT } else { theme::TEXT };
                let inner = response.rect.shrink2(vec2(6.0, 0.0));
                let (number, words) = inner.split_left_right_at_x(inner.left() + 34.0);
                text(ui, number, Align::Min, TextStyle::Small, theme::FAINT, &place.to_string());
                text(ui, words, Align::Min, TextStyle::Body, color, label);
                if response.clicked() && place != done {
                    wanted = Some(place);
                }
                let tip = match place.cmp(&done) {
                    std::cmp::Ordering::Less => "Takes back all that follows",
                    std::cmp::Ordering::Equal => "The painting is here",
                    std::cmp::Ordering::Greater => "Does all up to here again",
                };
                response.on_hover_text(tip);
            }
        });
        if let Some(place) = wanted {
            desk.command(Command::GoTo(place));
        }
    }
}

fn buttons(ui: &mut Ui, desk: &mut Desk<'_>) {
    let (done, count) = (desk.easel.history_done, desk.easel.history.len());
    ui.horizontal(|ui| {
        let nothing = (done == 0).then_some("there is nothing to take back");
        let tip = match done {
            0 => "Takes the last action back (Ctrl+Z)".to_owned(),
            _ => format!("Takes back: {} (Ctrl+Z)", desk.easel.history[done - 1]),
        };
        if button(ui, "Undo", &tip, nothing) {
            desk.act(Action::Undo {});
        }
        let nothing = (done == count).then_some("nothing was taken back");
        let tip = match desk.easel.history.get(done) {
            None => "Does again what was taken back (Ctrl+Shift+Z)".to_owned(),
            Some(label) => format!("Does again: {label} (Ctrl+Shift+Z)"),
        };
        if button(ui, "Redo", &tip, nothing) {
            desk.act(Action::Redo {});
        }
        ui.weak(format!("{done} of {count}"));
    });
}

fn memory(ui: &mut Ui, desk: &mut Desk<'_>) {
    let (kept, allowed) = desk.easel.undo_bytes;
    let share = if allowed > 0 { kept as f32 / allowed as f32 } else { 0.0 };
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let words = format!("{:.0} MiB", kept as f64 / MIB);
        let bar = ProgressBar::new(share).desired_width(ui.available_width() - 110.0);
        let bar = bar.desired_height(14.0).fill(theme::CHOSEN).text(words);
        ui.add(bar).accessible_name("Memory of undo").on_hover_text(
            "What undo keeps. When it is full, the oldest actions can no more be taken back.",
        );
        ui.label("of");
        let mut mebibytes = allowed as f64 / MIB;
        let field = DragValue::new(&mut mebibytes).range(16.0..=1_048_576.0).speed(16.0);
        let field = field.clamp_existing_to_range(false);
        let response = ui
            .add(field.fixed_decimals(0).suffix(" MiB").update_while_editing(false))
            .accessible_name("Memory allowed")
            .on_hover_text("How much undo may keep");
        if response.changed() {
            desk.command(Command::SetUndoBytes((mebibytes * MIB).round() as u64));
        }
    });
}
