//! How much noise changes where it should have moved along: what is seen as
//! popping and sliding.

use rayon::prelude::*;

use super::sight::Sight;
use crate::field::Field;

/// A picture of noise, and of what it is on.
#[derive(Debug, Clone, Copy)]
pub struct NoiseShot<'a> {
    /// From where.
    pub sight: &'a Sight,
    /// The depth of every pixel, 1 where nothing is seen.
    pub depth: &'a Field<f32>,
    /// The noise.
    pub noise: &'a Field<f32>,
}

/// What was found, of one pair of pictures or of several.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Popping {
    /// Squared differences, summed.
    pub squares: f64,
    /// How many pixels could be compared.
    pub pixels: usize,
}

impl Popping {
    /// Compares every pixel that shows a place of the model with the pixel that
    /// showed this place before, by four pixels' interpolation; not with what was
    /// hidden then, nor where a surface ended.
    ///
    /// # Panics
    /// If a field is not of its picture's size.
    #[must_use]
    pub fn between(before: NoiseShot<'_>, after: NoiseShot<'_>) -> Self {
        for shot in [before, after] {
            let size = (shot.sight.width, shot.sight.height);
            for field in [shot.depth, shot.noise] {
                assert_eq!((field.width(), field.height()), size, "a field of another size");
            }
        }
        let rows = (0..after.sight.height).into_par_iter().map(|y| {
            let mut found = Self::default();
            for x in 0..after.sight.width {
                let depth = after.depth[(x, y)];
                if depth < 1.0
                    && let Some(was) = noise_before(before, after.sight, (x, y), depth)
                {
                    found.squares += f64::from(after.noise[(x, y)] - was).powi(2);
                    found.pixels += 1;
                }
            }
            found
        });
        let rows: Vec<Self> = rows.collect();
        rows.into_iter().fold(Self::default(), Self::and)
    }

    /// Both together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self { squares: self.squares + other.squares, pixels: self.pixels + other.pixels }
    }

    /// The root of the mean square; 0 where nothing was compared.
    #[must_use]
    pub fn rms(&self) -> f64 {
        (self.squares / self.pixels.max(1) as f64).sqrt()
    }
}

fn noise_before(
    before: NoiseShot<'_>,
    sight: &Sight,
    pixel: (usize, usize),
    depth: f32,
) -> Option<f32> {
    let at = before.sight.project(sight.place(pixel, depth))?;
    let (left, top) = ((at.x - 0.5).floor(), (at.y - 0.5).floor());
    let inside = |at: f32, size: usize| at >= 0.0 && at < size as f32 - 1.0;
    if !inside(left, before.sight.width) || !inside(top, before.sight.height) {
        return None;
    }
    let (x, y) = (left as usize, top as usize);
    let (right, down) = (at.x - 0.5 - left, at.y - 0.5 - top);
    let mix = |field: &Field<f32>| {
        let row = |y| field[(x, y)] * (1.0 - right) + field[(x + 1, y)] * right;
        row(y) * (1.0 - down) + row(y + 1) * down
    };
    let corners = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
    let all_seen = corners.iter().all(|&corner| before.depth[corner] < 1.0);
    // Three pixels in depth.
    let slack = 3.0 * before.sight.depth_scale() / (before.sight.focal_px * at.distance);
    let same = (mix(before.depth) - at.depth).abs() < slack;
    (all_seen && same).then(|| mix(before.noise))
}
