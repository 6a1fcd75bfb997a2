//! The status line of the workspace of scenes.

use web_time::{Duration, Instant};

use eframe::egui::{Align, Label, Layout, RichText, Ui};
use session::volumes::SceneState;

use super::workspace::Volumes;
use crate::language::{tr, tr_format};
use crate::theme;

impl Volumes {
    /// Draws the status line.
    pub(super) fn status_line(&self, ui: &mut Ui) {
        let Some(state) = &self.state else {
            ui.weak(tr("preparing the scene"));
            return;
        };
        let faint = theme::colors(ui.ctx()).faint;
        let small = |text: &str| RichText::new(text).small().color(faint);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = 14.0;
            if state.time.playing {
                let speed = tr_format!("{speed:.0} % of real time", speed = 100.0 * state.time.speed);
                ui.label(small(&speed)).on_hover_text(tr("Speed of time over the last second"));
            }
            let moves = self.shown_at.is_some_and(|at| at.elapsed() < Duration::from_secs(1));
            let rate = if moves { self.frames.rate().frames_a_second } else { 0.0 };
            let rate = match rate.round() {
                1.0 => tr("1 picture/s").to_owned(),
                _ => tr_format!("{rate:.0} pictures/s", rate),
            };
            ui.label(small(&rate))
                .on_hover_text(tr("Pictures drawn in the last second; none while the scene rests"));
            ui.label(small(&paint_text(state)))
                .on_hover_text(tr("Paint poured, on the surfaces, taken up, and left in the tubes"));
            ui.label(small(&volumes_text(state)))
                .on_hover_text(tr("Volumes of paint, and the particles of all of them"));
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                if state.prepares {
                    ui.spinner();
                    ui.label(tr("mixing the paint")).on_hover_text(
                        tr("The pigments are prepared for the picture, which shows them when it is done"),
                    );
                }
                let message = self.message.as_ref();
                if let Some(message) =
                    message.filter(|message| message.is_displayed(Instant::now()))
                {
                    // A text that is cut tells all of itself under the pointer.
                    ui.add(Label::new(&message.text).truncate());
                }
            });
        });
    }
}

/// Where the paint is.
fn paint_text(state: &SceneState) -> String {
    let tally = &state.tally;
    let mut text = tr_format!("{poured_mm3} poured", poured_mm3 = cubic(tally.poured_mm3));
    for (amount, what) in
        [(tally.lifted_mm3, tr("taken up")), (tally.left_mm3, tr("left in the tubes"))]
    {
        if amount > 0.0 {
            text.push_str(&format!(", {} {what}", cubic(amount)));
        }
    }
    text
}

fn volumes_text(state: &SceneState) -> String {
    match state.tally.volumes {
        1 => tr("1 volume").to_owned(),
        count => tr_format!("{count} volumes", count),
    }
}

/// A volume with two digits or more.
fn cubic(mm3: f64) -> String {
    if mm3 >= 10.0 || mm3 == 0.0 { format!("{mm3:.0} mm3") } else { format!("{mm3:.1} mm3") }
}
