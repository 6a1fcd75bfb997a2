//! Relief of paint under a raking light, without its colours, and blur of fields that tile.

use graphics::blurred;
use graphics::field::Field;
use graphics::picture::Picture;
use rayon::prelude::*;

/// Tangents of the least and the greatest elevation of the light, which are 2 and 40 degrees.
const TANGENTS: [f32; 2] = [0.035, 0.84];

/// Tangent of the elevation over the root mean square of the slopes. With 2.5, a usual slope is
/// 1.4 times as light or as dark as a level surface.
const PER_SLOPE: f32 = 2.5;

const LEVEL: f32 = 0.25;

/// Slopes of a surface to the right and downwards, as rise over run. They are 0 beyond the
/// passage. Texels beyond the passage count as high as the passage beside them.
///
/// # Panics
/// If heights and mask differ in size.
pub(crate) fn slopes(
    height_mm: &Field<f32>,
    mask: &Field<bool>,
    mm_per_texel: f64,
) -> Field<[f32; 2]> {
    assert_eq!(height_mm.bounds(), mask.bounds(), "heights and mask of one sample");
    let width = height_mm.width();
    let height = height_mm.height();
    let step = mm_per_texel as f32;
    let rows = (0..height)
        .into_par_iter()
        .flat_map_iter(|y: usize| {
            (0..width)
                .map(move |x: usize| {
                    let ends = [
                        [(x.saturating_sub(1), y), ((x + 1).min(width - 1), y)],
                        [(x, y.saturating_sub(1)), (x, (y + 1).min(height - 1))],
                    ];
                    let slopes = ends.map(|ends| {
                        let [low, high] = ends.map(|at| if mask[at] { at } else { (x, y) });
                        let texels = (high.0 - low.0) + (high.1 - low.1);
                        if texels == 0 {
                            return 0.0;
                        }
                        (height_mm[high] - height_mm[low]) / (texels as f32 * step)
                    });
                    if mask[(x, y)] { slopes } else { [0.0; 2] }
                })
                .collect::<Vec<_>>()
        })
        .collect();
    Field::from_values(width, height, rows)
}

/// Tangent of the elevation of a light that shows the relief of all surfaces. The flatter they
/// are, the lower this light stands, from 40 down to 2 degrees.
pub(crate) fn raking_tangent<'a>(surfaces: impl Iterator<Item = &'a Field<[f32; 2]>>) -> f32 {
    let mut sum = 0.0;
    let mut count = 0.0;
    for [across, down] in surfaces.flat_map(|surface| surface.values()) {
        sum += f64::from(across * across + down * down) / 2.0;
        count += 1.0;
    }
    let slope = (sum / f64::max(count, 1.0)).sqrt() as f32;
    (PER_SLOPE * slope).clamp(TANGENTS[0], TANGENTS[1])
}

/// Shows a white surface under one distant light from the upper left, after Lambert. You get a
/// linear grey of 0 to 1, a quarter where the surface is level. `tangent` is the tangent of the
/// light's elevation. Nothing casts shadows.
pub(crate) fn raked(slopes: &Field<[f32; 2]>, tangent: f32) -> Picture {
    // Half of the light's way along the canvas is from the left, half from above.
    let along = 0.5_f32.sqrt() / tangent;
    let values = slopes
        .values()
        .par_iter()
        .map(|&[across, down]: &[f32; 2]| {
            let facing = 1.0 + along * (across + down);
            let length = (1.0 + across * across + down * down).sqrt();
            [(LEVEL * facing / length).clamp(0.0, 1.0); 3]
        })
        .collect();
    Field::from_values(slopes.width(), slopes.height(), values)
}

/// Blurs a field that tiles in both directions by a Gaussian of standard deviation `sigma`, in
/// cells. The cells on opposite borders are neighbours.
pub(crate) fn blurred_tile(field: &Field<f32>, sigma: f64) -> Field<f32> {
    let width = field.width();
    let height = field.height();
    // The blur repeats the cells at the border. Four deviations stop this from reaching the tile.
    let margin = (4.0 * sigma).ceil() as usize;
    fn wrapped(index: usize, size: usize, margin: usize) -> usize {
        (index as isize - margin as isize).rem_euclid(size as isize) as usize
    }
    let wide = width + 2 * margin;
    let high = height + 2 * margin;
    let mut repeated = Vec::with_capacity(wide * high);
    for y in 0..high {
        for x in 0..wide {
            repeated.push([field[(wrapped(x, width, margin), wrapped(y, height, margin))]]);
        }
    }
    let smooth = blurred(&Field::from_values(wide, high, repeated), sigma);
    let mut values = Vec::with_capacity(width * height);
    for y in margin..margin + height {
        values.extend(smooth.row(y, margin, width).iter().map(|[value]| *value));
    }
    Field::from_values(width, height, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(across: f32, down: f32) -> Field<[f32; 2]> {
        let heights = Field::from_values(
            9,
            9,
            (0..81)
                .map(|i: usize| 5.0 + 0.5 * (across * (i % 9) as f32 + down * (i / 9) as f32))
                .collect(),
        );
        slopes(&heights, &Field::filled(9, 9, true), 0.5)
    }

    /// Grey in the middle of a plane with these slopes, under a light at 25 degrees.
    fn grey(across: f32, down: f32) -> f32 {
        raked(&plane(across, down), 25.0_f32.to_radians().tan())[(4, 4)][0]
    }

    #[test]
    fn slopes_are_rise_by_run_up_to_the_edges() {
        for [across, down] in plane(0.2, -0.1).values() {
            assert!((across - 0.2).abs() < 1e-5 && (down + 0.1).abs() < 1e-5, "{across} {down}");
        }
    }

    #[test]
    fn slopes_towards_the_upper_left_are_light_and_others_dark() {
        assert!((grey(0.0, 0.0) - LEVEL).abs() < 1e-6, "level: {}", grey(0.0, 0.0));
        assert!(grey(0.2, 0.2) > 1.4 * LEVEL, "faces the light: {}", grey(0.2, 0.2));
        assert!(grey(-0.2, -0.2) < 0.6 * LEVEL, "turned away: {}", grey(-0.2, -0.2));
        assert!((grey(0.3, -0.3) / LEVEL - 0.92).abs() < 0.02, "along it: {}", grey(0.3, -0.3));
        assert_eq!(grey(-2.0, -2.0), 0.0, "in its own shade");
        assert!(grey(5.0, 5.0) <= 1.0, "no brighter than white");
    }

    #[test]
    fn the_light_is_low_for_flat_paint() {
        fn tangent(slope: f32) -> f32 {
            raking_tangent([&plane(slope, slope)].into_iter())
        }
        assert!((tangent(0.1) - 0.25).abs() < 1e-3, "{}", tangent(0.1));
        assert!(tangent(0.05) < tangent(0.2), "{} {}", tangent(0.05), tangent(0.2));
        assert_eq!((tangent(0.0), tangent(9.0)), (TANGENTS[0], TANGENTS[1]));
    }

    #[test]
    fn heights_beyond_the_passage_do_not_count() {
        let mut heights = Field::filled(6, 6, 0.4);
        let mut mask = Field::filled(6, 6, true);
        for y in 0..6 {
            (heights[(5, y)], mask[(5, y)]) = (90.0, false);
        }
        let found = slopes(&heights, &mask, 0.25);
        assert!(found.values().iter().all(|slope| *slope == [0.0; 2]), "{found:?}");
    }

    #[test]
    fn a_blur_goes_over_the_border_and_keeps_the_sum() {
        let mut field = Field::filled(32, 24, 0.0);
        field[(0, 0)] = 1.0;
        let smooth = blurred_tile(&field, 3.0);
        let sum: f32 = smooth.values().iter().sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum}");
        for (a, b) in [((1, 0), (31, 0)), ((0, 2), (0, 22)), ((3, 1), (29, 23))] {
            assert!((smooth[a] - smooth[b]).abs() < 1e-7 && smooth[a] > 0.0);
        }
    }
}
