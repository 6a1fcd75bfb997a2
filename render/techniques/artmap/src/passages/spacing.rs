//! Distance of neighbouring strokes, estimated by autocorrelation.

use graphics::blurred;
use graphics::field::Field;
use rayon::prelude::*;

use super::frame::Frame;

/// Smallest difference of maximum and minimum of the autocorrelation.
const LEAST_SHARPNESS: f64 = 0.1;

/// Smallest autocorrelation at the maximum. Blotches of one size without order have a minimum too,
/// from which the autocorrelation rises to about 0.
const LEAST_PEAK: f64 = 0.1;

/// Rise or fall of the autocorrelation that counts as one.
const RIPPLE: f64 = 0.02;

/// Standard deviation in pixels of the smoothing against noise.
const NOISE_SIGMA: f64 = 1.0;

/// Largest distance that is looked for, as a share of the passage's width.
const LARGEST_SHARE: f64 = 1.0 / 4.0;

/// An estimated distance of strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    /// Distance of neighbouring strokes in pixels.
    pub(super) spacing_px: f64,
    /// Difference of the first maximum of the autocorrelation and the minimum before it, up to 2.
    pub(super) sharpness: f64,
}

/// Distance of strokes among the true pixels of `mask`, which run along `along`. If `turned` is
/// false, strokes have no direction, and the mean over x and y is taken.
///
/// The first minimum of the autocorrelation across the strokes and the maximum after it are looked
/// for; a parabola through the maximum gives fractions of a pixel. `None` if there is none, if
/// the sharpness is below 0.1, or if the maximum itself is.
pub(super) fn estimated(
    intensity: &Field<f32>,
    mask: &Field<bool>,
    along: [f64; 2],
    turned: bool,
) -> Option<Estimate> {
    let mut correlation = across(intensity, mask, along);
    if !turned {
        let other = across(intensity, mask, [along[1], -along[0]]);
        correlation.truncate(other.len());
        correlation.iter_mut().zip(other).for_each(|(one, other)| *one = (*one + other) / 2.0);
    }
    first_peak(&correlation)
}

/// Autocorrelation across the strokes, at distances of 0, 1, .. pixels.
fn across(intensity: &Field<f32>, mask: &Field<bool>, along: [f64; 2]) -> Vec<f64> {
    let frame = Frame::around(mask, along, [1.0; 2]);
    let upright = frame.resampled(mask, |taps| {
        taps.iter().map(|&(pixel, weight)| weight * intensity.values()[pixel]).sum::<f32>()
    });
    let detail = detail(&upright);
    let width = detail.width();
    let largest = (width as f64 * LARGEST_SHARE) as usize;
    (0..=largest).into_par_iter().map(|lag| correlation(&detail, lag)).collect()
}

/// Detail of the intensity and 1 in the passage, zeros elsewhere: the difference of a narrow and a
/// wide mean, neither of which looks beyond the passage.
fn detail(upright: &Field<Option<f32>>) -> Field<[f32; 2]> {
    let width = upright.width();
    let height = upright.height();
    let weighted = upright.values().iter().map(|value| value.map_or([0.0; 2], |v| [v, 1.0]));
    let weighted = Field::from_values(width, height, weighted.collect());
    let narrow = blurred(&weighted, NOISE_SIGMA);
    let wide = blurred(&weighted, width.max(6) as f64 / 6.0);
    let means = narrow.values().iter().zip(wide.values()).zip(upright.values());
    let detail = means.map(|((narrow, wide), inside)| match inside {
        Some(_) => [narrow[0] / narrow[1] - wide[0] / wide[1], 1.0],
        None => [0.0; 2],
    });
    Field::from_values(width, height, detail.collect())
}

/// Correlation of the detail with itself `lag` pixels to the right.
fn correlation(detail: &Field<[f32; 2]>, lag: usize) -> f64 {
    let width = detail.width();
    let mut product = 0.0;
    let mut left = 0.0;
    let mut right = 0.0;
    for row in detail.values().chunks_exact(width.max(1)) {
        for (one, other) in row.iter().zip(&row[lag..]) {
            let both = f64::from(one[1] * other[1]);
            let [one, other] = [one, other].map(|detail| f64::from(detail[0]) * both);
            product += one * other;
            left += one * one;
            right += other * other;
        }
    }
    let norm = (left * right).sqrt();
    if norm > 1e-12 { product / norm } else { 0.0 }
}

/// The first maximum after the first minimum, each of which stands out by [`RIPPLE`]; `None` if it
/// is not clear.
fn first_peak(correlation: &[f64]) -> Option<Estimate> {
    let mut valley = 0;
    let mut peak = None;
    for (lag, &value) in correlation.iter().enumerate().skip(1) {
        match peak {
            None if value < correlation[valley] => valley = lag,
            None if value > correlation[valley] + RIPPLE => peak = Some(lag),
            Some(highest) if value > correlation[highest] => peak = Some(lag),
            Some(highest) if value < correlation[highest] - RIPPLE => {
                let [before, top, after] =
                    [highest - 1, highest, highest + 1].map(|i| correlation[i]);
                let bend = before - 2.0 * top + after;
                let shift = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
                let sharpness = top - correlation[valley];
                let spacing_px = highest as f64 + shift.clamp(-0.5, 0.5);
                let clear = sharpness >= LEAST_SHARPNESS && top >= LEAST_PEAK;
                return clear.then_some(Estimate { spacing_px, sharpness });
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::made_up::{Brush, Texture, textured};
    use super::super::perceived::intensity_of;
    use super::*;

    fn estimate(texture: Texture) -> Option<Estimate> {
        let (sin, cos) = texture.degrees.to_radians().sin_cos();
        let picture = textured(200, 150, 11, &[texture], |_, _| 0);
        let mask = Field::filled(200, 150, true);
        estimated(&intensity_of(&picture), &mask, [cos, sin], texture.brush.has_direction())
    }

    #[test]
    fn spacings_are_within_8_percent_on_four_brushes_of_five_or_refused() {
        for (degrees, spacing) in [(90.0, 12.0), (30.0, 9.5), (140.0, 17.0)] {
            let mut near = 0;
            for brush in Brush::ALL {
                let texture = Texture { brush, degrees, spacing, ..Texture::default() };
                let Some(found) = estimate(texture) else { continue };
                let off = found.spacing_px / spacing - 1.0;
                assert!(off.abs() < 0.08, "{brush:?} {degrees} {spacing}: {found:?}");
                near += 1;
            }
            assert!(near >= 4, "{near} of 5 brushes at {degrees}, {spacing}");
        }
    }

    #[test]
    fn a_peak_is_refined_between_pixels_and_noise_is_refused() {
        let wave = |lag: usize| (std::f64::consts::TAU * lag as f64 / 10.4).cos();
        let found = first_peak(&(0..30).map(wave).collect::<Vec<_>>()).unwrap();
        assert!((found.spacing_px - 10.4).abs() < 0.05, "{found:?}");
        assert!(found.sharpness > 1.8, "{found:?}");
        let falling: Vec<f64> = (0..30).map(|lag| (-0.2 * f64::from(lag)).exp()).collect();
        assert_eq!(first_peak(&falling), None);
        let faint = |height: f64| -> Vec<f64> {
            (0..30).map(|lag| height * wave(lag) - if lag > 0 { 0.3 } else { 0.0 }).collect()
        };
        assert_eq!(first_peak(&faint(0.35)), None, "a maximum near 0 is none");
        assert!(first_peak(&faint(0.6)).is_some(), "one of 0.3 is");
        let flat = Field::filled(80, 60, 0.5);
        assert_eq!(estimated(&flat, &Field::filled(80, 60, true), [0.0, 1.0], true), None);
    }
}
