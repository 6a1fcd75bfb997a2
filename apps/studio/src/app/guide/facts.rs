//! Facts about a painting that tell whether a step of the tour was done.

use paint::document::Lighting;
use session::PaintingState;

/// Share of medium in the paint of a brush from which its film is a glaze.
const GLAZE: f64 = 0.9;

/// Paint on a brush, in mm, above which more of it is a load.
const LOAD_MM: f64 = 0.01;

/// Actions done to a painting, as far as the tour looks at them.
#[derive(Debug, Clone, PartialEq)]
pub struct Facts {
    /// Name of each brush, and height of its paint in mm.
    loads: Vec<(String, f64)>,
    /// Number of strokes on the canvas.
    strokes: usize,
    /// Number of strokes on the palette.
    mixing_strokes: usize,
    /// Number of dryings.
    dryings: usize,
    /// Whether the last stroke on the canvas laid a glaze over dry paint.
    glazed: bool,
    lighting: Lighting,
}

impl Facts {
    /// The facts of a painting, from its brushes, light and the actions that are not undone.
    #[must_use]
    pub fn of(painting: &PaintingState) -> Self {
        let done = &painting.history[..painting.history_done.min(painting.history.len())];
        let count = |start: &str| done.iter().filter(|label| label.starts_with(start)).count();
        let last = done.iter().rev().find_map(|label| label.strip_prefix("stroke, "));
        let is_glaze = |brush: &str| {
            let mut brushes = painting.brushes.iter();
            brushes.any(|state| state.name == brush && state.vehicle >= GLAZE)
        };
        Self {
            loads: painting
                .brushes
                .iter()
                .map(|brush: &session::BrushState| (brush.name.clone(), brush.amount_mm))
                .collect(),
            strokes: count("stroke, "),
            mixing_strokes: count("stroke on the palette"),
            dryings: count("dry "),
            glazed: !painting.layers.is_empty() && last.is_some_and(is_glaze),
            lighting: painting.lighting.clone(),
        }
    }

    /// Whether a brush holds more paint than `before`.
    pub(super) fn loaded_since(&self, before: &Self) -> bool {
        self.loads.iter().any(|(name, mm)| {
            let held = before.loads.iter().find(|(known, _)| known == name);
            *mm > held.map_or(0.0, |(_, mm)| *mm) + LOAD_MM
        })
    }

    /// Whether there was a stroke on the canvas since `before`.
    pub(super) fn painted_since(&self, before: &Self) -> bool {
        self.strokes > before.strokes
    }

    /// Whether there was a stroke on the palette since `before`.
    pub(super) fn mixed_since(&self, before: &Self) -> bool {
        self.mixing_strokes > before.mixing_strokes
    }

    /// Whether paint was dried since `before`.
    pub(super) fn dried_since(&self, before: &Self) -> bool {
        self.dryings > before.dryings
    }

    /// Whether there was a stroke of a glaze over dry paint since `before`.
    pub(super) fn glazed_since(&self, before: &Self) -> bool {
        self.painted_since(before) && self.glazed
    }

    /// Whether the light changed since `before`.
    pub(super) fn relit_since(&self, before: &Self) -> bool {
        self.lighting != before.lighting
    }

    /// Lowers the counts to those of `now`: undo takes actions away, and the oldest leave the
    /// history when its memory is full. A brush that was washed can be loaded again.
    pub(super) fn lower_to(&mut self, now: &Self) {
        self.strokes = self.strokes.min(now.strokes);
        self.mixing_strokes = self.mixing_strokes.min(now.mixing_strokes);
        self.dryings = self.dryings.min(now.dryings);
        for (name, mm) in &mut self.loads {
            let held = now.loads.iter().find(|(known, _)| known == name);
            *mm = mm.min(held.map_or(0.0, |(_, mm)| *mm));
        }
    }
}
