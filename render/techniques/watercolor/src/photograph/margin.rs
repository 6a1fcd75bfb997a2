//! A ragged margin: brush strokes end before the border of the paper.

use crate::settings::MarginSettings;
use graphics::noise::{Hills, random};

/// The margin of a picture of one size.
pub(super) struct Margin {
    width_px: f32,
    ragged_px: f32,
    size: [f32; 2],
    hills: [Hills; 3],
}

impl Margin {
    /// The margin of a picture of `width` x `height` pixels. `None` if it is painted to its
    /// borders.
    pub(super) fn new(width: usize, height: usize, settings: &MarginSettings) -> Option<Self> {
        let MarginSettings { width_px, ragged_px, seed } = *settings;
        let mut noise = random(seed, 47);
        let hills = std::array::from_fn(|_| Hills::new(&mut noise));
        let size = [width as f32, height as f32];
        (width_px > 0.0).then_some(Self { width_px, ragged_px, size, hills })
    }

    /// The share of the pixel at `x`, `y` that is painted, 0 to 1.
    pub(super) fn painted(&self, x: usize, y: usize) -> f32 {
        let x = x as f32 + 0.5;
        let y = y as f32 + 0.5;
        let [width, height] = self.size;
        let sides = [x.min(width - x), y.min(height - y)];
        let most = self.width_px + 2.0 * self.ragged_px;
        if sides[0].min(sides[1]) > most {
            return 1.0;
        }
        let ragged = self.ragged_px.max(1.0);
        let [strokes, bristles, wander] = &self.hills;
        // Strokes run from side to side: they end at different places to the left and right,
        // and their sides wander a little at the top and bottom.
        let side = if x < width - x { 0.0 } else { 511.5 };
        let end = 0.7 * strokes.at(side + x / (12.0 * ragged), y / (5.0 * ragged))
            + 0.12 * bristles.at(side + x / (4.0 * ragged), y / (1.2 * ragged));
        let row = if y < height - y { 0.0 } else { 511.5 };
        let edge = 0.5 * wander.at(x / (7.0 * ragged), row + y / (7.0 * ragged))
            + 0.12 * strokes.at(x / ragged, row + y / ragged);
        let across = sides[0] + self.ragged_px * 1.6 * end;
        let along = sides[1] + self.ragged_px * 1.6 * edge;
        (across.min(along) - self.width_px + 0.5).clamp(0.0, 1.0)
    }
}
