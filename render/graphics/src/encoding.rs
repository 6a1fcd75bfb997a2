//! Conversion of colour pictures between linear light, encoded sRGB (IEC 61966-2-1) and CIELAB.

use rayon::prelude::*;
use spectra::color::{Lab, Rgb, RgbSpace};

use crate::field::Field;

/// Linear sRGB of a picture of encoded sRGB. This keeps the fourth value.
#[must_use]
pub fn linear_from_encoded(picture: &Field<[f32; 4]>) -> Field<[f32; 4]> {
    map_pixels(picture, |[r, g, b, a]| {
        let [r, g, b] = Rgb([r, g, b].map(f64::from)).linear().0.map(|value| value as f32);
        [r, g, b, a]
    })
}

/// Encoded sRGB of a picture of linear sRGB, which is clipped to 0..1. This keeps the fourth
/// value.
#[must_use]
pub fn encoded_from_linear(picture: &Field<[f32; 4]>) -> Field<[f32; 4]> {
    map_pixels(picture, encoded)
}

/// Encodes a picture of linear sRGB like [`encoded_from_linear`], but in place.
pub fn encode(picture: &mut Field<[f32; 4]>) {
    picture.values_mut().par_iter_mut().for_each(|pixel| *pixel = encoded(*pixel));
}

fn encoded([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let inside = [r, g, b].map(|value| f64::from(value.clamp(0.0, 1.0)));
    let [r, g, b] = Rgb(inside).encoded().0.map(|value| value as f32);
    [r, g, b, a]
}

/// Converts a picture of linear sRGB to CIELAB under the white of sRGB.
#[must_use]
pub fn lab_from_linear(picture: &Field<[f32; 3]>) -> Field<[f32; 3]> {
    let white = RgbSpace::Srgb.white();
    let xyz_from_rgb = RgbSpace::Srgb.xyz_from_linear();
    let values = picture
        .values()
        .par_iter()
        .with_min_len(1024)
        .map(|rgb: &[f32; 3]| {
            let xyz = xyz_from_rgb.apply(rgb.map(f64::from)).into();
            Lab::from_xyz(xyz, white).to_array().map(|value| value as f32)
        })
        .collect();
    Field::from_values(picture.width(), picture.height(), values)
}

/// Converts a picture of CIELAB under the white of sRGB to linear sRGB. Colours outside the gamut
/// have values below 0 or above 1.
#[must_use]
pub fn linear_from_lab(picture: &Field<[f32; 3]>) -> Field<[f32; 3]> {
    let white = RgbSpace::Srgb.white();
    let rgb_from_xyz = RgbSpace::Srgb.xyz_from_linear().inverse();
    let values = picture
        .values()
        .par_iter()
        .with_min_len(1024)
        .map(|&[l, a, b]: &[f32; 3]| {
            let lab = Lab { lightness: f64::from(l), a: f64::from(a), b: f64::from(b) };
            rgb_from_xyz.apply(lab.to_xyz(white).to_array()).map(|value| value as f32)
        })
        .collect();
    Field::from_values(picture.width(), picture.height(), values)
}

/// Composites a picture with coverage on white, without linearising it. The coverage of the result
/// is 1 everywhere. Use this for pictures in encoded sRGB.
#[must_use]
pub fn over_white(picture: &Field<[f32; 4]>) -> Field<[f32; 4]> {
    map_pixels(picture, |[r, g, b, covered]| {
        let [r, g, b] = [r, g, b].map(|value| value * covered + 1.0 - covered);
        [r, g, b, 1.0]
    })
}

fn map_pixels(
    picture: &Field<[f32; 4]>,
    map: impl Fn([f32; 4]) -> [f32; 4] + Sync,
) -> Field<[f32; 4]> {
    let values = picture.values().par_iter().map(|&pixel| map(pixel)).collect();
    Field::from_values(picture.width(), picture.height(), values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encoding_and_linearising_are_inverse_and_keep_the_fourth_value() {
        let values = (0..256).map(|i| [i as f32 / 255.0, 0.5, 1.0 - i as f32 / 255.0, 0.25]);
        let picture = Field::from_values(16, 16, values.collect());
        let linear = linear_from_encoded(&picture);
        let back = encoded_from_linear(&linear);
        let mut in_place = linear;
        encode(&mut in_place);
        assert_eq!(in_place, back);
        for (found, wanted) in back.values().iter().zip(picture.values()) {
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-6, "{found} {wanted}");
            }
        }
    }

    #[test]
    fn cielab_and_linear_light_are_inverse() {
        let values = (0..64).map(|i| [i as f32 / 64.0, 0.3, 1.0 - i as f32 / 64.0]);
        let picture = Field::from_values(8, 8, values.collect());
        let back = linear_from_lab(&lab_from_linear(&picture));
        for (found, wanted) in back.values().iter().zip(picture.values()) {
            assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-5), "{found:?}");
        }
    }

    #[test]
    fn bare_pixels_are_white() {
        let picture =
            Field::from_values(2, 1, vec![[0.25, 0.5, 0.75, 0.0], [0.25, 0.5, 0.75, 1.0]]);
        assert_eq!(over_white(&picture).values(), [[1.0; 4], [0.25, 0.5, 0.75, 1.0]]);
    }
}
