//! The steps of the tour.

use super::facts::Facts;
use crate::app::intent::Intent;
use crate::language::{tr, tr_format};
use crate::panels::Mode;

/// A step of the guided tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TourStep {
    /// Paint from a tube on the brush.
    Load,
    /// A stroke on the canvas.
    Paint,
    /// A stroke through paint on the palette.
    Mix,
    /// The wet paint dries.
    Dry,
    /// A film of much medium over dry paint.
    Glaze,
    /// Another light over the painting.
    Relight,
}

impl TourStep {
    /// All steps in their order.
    pub const ALL: [Self; 6] =
        [Self::Load, Self::Paint, Self::Mix, Self::Dry, Self::Glaze, Self::Relight];

    /// Title of the step.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Load => "Load the brush",
            Self::Paint => "Paint a stroke",
            Self::Mix => "Mix on the palette",
            Self::Dry => "Dry the paint",
            Self::Glaze => "Lay a glaze",
            Self::Relight => "Change the light",
        }
    }

    /// Two lines that say how it is done. `key` is the text of the key of an intent; empty if it has
    /// none.
    #[must_use]
    pub fn lines(self, key: impl Fn(Intent) -> String) -> [String; 2] {
        let beside = |intent| match key(intent) {
            key if key.is_empty() => String::new(),
            key => format!(" ({key})"),
        };
        match self {
            Self::Load => [
                tr("Double click a tube: its paint is added to the brush.").to_owned(),
                tr("The Brush tab shows how much is on it, and its colour.").to_owned(),
            ],
            Self::Paint => [
                tr("Press on the canvas and draw.").to_owned(),
                tr("The brush empties, so load it again when it gets dry.").to_owned(),
            ],
            Self::Mix => [
                tr("Click a tube, then the palette, and so another: two heaps.").to_owned(),
                tr_format!(
                    "Choose Paint{key} and draw through both with the brush.",
                    key = beside(Intent::Tool(Mode::Paint))
                ),
            ],
            Self::Dry => [
                match key(Intent::Dry) {
                    key if key.is_empty() => tr("Press this button.").to_owned(),
                    key => tr_format!("Press {key}, or this button.", key),
                },
                tr("The wet paint becomes a dry layer that later strokes do not move.").to_owned(),
            ],
            Self::Glaze => [
                tr_format!(
                    "Wash{key}, set Medium to 99 % and Load to 0.10 mm, load a tube,",
                    key = beside(Intent::Wash)
                ),
                tr("and draw over dry paint: a thin film that it shines through.").to_owned(),
            ],
            Self::Relight => [
                match key(Intent::OtherLight) {
                    key if key.is_empty() => {
                        tr("Choose another light in the Light tab.").to_owned()
                    }
                    key => tr_format!(
                        "Press {key} for the light of a bulb, or choose one in the Light tab.",
                        key
                    ),
                },
                tr("The pigments change as real ones would.").to_owned(),
            ],
        }
    }

    /// Whether the step was done between the facts `before` and `now`.
    #[must_use]
    pub fn is_done(self, before: &Facts, now: &Facts) -> bool {
        match self {
            Self::Load => now.loaded_since(before),
            Self::Paint => now.painted_since(before),
            Self::Mix => now.mixed_since(before),
            Self::Dry => now.dried_since(before),
            Self::Glaze => now.glazed_since(before),
            Self::Relight => now.relit_since(before),
        }
    }
}
