//! Pictures of linear light as samples of encoded sRGB.

use rayon::prelude::*;
use spectra::color::Rgb;

use super::error::ExportError;
use crate::field::Field;

/// A picture in encoded sRGB with 16 bits per channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Srgb16 {
    /// Red, green and blue of every pixel, 0 to 65535.
    pub pixels: Field<[u16; 3]>,
    /// Number of pixels outside the sRGB gamut; see [`Rgb::mapped_into_gamut`] for what they show.
    pub outside: usize,
}

/// Encodes linear sRGB (white at 1; the fourth value is ignored) with 16 bits per channel.
///
/// # Errors
/// [`ExportError::NotFinite`].
pub fn srgb16(picture: &Field<[f32; 4]>) -> Result<Srgb16, ExportError> {
    let (pixels, outside) =
        encoded(picture, |rgb| rgb.map(|value| (value * 65535.0).round() as u16))?;
    Ok(Srgb16 { pixels, outside })
}

/// Encodes linear sRGB like [`srgb16`] with 8 bits per channel: the pixels of an 8-bit PNG.
///
/// # Errors
/// [`ExportError::NotFinite`].
pub fn srgb8(picture: &Field<[f32; 4]>) -> Result<Field<[u8; 3]>, ExportError> {
    Ok(encoded(picture, eight_bits)?.0)
}

/// Encoded sRGB in 0..1 as 8 bits per channel.
pub(super) fn eight_bits(rgb: [f64; 3]) -> [u8; 3] {
    rgb.map(|value| (value * 255.0).round() as u8)
}

/// Pixels made by `pixel` from encoded sRGB in 0..1, and the number of those outside the gamut by
/// more than f32 rounding (see [`Rgb::in_gamut`]).
pub(super) fn encoded<T: Send>(
    picture: &Field<[f32; 4]>,
    pixel: impl Fn([f64; 3]) -> T + Sync,
) -> Result<(Field<T>, usize), ExportError> {
    let width = picture.width();
    let rows = (0..picture.height()).into_par_iter().map(|y| {
        let mut pixels = Vec::with_capacity(width);
        let mut outside = 0;
        for (x, &[r, g, b, _]) in picture.row(y, 0, width).iter().enumerate() {
            if let Some(&found) = [r, g, b].iter().find(|value| !value.is_finite()) {
                return Err(ExportError::NotFinite { what: "the colour".into(), x, y, found });
            }
            let color = Rgb([r, g, b].map(f64::from));
            outside += usize::from(!color.in_gamut());
            let shown = color.mapped_into_gamut().0.map(|value| value.clamp(0.0, 1.0));
            pixels.push(pixel(Rgb(shown).encoded().0.map(|value| value.clamp(0.0, 1.0))));
        }
        Ok((pixels, outside))
    });
    let rows: Vec<_> = rows.collect();
    let mut all = Vec::with_capacity(picture.values().len());
    let mut outside = 0;
    for row in rows {
        let (pixels, more) = row?;
        all.extend(pixels);
        outside += more;
    }
    Ok((Field::from_values(width, picture.height(), all), outside))
}
