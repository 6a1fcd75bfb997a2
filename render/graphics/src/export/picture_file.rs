//! Writes files of pictures in linear sRGB: PNG with 8 or 16 bits and TIFF with 16 bits, encoded
//! as sRGB. It also has the formats that a user chooses from.

use std::io::Cursor;
use std::path::Path;

use documents::hint::Explain;
use moxcms::ColorProfile;
use png::chunk::ChunkType;
use png::{BitDepth, ColorType, Encoder, PixelDimensions, SrgbRenderingIntent, Unit};
use rayon::prelude::*;
use spectra::color::Rgb;
use tiff::encoder::colortype::RGB16;
use tiff::encoder::{Compression, DeflateLevel, Predictor, Rational, TiffEncoder};
use tiff::tags::{ResolutionUnit, Tag};

use super::exr::linear_exr;
use super::{ExportError, check_cell, check_size};
use crate::field::Field;

/// Users get a note if at least this share of the pixels is outside the gamut.
const NOTEWORTHY: f64 = 0.0005;

/// File format of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum PictureFormat {
    /// PNG in sRGB with 8 bits per channel.
    #[default]
    Png8,
    /// PNG in sRGB with 16 bits per channel.
    Png16,
    /// TIFF in sRGB with 16 bits per channel.
    Tiff16,
    /// OpenEXR of linear sRGB with 32-bit floats. This format does not clip colours.
    LinearExr,
}

impl PictureFormat {
    /// Format for a file extension: 8-bit PNG for `.png`, TIFF for `.tif` and `.tiff`, OpenEXR
    /// for `.exr`.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "png" => Some(Self::Png8),
            "tif" | "tiff" => Some(Self::Tiff16),
            "exr" => Some(Self::LinearExr),
            _ => None,
        }
    }
}

/// An encoded picture.
#[derive(Debug, Clone, PartialEq)]
pub struct PictureFile {
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Share of pixels outside the gamut of the format, 0..1. We reduced their chroma.
    pub outside: f64,
}

/// Some colours of a picture were outside sRGB and lost chroma.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
#[error("{:.1} % of the cells are outside sRGB and lost chroma", 100.0 * .share)]
#[hint("linear OpenEXR (.exr) keeps them")]
pub struct OutsideGamut {
    /// Share of pixels, 0..1.
    pub share: f64,
}

impl PictureFile {
    /// A note for the user if 0.05 % of the pixels or more were outside the gamut.
    #[must_use]
    pub fn outside_gamut(&self) -> Option<OutsideGamut> {
        (self.outside >= NOTEWORTHY).then_some(OutsideGamut { share: self.outside })
    }
}

/// Encodes a picture in linear sRGB (white at 1). This ignores the fourth value. A pixel is
/// `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are not
/// finite.
pub fn picture_file(
    picture: &Field<[f32; 4]>,
    cell_mm: f64,
    format: PictureFormat,
) -> Result<PictureFile, ExportError> {
    fn png(Png { bytes, outside }: Png) -> (Vec<u8>, usize) {
        (bytes, outside)
    }
    let (bytes, outside) = match format {
        PictureFormat::Png8 => png(png8(picture, cell_mm)?),
        PictureFormat::Png16 => png(png16(picture, cell_mm)?),
        PictureFormat::Tiff16 => {
            let Tiff { bytes, outside } = tiff16(picture, cell_mm)?;
            (bytes, outside)
        }
        PictureFormat::LinearExr => (linear_exr(picture, cell_mm)?, 0),
    };
    let outside = outside as f64 / picture.values().len() as f64;
    Ok(PictureFile { bytes, outside })
}

/// Content of chunk `cICP` for sRGB (ITU-T H.273): BT.709 primaries, transfer of IEC
/// 61966-2-1, identity matrix, full range.
const CICP: [u8; 4] = [1, 13, 0, 1];

/// An encoded PNG file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Png {
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Number of pixels outside the sRGB gamut. See
    /// [`mapped_into_gamut`](spectra::color::Rgb::mapped_into_gamut) for what they show.
    pub outside: usize,
}

/// Encodes linear sRGB (white at 1, the fourth value is ignored) with 8 bits per channel and the
/// chunks `sRGB`, `cICP` and `pHYs`. A pixel is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are not
/// finite.
pub fn png8(picture: &Field<[f32; 4]>, cell_mm: f64) -> Result<Png, ExportError> {
    let (pixels, outside) = encoded(picture, eight_bits)?;
    let samples = pixels.values().as_flattened();
    let bytes = color_file(picture, cell_mm, (ColorType::Rgb, BitDepth::Eight), samples)?;
    Ok(Png { bytes, outside })
}

/// Encodes linear sRGB with 16 bits per channel, otherwise like [`png8`].
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are
/// not finite.
pub fn png16(picture: &Field<[f32; 4]>, cell_mm: f64) -> Result<Png, ExportError> {
    let Srgb16 { pixels, outside } = srgb16(picture)?;
    let samples = big_endian(pixels.values().as_flattened());
    let bytes = color_file(picture, cell_mm, (ColorType::Rgb, BitDepth::Sixteen), &samples)?;
    Ok(Png { bytes, outside })
}

/// Encodes red, green, blue and opacity in encoded sRGB, not premultiplied, with 16 bits per
/// channel and the chunks of [`png8`]. A pixel is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture and a pixel size out of range.
pub fn rgba16(pixels: &Field<[u16; 4]>, cell_mm: f64) -> Result<Vec<u8>, ExportError> {
    let samples = big_endian(pixels.values().as_flattened());
    color_file(pixels, cell_mm, (ColorType::Rgba, BitDepth::Sixteen), &samples)
}

fn big_endian(samples: &[u16]) -> Vec<u8> {
    samples.iter().flat_map(|sample| sample.to_be_bytes()).collect()
}

/// Encodes plain numbers as a 16-bit grey channel without a colour space. You can add `texts` as
/// (keyword, text). A pixel is `cell_mm` wide.
pub fn grey16(
    values: &Field<u16>,
    cell_mm: f64,
    texts: &[(&str, &str)],
) -> Result<Vec<u8>, ExportError> {
    let samples = big_endian(values.values());
    let size = (values.width(), values.height());
    file(size, cell_mm, (ColorType::Grayscale, BitDepth::Sixteen), texts, &samples)
}

fn color_file<T>(
    picture: &Field<T>,
    cell_mm: f64,
    kind: (ColorType, BitDepth),
    samples: &[u8],
) -> Result<Vec<u8>, ExportError> {
    file((picture.width(), picture.height()), cell_mm, kind, &[], samples)
}

fn file(
    (width, height): (usize, usize),
    cell_mm: f64,
    (color, depth): (ColorType, BitDepth),
    texts: &[(&str, &str)],
    samples: &[u8],
) -> Result<Vec<u8>, ExportError> {
    check_size(width, height)?;
    check_cell(cell_mm)?;
    let make = || {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, width as u32, height as u32);
        encoder.set_color(color);
        encoder.set_depth(depth);
        let per_metre = (1000.0 / cell_mm).round() as u32;
        let unit = Unit::Meter;
        encoder.set_pixel_dims(Some(PixelDimensions { xppu: per_metre, yppu: per_metre, unit }));
        for (keyword, text) in texts {
            encoder.add_itxt_chunk((*keyword).to_owned(), (*text).to_owned())?;
        }
        let light = color != ColorType::Grayscale;
        if light {
            encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
        }
        let mut writer = encoder.write_header()?;
        if light {
            writer.write_chunk(ChunkType(*b"cICP"), &CICP)?;
        }
        writer.write_image_data(samples)?;
        writer.finish()?;
        Ok(bytes)
    };
    make().map_err(|error: png::EncodingError| ExportError::Encoder {
        format: "PNG",
        reason: error.to_string(),
    })
}

/// An encoded TIFF file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tiff {
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Number of pixels outside the sRGB gamut. They lost chroma, as in a PNG.
    pub outside: usize,
}

/// Encodes linear sRGB (white at 1) as TIFF 6.0 with 16 bits per channel. This ignores the fourth
/// value. The pixels are those of a 16-bit PNG, compressed without loss. The file has the ICC
/// profile of sRGB, and its resolution says that pixels are `cell_mm` wide.
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

/// The ICC profile of sRGB. It has the same bytes every time.
fn srgb_profile() -> Result<Vec<u8>, ExportError> {
    /// These bytes of the header hold the time at which the profile was made.
    const MADE: std::ops::Range<usize> = 24..36;
    let mut profile = ColorProfile::new_srgb();
    profile.cicp = None;
    let mut bytes = profile.encode().map_err(|error| failed(&error))?;
    // The encoder writes the present time. We put the day on which sRGB was published there.
    let published: Vec<u8> =
        [1999_u16, 10, 18, 0, 0, 0].iter().flat_map(|n| n.to_be_bytes()).collect();
    bytes[MADE].copy_from_slice(&published);
    Ok(bytes)
}

fn failed(error: &dyn std::error::Error) -> ExportError {
    ExportError::Encoder { format: "TIFF", reason: error.to_string() }
}

/// A picture in encoded sRGB with 16 bits per channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Srgb16 {
    /// Red, green and blue of every pixel, 0 to 65535.
    pub pixels: Field<[u16; 3]>,
    /// Number of pixels outside the sRGB gamut. See [`Rgb::mapped_into_gamut`] for what they show.
    pub outside: usize,
}

/// Encodes linear sRGB (white at 1, the fourth value is ignored) with 16 bits per channel.
///
/// # Errors
/// [`ExportError::NotFinite`].
pub fn srgb16(picture: &Field<[f32; 4]>) -> Result<Srgb16, ExportError> {
    let (pixels, outside) =
        encoded(picture, |rgb| rgb.map(|value| (value * 65535.0).round() as u16))?;
    Ok(Srgb16 { pixels, outside })
}

/// Encodes linear sRGB like [`srgb16`], but with 8 bits per channel. These are the pixels of an
/// 8-bit PNG.
///
/// # Errors
/// [`ExportError::NotFinite`].
pub fn srgb8(picture: &Field<[f32; 4]>) -> Result<Field<[u8; 3]>, ExportError> {
    Ok(encoded(picture, eight_bits)?.0)
}

pub(super) fn eight_bits(rgb: [f64; 3]) -> [u8; 3] {
    rgb.map(|value| (value * 255.0).round() as u8)
}

/// Makes pixels by `pixel` from encoded sRGB in 0..1. Also returns the number of pixels that are
/// outside the gamut by more than f32 rounding (see [`Rgb::in_gamut`]).
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

#[cfg(test)]
mod tests {
    use super::*;
    use tiff::decoder::{Decoder, DecodingResult};

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
        assert!(matches!(tiff16(&picture(), 0.0), Err(ExportError::Cell(..))));
    }
}
