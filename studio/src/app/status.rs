//! The line below: what was said, the view, the light.

use std::time::{Duration, Instant};

use eframe::egui::{Align, Layout, RichText, Ui};

use crate::theme;

/// How long something that did not fail stays.
const STAYS: Duration = Duration::from_secs(10);

/// Something that was said to the painter.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// One sentence.
    pub text: String,
    /// What to try.
    pub hint: Option<String>,
    /// Whether something failed; such stays until it is put away.
    pub failed: bool,
    /// When it was said.
    pub said: Instant,
}

impl Message {
    /// Whether it is still to be seen.
    #[must_use]
    pub fn stays(&self, now: Instant) -> bool {
        self.failed || now.saturating_duration_since(self.said) < STAYS
    }
}

/// What the line shows.
#[derive(Debug, Clone)]
pub(super) struct State<'a> {
    /// What was said last.
    pub(super) message: Option<&'a Message>,
    /// Zoom and turn: `42 %`, `15 degrees`.
    pub(super) view: String,
    /// The canvas in cells and mm.
    pub(super) size: String,
    /// The light.
    pub(super) light: String,
    /// What computes.
    pub(super) backend: &'a str,
}

/// Shows it; whether the message is to be put away.
pub(super) fn show(ui: &mut Ui, state: &State) -> bool {
    let mut put_away = false;
    let small = |text: &str| RichText::new(text).small().color(theme::FAINT);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 14.0;
        ui.label(small(state.backend)).on_hover_text("What moves the paint");
        ui.label(small(&state.light)).on_hover_text("The light of the painting");
        ui.label(small(&state.size)).on_hover_text("The canvas: cells, and millimetres");
        ui.label(small(&state.view)).on_hover_text("Pixels of the screen a cell, and the turn");
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let Some(message) = state.message else { return };
            ui.spacing_mut().item_spacing.x = 6.0;
            if message.failed {
                let close = ui.small_button("x").on_hover_text("Puts this away");
                put_away = close.clicked();
            }
            let words = message
                .hint
                .as_ref()
                .map_or_else(|| message.text.clone(), |hint| format!("{}: {hint}", message.text));
            let color = if message.failed { theme::STRONG } else { theme::TEXT };
            let mut text = RichText::new(&words).color(color);
            if message.failed {
                text = text.strong();
            }
            ui.add(eframe::egui::Label::new(text).truncate()).on_hover_text(&words);
        });
    });
    put_away
}
