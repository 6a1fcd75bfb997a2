//! Colours of a picture as they are compared: CIELUV, and intensity with its gradient.

use graphics::blurred;
use graphics::field::Field;
use graphics::picture::Picture;
use rayon::prelude::*;
use spectra::color::{Luv, Rgb, RgbSpace};

/// Smoothing before gradients are taken, as a standard deviation in pixels.
const GRADIENT_SIGMA: f64 = 1.0;

/// CIELUV of every pixel, relative to the white of sRGB.
pub(super) fn luv_of(picture: &Picture) -> Field<[f32; 3]> {
    let white = RgbSpace::Srgb.white();
    let xyz = RgbSpace::Srgb.xyz_from_linear();
    mapped(picture, |color| {
        let xyz = xyz.apply(color.map(|value| f64::from(value.max(0.0))));
        Luv::from_xyz(xyz.into(), white).to_array().map(|value| value as f32)
    })
}

/// Intensity of every pixel: luminance encoded by the curve of sRGB, 0 to 1.
pub(super) fn intensity_of(picture: &Picture) -> Field<f32> {
    let weights = RgbSpace::Srgb.xyz_from_linear().0[1];
    mapped(picture, |color| {
        let parts = weights.iter().zip(color);
        let luminance: f64 = parts.map(|(weight, value)| weight / 100.0 * f64::from(value)).sum();
        Rgb([luminance.clamp(0.0, 1.0); 3]).encoded().0[0] as f32
    })
}

/// Gradient of the intensity per pixel, to the right and down, of the slightly smoothed picture.
pub(super) fn gradient_of(intensity: &Field<f32>) -> Field<[f32; 2]> {
    let width = intensity.width();
    let height = intensity.height();
    let single = intensity.values().iter().map(|&value| [value]).collect();
    let smooth = blurred(&Field::from_values(width, height, single), GRADIENT_SIGMA);
    let mut gradient = Field::filled(width, height, [0.0; 2]);
    gradient.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        let above = y.saturating_sub(1);
        let below = (y + 1).min(height - 1);
        for (x, found) in row.iter_mut().enumerate() {
            let left = x.saturating_sub(1);
            let right = (x + 1).min(width - 1);
            // Scharr's weights have the least error in direction (Jaehne 1999).
            let side = |[a, b, c]: [(usize, usize); 3]| {
                3.0 * (smooth[a][0] + smooth[c][0]) + 10.0 * smooth[b][0]
            };
            let over_x = side([(right, above), (right, y), (right, below)])
                - side([(left, above), (left, y), (left, below)]);
            let over_y = side([(left, below), (x, below), (right, below)])
                - side([(left, above), (x, above), (right, above)]);
            *found = [over_x / 32.0, over_y / 32.0];
        }
    });
    gradient
}

fn mapped<T: Send>(picture: &Picture, map: impl Fn([f32; 3]) -> T + Sync) -> Field<T> {
    let values = picture.values().par_iter().with_min_len(4096).map(|&color| map(color)).collect();
    Field::from_values(picture.width(), picture.height(), values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_a_middle_grey_have_their_lightness_and_intensity() {
        // Luminance 0.2140 is encoded 0.5 and has L* 53.39.
        let picture = Field::from_values(3, 1, vec![[1.0; 3], [0.214_041; 3], [0.0; 3]]);
        let luv = luv_of(&picture);
        for (x, lightness) in [100.0, 53.389, 0.0].into_iter().enumerate() {
            let [l, u, v] = luv[(x, 0)];
            assert!((l - lightness).abs() < 0.01, "{l}, wanted {lightness}");
            assert!(u.abs() < 0.01 && v.abs() < 0.01, "{u} {v}");
        }
        let intensity = intensity_of(&picture);
        assert!((intensity[(0, 0)] - 1.0).abs() < 1e-6, "{}", intensity[(0, 0)]);
        assert!((intensity[(1, 0)] - 0.5).abs() < 1e-4, "{}", intensity[(1, 0)]);
    }

    #[test]
    fn the_gradient_of_a_ramp_is_its_slope() {
        let values = (0..20 * 20).map(|i| 0.02 * (i % 20) as f32 - 0.01 * (i / 20) as f32);
        let gradient = gradient_of(&Field::from_values(20, 20, values.collect()));
        let [x, y] = gradient[(10, 10)];
        assert!((x - 0.02).abs() < 1e-5 && (y + 0.01).abs() < 1e-5, "{x} {y}");
    }
}
