//! PNG files of linear light, encoded and tagged as sRGB.

use png::chunk::ChunkType;
use png::{BitDepth, ColorType, Encoder, PixelDimensions, SrgbRenderingIntent, Unit};
use rayon::prelude::*;
use spectra::color::Rgb;

use super::error::{ExportError, check_cell, check_size};
use crate::field::Field;

/// Content of chunk `cICP` for sRGB (ITU-T H.273): BT.709 primaries, transfer of IEC
/// 61966-2-1, identity matrix, full range.
const CICP: [u8; 4] = [1, 13, 0, 1];

/// An encoded PNG file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Png {
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Number of pixels outside the sRGB gamut; see [`Rgb::mapped_into_gamut`] for what they show.
    pub outside: usize,
}

/// Encodes linear sRGB (white at 1; the fourth value is ignored) with 8 bits per channel
/// and the chunks `sRGB`, `cICP` and `pHYs`; a pixel is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are
/// not finite.
pub fn png8(picture: &Field<[f32; 4]>, cell_mm: f64) -> Result<Png, ExportError> {
    let (values, outside) = encoded(picture, |value, row| {
        row.push((value * 255.0).round() as u8);
    })?;
    let bytes = color_file(picture, cell_mm, BitDepth::Eight, &values)?;
    Ok(Png { bytes, outside })
}

/// Encodes linear sRGB with 16 bits per channel, otherwise like [`png8`].
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are
/// not finite.
pub fn png16(picture: &Field<[f32; 4]>, cell_mm: f64) -> Result<Png, ExportError> {
    let (values, outside) = encoded(picture, |value, row| {
        row.extend(((value * 65535.0).round() as u16).to_be_bytes());
    })?;
    let bytes = color_file(picture, cell_mm, BitDepth::Sixteen, &values)?;
    Ok(Png { bytes, outside })
}

/// Encodes plain numbers as a 16-bit grey channel without a colour space. `texts` are
/// stored as (keyword, text); a pixel is `cell_mm` wide.
pub fn grey16(
    values: &Field<u16>,
    cell_mm: f64,
    texts: &[(&str, &str)],
) -> Result<Vec<u8>, ExportError> {
    let samples: Vec<u8> = values.values().iter().flat_map(|value| value.to_be_bytes()).collect();
    let size = (values.width(), values.height());
    file(size, cell_mm, (ColorType::Grayscale, BitDepth::Sixteen), texts, &samples)
}

/// Encoded samples, and the number of pixels outside the gamut by more than f32 rounding
/// (see [`Rgb::in_gamut`]).
fn encoded(
    picture: &Field<[f32; 4]>,
    put: impl Fn(f64, &mut Vec<u8>) + Sync,
) -> Result<(Vec<u8>, usize), ExportError> {
    let width = picture.width();
    let rows = (0..picture.height()).into_par_iter().map(|y| {
        let (mut samples, mut outside) = (Vec::with_capacity(width * 6), 0);
        for (x, &[r, g, b, _]) in picture.row(y, 0, width).iter().enumerate() {
            if let Some(&found) = [r, g, b].iter().find(|value| !value.is_finite()) {
                return Err(ExportError::NotFinite { what: "the colour".into(), x, y, found });
            }
            let color = Rgb([r, g, b].map(f64::from));
            outside += usize::from(!color.in_gamut());
            let shown = color.mapped_into_gamut().0.map(|value| value.clamp(0.0, 1.0));
            for value in Rgb(shown).encoded().0 {
                put(value.clamp(0.0, 1.0), &mut samples);
            }
        }
        Ok((samples, outside))
    });
    let rows: Vec<_> = rows.collect();
    let mut all = (Vec::with_capacity(picture.values().len() * 6), 0);
    for row in rows {
        let (samples, outside) = row?;
        all.0.extend(samples);
        all.1 += outside;
    }
    Ok(all)
}

fn color_file(
    picture: &Field<[f32; 4]>,
    cell_mm: f64,
    depth: BitDepth,
    samples: &[u8],
) -> Result<Vec<u8>, ExportError> {
    let size = (picture.width(), picture.height());
    file(size, cell_mm, (ColorType::Rgb, depth), &[], samples)
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
        let light = color == ColorType::Rgb;
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
