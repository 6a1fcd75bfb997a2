//! Report of a sample that was taken.

use graphics::field::Field;

use super::direction::StrokeDirection;

/// Channel of the picture in which strokes were seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrokesSeen {
    /// In the lightness of the colours.
    Color,
    /// In the height of the paint, where that is known and not guessed.
    Relief,
}

/// Origin of the distance of strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpacingSource {
    /// Two points that the painter marked.
    Marked,
    /// Set for all samples whose marks give none.
    Set,
    /// Estimated by autocorrelation across the strokes.
    Estimated {
        /// Difference of the first maximum of the autocorrelation and the minimum before it, 0.1
        /// to 2. Larger is more reliable.
        sharpness: f64,
        /// Channel with the sharper maximum.
        seen: StrokesSeen,
    },
}

/// How one sample was taken.
#[derive(Debug, Clone, PartialEq)]
pub struct PassageReport {
    /// Name of the sample.
    pub name: String,
    /// Pixels of the passage in the picture.
    pub mask: Field<bool>,
    /// Number of regions of the over-segmentation under the scribble; 0 for a rectangle.
    pub regions_under: usize,
    /// Direction of the strokes.
    pub direction: StrokeDirection,
    /// Channel in which more of the gradients agree in direction.
    pub direction_seen: StrokesSeen,
    /// Distance of neighbouring strokes in pixels of the picture.
    pub spacing_px: f64,
    /// Origin of that distance.
    pub spacing_source: SpacingSource,
    /// Texels of the sample per pixel of the picture, across and along the strokes.
    pub scale: [f64; 2],
    /// Mean CIELAB lightness, 0 to 100.
    pub lightness: f64,
}

impl PassageReport {
    /// Number of pixels of the passage.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.mask.values().iter().filter(|inside| **inside).count()
    }

    /// Column and row of the upper left corner of the passage, its width and height, in pixels.
    #[must_use]
    pub fn bounds(&self) -> [usize; 4] {
        let width = self.mask.width();
        let height = self.mask.height();
        let inside = (0..width * height).filter(|&pixel| self.mask.values()[pixel]);
        let [mut left, mut top, mut right, mut below] = [width, height, 0, 0];
        for (x, y) in inside.map(|pixel| (pixel % width, pixel / width)) {
            (left, top) = (left.min(x), top.min(y));
            (right, below) = (right.max(x + 1), below.max(y + 1));
        }
        [left, top, right.saturating_sub(left), below.saturating_sub(top)]
    }
}
