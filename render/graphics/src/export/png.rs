//! PNG files of linear light, encoded and tagged as sRGB.

use png::chunk::ChunkType;
use png::{BitDepth, ColorType, Encoder, PixelDimensions, SrgbRenderingIntent, Unit};

use super::error::{ExportError, check_cell, check_size};
use super::srgb_samples::{Srgb16, eight_bits, encoded, srgb16};
use crate::field::Field;

/// Content of chunk `cICP` for sRGB (ITU-T H.273): BT.709 primaries, transfer of IEC
/// 61966-2-1, identity matrix, full range.
const CICP: [u8; 4] = [1, 13, 0, 1];

/// An encoded PNG file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Png {
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Number of pixels outside the sRGB gamut; see
    /// [`mapped_into_gamut`](spectra::color::Rgb::mapped_into_gamut) for what they show.
    pub outside: usize,
}

/// Encodes linear sRGB (white at 1; the fourth value is ignored) with 8 bits per channel
/// and the chunks `sRGB`, `cICP` and `pHYs`; a pixel is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are
/// not finite.
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
/// channel and the chunks of [`png8`]; a pixel is `cell_mm` wide.
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

/// Encodes plain numbers as a 16-bit grey channel without a colour space. `texts` are
/// stored as (keyword, text); a pixel is `cell_mm` wide.
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
