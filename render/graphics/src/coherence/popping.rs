//! Measures popping and sliding: how much noise changes between two frames at the same
//! point of the object.

use rayon::prelude::*;

use super::projection::Projection;
use crate::field::Field;

/// One frame of noise, with the depth of the object under it.
#[derive(Debug, Clone, Copy)]
pub struct NoiseFrame<'a> {
    /// The camera and picture size of the frame.
    pub projection: &'a Projection,
    /// Depth of each pixel, 1 where the object is not seen.
    pub depth: &'a Field<f32>,
    /// Noise at each pixel.
    pub noise: &'a Field<f32>,
}

/// Differences of noise between frames, summed over one pair of frames or several.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Popping {
    /// Sum of squared differences.
    pub squares: f64,
    /// Number of pixels that could be compared.
    pub pixels: usize,
}

impl Popping {
    /// Compares each pixel of `after` with the noise of `before` at the same point of the
    /// object, interpolated between four pixels. Points that were hidden before, or next
    /// to the edge of a surface, are left out.
    ///
    /// # Panics
    /// If a field does not have the size of its frame.
    #[must_use]
    pub fn between(before: NoiseFrame<'_>, after: NoiseFrame<'_>) -> Self {
        for frame in [before, after] {
            let size = (frame.projection.width, frame.projection.height);
            for field in [frame.depth, frame.noise] {
                assert_eq!(
                    (field.width(), field.height()),
                    size,
                    "depth and noise must have the size of the frame"
                );
            }
        }
        let rows = (0..after.projection.height).into_par_iter().map(|y| {
            let mut found = Self::default();
            for x in 0..after.projection.width {
                let depth = after.depth[(x, y)];
                if depth < 1.0
                    && let Some(noise) = noise_before(before, after.projection, (x, y), depth)
                {
                    found.squares += f64::from(after.noise[(x, y)] - noise).powi(2);
                    found.pixels += 1;
                }
            }
            found
        });
        let rows: Vec<Self> = rows.collect();
        rows.into_iter().fold(Self::default(), Self::merge)
    }

    /// The sum of two measurements.
    #[must_use]
    pub fn merge(self, other: Self) -> Self {
        Self { squares: self.squares + other.squares, pixels: self.pixels + other.pixels }
    }

    /// Root mean square difference; 0 if no pixel could be compared.
    #[must_use]
    pub fn rms(&self) -> f64 {
        (self.squares / self.pixels.max(1) as f64).sqrt()
    }
}

fn noise_before(
    before: NoiseFrame<'_>,
    projection: &Projection,
    pixel: (usize, usize),
    depth: f32,
) -> Option<f32> {
    let at = before.projection.project(projection.unproject(pixel, depth))?;
    let left = (at.x - 0.5).floor();
    let top = (at.y - 0.5).floor();
    let inside = |at: f32, size: usize| at >= 0.0 && at < size as f32 - 1.0;
    if !inside(left, before.projection.width) || !inside(top, before.projection.height) {
        return None;
    }
    let x = left as usize;
    let y = top as usize;
    let right = at.x - 0.5 - left;
    let down = at.y - 0.5 - top;
    let mix = |field: &Field<f32>| {
        let row = |y| field[(x, y)] * (1.0 - right) + field[(x + 1, y)] * right;
        row(y) * (1.0 - down) + row(y + 1) * down
    };
    let corners = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
    let all_seen = corners.iter().all(|&corner| before.depth[corner] < 1.0);
    // Tolerance in depth: about the change over three pixels of a slanted surface.
    let slack = 3.0 * before.projection.depth_scale() / (before.projection.focal_px * at.distance);
    let same = (mix(before.depth) - at.depth).abs() < slack;
    (all_seen && same).then(|| mix(before.noise))
}
