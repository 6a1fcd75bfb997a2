//! Relief of a tile under a raking light.

use glam::Vec3;
use graphics::field::Field;

/// Direction towards the light: from the upper left, 35 degrees above the surface.
const LIGHT: Vec3 = Vec3::new(-0.58, -0.58, 0.57);
/// Share of light on level places that comes from everywhere and reaches steep ones too.
const AMBIENT: f32 = 0.25;
/// Brightness of level places, linear.
const LEVEL: f32 = 0.14;
/// Root mean square of the slopes where the width of a texel is unknown.
const SLOPE: f32 = 0.25;

/// Brightness of a matt grey surface with the heights of a tile, in mm, under a light from the
/// upper left; linear, level places at 0.14. Where the width of a texel is unknown, heights are
/// scaled to a mean slope.
pub(super) fn raked(height_mm: &Field<f32>, mm_per_texel: Option<f64>) -> Field<[f32; 3]> {
    let (width, height) = (height_mm.width(), height_mm.height());
    let mut slopes = Vec::with_capacity(width * height);
    for y in 0..height {
        for x in 0..width {
            let (right, left) = ((x + 1) % width, (x + width - 1) % width);
            let (below, above) = ((y + 1) % height, (y + height - 1) % height);
            slopes.push([
                0.5 * (height_mm[(right, y)] - height_mm[(left, y)]),
                0.5 * (height_mm[(x, below)] - height_mm[(x, above)]),
            ]);
        }
    }
    let per_texel = mm_per_texel.map_or_else(|| per_mean_slope(&slopes), |mm| 1.0 / mm as f32);
    let light = LIGHT.normalize();
    let shade = |[u, v]: &[f32; 2]| {
        let normal = Vec3::new(-u * per_texel, -v * per_texel, 1.0).normalize();
        let direct = normal.dot(light).max(0.0) / light.z;
        [LEVEL * (AMBIENT + (1.0 - AMBIENT) * direct); 3]
    };
    Field::from_values(width, height, slopes.iter().map(shade).collect())
}

/// The factor that brings slopes to the mean slope; 0 for a level surface.
fn per_mean_slope(slopes: &[[f32; 2]]) -> f32 {
    let squares: f32 = slopes.iter().map(|[u, v]| u * u + v * v).sum();
    let mean = (squares / slopes.len().max(1) as f32).sqrt();
    if mean > 0.0 { SLOPE / mean } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ridge along y of 0.2 mm, in the middle of the columns.
    fn ridge(at: usize) -> Field<f32> {
        let value = |index: usize| if index % 16 == at { 0.2 } else { 0.0 };
        Field::from_values(16, 8, (0..16 * 8).map(value).collect())
    }

    #[test]
    fn slopes_towards_the_light_are_bright_and_those_away_dark() {
        for mm_per_texel in [Some(0.2), None] {
            let shaded = raked(&ridge(8), mm_per_texel);
            let [left, top, right, far] = [7, 8, 9, 3].map(|x| shaded[(x, 4)][0]);
            assert!(left > 1.1 * LEVEL && right < 0.9 * LEVEL, "{left} {right}");
            assert!((top - LEVEL).abs() < 1e-6 && (far - LEVEL).abs() < 1e-6, "{top} {far}");
        }
    }

    #[test]
    fn relief_goes_on_over_the_border() {
        let (inside, border) = (raked(&ridge(8), Some(0.1)), raked(&ridge(0), Some(0.1)));
        for x in 0..16 {
            assert_eq!(inside[((x + 8) % 16, 2)], border[(x, 2)]);
        }
    }

    #[test]
    fn a_level_surface_is_even() {
        for mm_per_texel in [Some(0.2), None] {
            let shaded = raked(&Field::filled(5, 4, 0.7), mm_per_texel);
            assert!(shaded.values().iter().all(|rgb| (rgb[0] - LEVEL).abs() < 1e-6));
        }
    }
}
