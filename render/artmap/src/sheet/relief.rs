//! Relief of a sample under a raking light, without its colours.

use graphics::field::Field;
use graphics::picture::Picture;
use rayon::prelude::*;

/// Height of the light above the canvas in degrees.
const ELEVATION_DEG: f32 = 25.0;

/// Linear grey of a level surface.
const LEVEL: f32 = 0.25;

/// A white surface of heights under one distant light from the upper left, 25 degrees above the
/// canvas, after Lambert: linear grey 0 to 1, a quarter where the surface is level. Nothing casts
/// shadows.
///
/// Texels beyond the passage count as high as the passage beside them.
///
/// # Panics
/// If heights and mask differ in size.
#[must_use]
pub fn raked(height_mm: &Field<f32>, mask: &Field<bool>, mm_per_texel: f64) -> Picture {
    assert_eq!(height_mm.bounds(), mask.bounds(), "heights and mask of one sample");
    let (width, height) = (height_mm.width(), height_mm.height());
    let (sin, cos) = ELEVATION_DEG.to_radians().sin_cos();
    let towards = [-cos * 0.5_f32.sqrt(), -cos * 0.5_f32.sqrt(), sin];
    let step = mm_per_texel as f32;
    let row = |y: usize| {
        let grey = move |x: usize| {
            let slope = |before: (usize, usize), after: (usize, usize)| {
                let [low, high] = [before, after].map(|at| if mask[at] { at } else { (x, y) });
                let texels = (high.0 - low.0) + (high.1 - low.1);
                if texels == 0 {
                    return 0.0;
                }
                (height_mm[high] - height_mm[low]) / (texels as f32 * step)
            };
            let across = slope((x.saturating_sub(1), y), ((x + 1).min(width - 1), y));
            let down = slope((x, y.saturating_sub(1)), (x, (y + 1).min(height - 1)));
            let facing = towards[2] - across * towards[0] - down * towards[1];
            let length = (1.0 + across * across + down * down).sqrt();
            let shade = facing.max(0.0) / (length * towards[2]);
            [(LEVEL * shade).min(1.0); 3]
        };
        (0..width).map(grey).collect::<Vec<_>>()
    };
    let rows = (0..height).into_par_iter().flat_map_iter(row).collect();
    Field::from_values(width, height, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Grey in the middle of a plane that rises by `across` and `down` per mm.
    fn plane(across: f32, down: f32) -> f32 {
        let height = |i: usize| 5.0 + 0.5 * (across * (i % 9) as f32 + down * (i / 9) as f32);
        let heights = Field::from_values(9, 9, (0..81).map(height).collect());
        raked(&heights, &Field::filled(9, 9, true), 0.5)[(4, 4)][0]
    }

    #[test]
    fn slopes_towards_the_upper_left_are_light_and_others_dark() {
        assert!((plane(0.0, 0.0) - LEVEL).abs() < 1e-6, "level: {}", plane(0.0, 0.0));
        assert!(plane(0.2, 0.2) > 1.4 * LEVEL, "faces the light: {}", plane(0.2, 0.2));
        assert!(plane(-0.2, -0.2) < 0.6 * LEVEL, "turned away: {}", plane(-0.2, -0.2));
        assert!((plane(0.3, -0.3) / LEVEL - 0.92).abs() < 0.02, "along it: {}", plane(0.3, -0.3));
        assert_eq!(plane(-2.0, -2.0), 0.0, "in its own shade");
        assert!(plane(5.0, 5.0) <= 1.0, "no brighter than white");
    }

    #[test]
    fn heights_beyond_the_passage_do_not_count() {
        let mut heights = Field::filled(6, 6, 0.4);
        let mut mask = Field::filled(6, 6, true);
        for y in 0..6 {
            (heights[(5, y)], mask[(5, y)]) = (90.0, false);
        }
        let found = raked(&heights, &mask, 0.25);
        for (x, y) in (0..6).flat_map(|y| (0..5).map(move |x| (x, y))) {
            assert!((found[(x, y)][0] - LEVEL).abs() < 1e-6, "{x}, {y}: {:?}", found[(x, y)]);
        }
    }
}
