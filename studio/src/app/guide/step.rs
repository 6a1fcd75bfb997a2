//! The steps of the tour.

use super::facts::Facts;

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

    /// Two lines that say how it is done.
    #[must_use]
    pub fn lines(self) -> [&'static str; 2] {
        match self {
            Self::Load => [
                "Double click a tube: its paint is added to the brush.",
                "The Brush tab shows how much is on it, and its colour.",
            ],
            Self::Paint => [
                "Press on the canvas and draw.",
                "The brush empties, so load it again when it gets dry.",
            ],
            Self::Mix => [
                "Click a tube, then the palette, and so another: two heaps.",
                "Choose Paint (B) and draw through both with the brush.",
            ],
            Self::Dry => [
                "Press D, or this button.",
                "The wet paint becomes a dry layer that later strokes do not move.",
            ],
            Self::Glaze => [
                "Wash (W), set Medium to 99 % and Load to 0.10 mm, load a tube,",
                "and draw over dry paint: a thin film that it shines through.",
            ],
            Self::Relight => [
                "Press L for the light of a bulb, or choose one in the Light tab.",
                "The pigments change as real ones would.",
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
