//! TIFF files of encoded sRGB with 16 bits per channel.

use std::io::Cursor;

use moxcms::ColorProfile;
use tiff::encoder::colortype::RGB16;
use tiff::encoder::{Compression, DeflateLevel, Predictor, Rational, TiffEncoder};
use tiff::tags::{ResolutionUnit, Tag};

use super::error::{ExportError, check_cell, check_size};
use super::srgb_samples::{Srgb16, srgb16};
use crate::field::Field;

/// An encoded TIFF file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tiff {
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Number of pixels outside the sRGB gamut, which lost chroma as in a PNG.
    pub outside: usize,
}

/// Encodes linear sRGB (white at 1; the fourth value is ignored) as TIFF 6.0 with 16 bits per
/// channel: the pixels of a 16-bit PNG, compressed without loss, with the ICC profile of sRGB
/// and the resolution of pixels that are `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, colours that are not finite,
/// and a file above 4 GiB.
pub fn tiff16(picture: &Field<[f32; 4]>, cell_mm: f64) -> Result<Tiff, ExportError> {
    check_size(picture.width(), picture.height())?;
    check_cell(cell_mm)?;
    let Srgb16 { pixels, outside } = srgb16(picture)?;
    let profile = srgb_profile()?;
    // A thousandth of a pixel an inch is finer than any cell that can be stored.
    let per_inch = Rational { n: (25.4 / cell_mm * 1000.0).round() as u32, d: 1000 };
    let mut bytes = Cursor::new(Vec::new());
    let make = || {
        let mut encoder = TiffEncoder::new(&mut bytes)?
            .with_compression(Compression::Deflate(DeflateLevel::Balanced))
            .with_predictor(Predictor::Horizontal);
        let width = pixels.width() as u32;
        let height = pixels.height() as u32;
        let mut image = encoder.new_image::<RGB16>(width, height)?;
        image.resolution(ResolutionUnit::Inch, per_inch);
        image.encoder().write_tag(Tag::IccProfile, &profile[..])?;
        image.write_data(pixels.values().as_flattened())
    };
    make().map_err(|error: tiff::TiffError| failed(&error))?;
    Ok(Tiff { bytes: bytes.into_inner(), outside })
}

/// The ICC profile of sRGB, the same bytes every time.
fn srgb_profile() -> Result<Vec<u8>, ExportError> {
    /// Bytes of the header that hold the time at which a profile was made.
    const MADE: std::ops::Range<usize> = 24..36;
    let mut profile = ColorProfile::new_srgb();
    profile.cicp = None;
    let mut bytes = profile.encode().map_err(|error| failed(&error))?;
    // The encoder writes the present time; the day on which sRGB was published stays the same.
    let published: Vec<u8> =
        [1999_u16, 10, 18, 0, 0, 0].iter().flat_map(|n| n.to_be_bytes()).collect();
    bytes[MADE].copy_from_slice(&published);
    Ok(bytes)
}

fn failed(error: &dyn std::error::Error) -> ExportError {
    ExportError::Encoder { format: "TIFF", reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use tiff::decoder::{Decoder, DecodingResult};

    use super::*;

    fn picture() -> Field<[f32; 4]> {
        Field::from_values(
            4,
            3,
            (0..12).map(|i: usize| [i as f32 / 11.0, 0.25, 1.0 - i as f32 / 11.0, 1.0]).collect(),
        )
    }

    #[test]
    fn a_tiff_has_the_pixels_of_a_png_with_profile_and_resolution() {
        let file = tiff16(&picture(), 0.1).unwrap();
        assert_eq!(file.outside, 0);
        let mut decoder = Decoder::new(Cursor::new(&file.bytes)).unwrap();
        assert_eq!(decoder.dimensions().unwrap(), (4, 3));
        let resolution = decoder.get_tag(Tag::XResolution).unwrap();
        assert_eq!(resolution.into_u32_vec().unwrap(), [254_000, 1000], "254 an inch");
        let profile = decoder.get_tag_u8_vec(Tag::IccProfile).unwrap();
        let read = ColorProfile::new_from_slice(&profile).unwrap();
        assert!(read.red_trc.is_some() && &profile[36..40] == b"acsp", "{read:?}");
        let DecodingResult::U16(samples) = decoder.read_image().unwrap() else {
            panic!("16 bits a channel");
        };
        assert_eq!(samples, srgb16(&picture()).unwrap().pixels.values().as_flattened());
    }

    #[test]
    fn the_same_picture_gives_the_same_bytes_and_a_wrong_one_an_error() {
        assert_eq!(tiff16(&picture(), 0.1), tiff16(&picture(), 0.1));
        let empty = Field::from_values(0, 0, Vec::new());
        assert!(matches!(tiff16(&empty, 0.1), Err(ExportError::Size { .. })));
        assert!(matches!(tiff16(&picture(), 0.0), Err(ExportError::Cell { .. })));
    }
}
