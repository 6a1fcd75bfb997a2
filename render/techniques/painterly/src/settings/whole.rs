//! All settings of painterly rendering together.

use serde::{Deserialize, Serialize};

use super::figures::Figure;
use super::layers::LayerSettings;
use super::look::{ColorSettings, FlowSettings, LightSettings, SilhouetteSettings};
use super::picture::PictureSettings;
use super::strokes::{OverlapSettings, StrokeSettings};

/// The style in which a map is painted on a model. Keys that a file leaves out have the defaults.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Longer side in px of the picture that lengths refer to, 16..=65536; in pictures of
    /// another size lengths are scaled in proportion.
    pub reference_px: f32,
    /// Size, direction and place of strokes.
    pub strokes: StrokeSettings,
    /// How strokes that cover a place share it.
    pub overlap: OverlapSettings,
    /// Layers of strokes of several sizes.
    pub layers: LayerSettings,
    /// Light, which chooses tones.
    pub light: LightSettings,
    /// Colour of strokes.
    #[serde(rename = "colour")]
    pub color: ColorSettings,
    /// Strokes along outlines.
    pub silhouette: SilhouetteSettings,
    /// Strokes that flow along the surface.
    pub flow: FlowSettings,
    /// Pictures with a depth.
    pub picture: PictureSettings,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            reference_px: 1000.0,
            strokes: StrokeSettings::default(),
            overlap: OverlapSettings::default(),
            layers: LayerSettings::default(),
            light: LightSettings::default(),
            color: ColorSettings::default(),
            silhouette: SilhouetteSettings::default(),
            flow: FlowSettings::default(),
            picture: PictureSettings::default(),
        }
    }
}

impl Settings {
    /// The settings for a picture of `width` x `height` pixels: all lengths are scaled from
    /// the reference to its pixels. Applying this twice changes nothing. Scaled lengths may be
    /// outside of the documented ranges, which hold for the reference.
    #[must_use]
    pub fn for_size(&self, width: usize, height: usize) -> Self {
        let longer = width.max(height).max(1) as f32;
        let mut own = self.clone();
        own.strokes.scale(longer / self.reference_px);
        own.silhouette.scale(longer / self.reference_px);
        own.reference_px = longer;
        own
    }

    /// The settings of one layer, counted from the lowest: smaller strokes on each. Only the
    /// uppermost has outlines.
    pub(crate) fn of_layer(&self, layer: u32) -> Self {
        let mut own = self.clone();
        own.strokes.scale(self.layers.ratio.powi(layer as i32));
        own.strokes.seed = self.strokes.seed.wrapping_add(u64::from(layer) << 32);
        if layer + 1 < self.layers.count {
            own.silhouette.width_px = 0.0;
        }
        own
    }

    pub(super) fn figures(&self) -> Vec<Figure> {
        let own = vec![Figure::new("reference_px", self.reference_px, [16.0, 65536.0])];
        [
            own,
            self.strokes.figures(),
            self.overlap.figures(),
            self.layers.figures(),
            self.light.figures(),
            self.color.figures(),
            self.silhouette.figures(),
            self.flow.figures(),
            self.picture.figures(),
        ]
        .concat()
    }
}
