//! The status line: message, view, canvas size, light and backend.

use web_time::{Duration, Instant};

use eframe::egui::{Align, Button, Context, Layout, RichText, Ui, vec2};

use crate::language::tr;
use crate::theme;

/// Display time of a message that is not an error.
const DISPLAY_TIME: Duration = Duration::from_secs(10);

/// A message in the status line.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// Message text, one sentence.
    pub text: String,
    /// Suggestion how to solve the problem, if any.
    pub hint: Option<String>,
    /// Whether it is an error, which stays until it is dismissed.
    pub failed: bool,
    /// Time at which it was shown first.
    pub shown_at: Instant,
}

impl Message {
    /// Whether the message is still displayed at `now`.
    #[must_use]
    pub fn is_displayed(&self, now: Instant) -> bool {
        self.failed || self.rest(now).is_some()
    }

    /// Time after `now` for which the message is still displayed; `None` if it is not, or if it
    /// stays until it is dismissed.
    #[must_use]
    pub fn rest(&self, now: Instant) -> Option<Duration> {
        let rest = DISPLAY_TIME.saturating_sub(now.saturating_duration_since(self.shown_at));
        (!self.failed && !rest.is_zero()).then_some(rest)
    }
}

/// Contents of the status line.
#[derive(Debug, Clone)]
pub(super) struct State<'a> {
    /// Last message, if still displayed.
    pub(super) message: Option<&'a Message>,
    /// Zoom and rotation, such as `42 %, 15 degrees`.
    pub(super) view: String,
    /// Canvas size in cells and mm.
    pub(super) size: String,
    /// Name of the illuminant, or of both.
    pub(super) light: String,
    /// Name of the compute backend.
    pub(super) backend: &'a str,
}

/// Height of the status line: an error has a button that may be touched.
pub(super) fn height(context: &Context, message: Option<&Message>) -> f32 {
    let has_button = message.is_some_and(|message| message.failed);
    if has_button && theme::is_touch(context) { theme::TOUCH_TARGET + 4.0 } else { 24.0 }
}

/// Draws the status line. Returns whether the message was dismissed.
pub(super) fn show(ui: &mut Ui, state: &State) -> bool {
    let mut dismissed = false;
    let faint = theme::colors(ui.ctx()).faint;
    let small = |text: &str| RichText::new(text).small().color(faint);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 14.0;
        ui.label(small(state.backend))
            .on_hover_text(tr("Processor or graphics adapter that computes the paint"));
        ui.label(small(&state.light)).on_hover_text(tr("The light of the painting"));
        ui.label(small(&state.size))
            .on_hover_text(tr("Size of the canvas in cells and in millimetres"));
        ui.label(small(&state.view))
            .on_hover_text(tr("Zoom in screen pixels per cell, and rotation"));
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let Some(message) = state.message else { return };
            ui.spacing_mut().item_spacing.x = 6.0;
            if message.failed {
                let side = theme::target(ui);
                let close = Button::new("x").min_size(vec2(side, side));
                let close = if side == 0.0 { close.small() } else { close };
                let close = ui.add(close).on_hover_text(tr("Dismisses this message"));
                dismissed = close.clicked();
            }
            let words = message
                .hint
                .as_ref()
                .map_or_else(|| message.text.clone(), |hint| format!("{}: {hint}", message.text));
            let color = if message.failed {
                theme::colors(ui.ctx()).strong
            } else {
                theme::colors(ui.ctx()).text
            };
            let mut text = RichText::new(&words).color(color);
            if message.failed {
                text = text.strong();
            }
            // A text that is cut tells all of itself under the pointer.
            ui.add(eframe::egui::Label::new(text).truncate());
        });
    });
    dismissed
}
