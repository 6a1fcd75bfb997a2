//! Settings of layers: large strokes below, smaller ones above where they are needed.

use graphics::smoothstep;
use serde::{Deserialize, Serialize};

use super::figures::Figure;

/// Layers of strokes, each of smaller strokes than the one below.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LayerSettings {
    /// Number of layers, 1..=4.
    pub count: u32,
    /// Size of the strokes of a layer by that of the layer below, 0.2..=0.9.
    pub ratio: f32,
    /// How readily smaller strokes show, 0 (nowhere) to 1 (everywhere): where a model bends within
    /// a stroke of the layer below, or where a picture has detail that such a stroke does not show.
    pub detail: f32,
}

impl Default for LayerSettings {
    fn default() -> Self {
        Self { count: 1, ratio: 0.5, detail: 0.5 }
    }
}

impl LayerSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![
            Figure::new("layers.count", self.count, [1.0, 4.0]),
            Figure::new("layers.ratio", self.ratio, [0.2, 0.9]),
            Figure::new("layers.detail", self.detail, [0.0, 1.0]),
        ]
    }

    /// How much of a layer above the lowest shows where something is `amount` times as much as
    /// usual settings let pass: 0 to 1, without a step.
    pub(crate) fn shown(&self, amount: f32) -> f32 {
        // Half of the way lets pass what is usual, the end nothing.
        let passed = (1.0 - self.detail) / self.detail.max(1e-6);
        if passed <= 0.0 {
            return 1.0;
        }
        smoothstep([0.5, 1.5], amount / passed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn detail_shows_smaller_strokes_nowhere_to_everywhere() {
        let layers = |detail| LayerSettings { detail, ..LayerSettings::default() };
        assert_eq!(layers(0.0).shown(50.0), 0.0);
        assert_eq!(layers(1.0).shown(0.0), 1.0);
        assert_eq!((layers(0.5).shown(0.4), layers(0.5).shown(1.0)), (0.0, 0.5));
        assert!(layers(0.7).shown(0.7) > layers(0.5).shown(0.7));
    }
}
