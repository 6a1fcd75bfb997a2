//! The list of events of a scene.

use std::sync::Arc;

use eframe::egui::{Align, ScrollArea, TextStyle, Ui, vec2};
use session::volumes::VolumeCommand;

use super::context::SceneContext;
use super::time_bar::seconds_text;
use crate::keymap::hint;
use crate::language::{tr, tr_format};
use crate::panels::controls::{button, named_button, row, row_height};
use crate::panels::fitted_text::text;
use crate::theme;

/// Height of a row, in points.
const ROW: f32 = 22.0;

/// Width of the button that removes an event, with its gap, in points.
const REMOVE: f32 = 28.0;

/// Draws the list. A click goes to the moment at which an event begins.
pub(super) fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let events = Arc::clone(&cx.state.events);
    ui.horizontal(|ui| {
        let reason = events.is_empty().then_some(tr("nothing was done yet"));
        let key = hint(ui.ctx(), "scene.undo");
        let tip =
            tr_format!("Takes back what was done last, and replays the scene without it{key}", key);
        if button(ui, tr("Undo"), &tip, reason) {
            cx.command(VolumeCommand::Undo);
        }
        ui.weak(match events.len() {
            0 => tr("no events yet").to_owned(),
            1 => tr("1 event").to_owned(),
            count => tr_format!("{count} events", count),
        });
    });
    ui.spacing_mut().item_spacing.y = 1.0;
    let list = ScrollArea::vertical().auto_shrink([false, true]);
    let high = row_height(ui, ROW);
    let remove = REMOVE.max(theme::target(ui));
    list.show_rows(ui, high, events.len(), |ui, rows| {
        for number in rows {
            let event = &events[number];
            let began = seconds_text(event.from);
            ui.horizontal(|ui| {
                let runs = event.from <= cx.state.time.step && cx.state.time.step < event.to;
                let width = ui.available_width() - remove;
                let line = ui.allocate_ui(vec2(width, high), |ui| {
                    row(ui, high, &format!("{} {}", number + 1, event.label), runs)
                });
                let response = line.inner;
                let inner = response.rect.shrink2(vec2(6.0, 0.0));
                let (time, label) = inner.split_left_right_at_x(inner.left() + 58.0);
                let colors = theme::colors(ui.ctx());
                let faint = if runs { colors.text } else { colors.faint };
                text(ui, time, Align::Min, TextStyle::Small, faint, &began);
                text(
                    ui,
                    label,
                    Align::Min,
                    TextStyle::Body,
                    theme::colors(ui.ctx()).text,
                    &event.label,
                );
                if response.on_hover_text(tr("Goes to the moment at which it begins")).clicked() {
                    cx.command(VolumeCommand::Seek(event.from));
                }
                let name = tr_format!("Remove event {number}", number = number + 1);
                let tip = tr("Removes it, and replays the scene without it");
                if named_button(ui, "x", &name, tip, None) {
                    cx.command(VolumeCommand::Remove(number));
                }
            });
        }
    });
}
