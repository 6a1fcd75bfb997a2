//! Reads pictures in linear light from OpenEXR files of any program, and makes smaller pictures of
//! them.

use std::io::Cursor;

use documents::file::check_expansion;
use documents::foreign_message;
use documents::hint::Explain;
use exr::meta::MetaData;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{ReadChannels, ReadLayers, Vec2, read};
use rayon::prelude::*;
use spectra::color::{Adaptation, Matrix3, RgbSpace, Xyz};

use crate::field::Field;
use crate::picture::{MOST_PIXELS, Picture};

const MAGIC: &[u8] = b"\x76\x2f\x31\x01";

/// A chromaticity may differ from sRGB by this much, which counts as rounding.
const ROUNDING: f32 = 1e-3;

/// An OpenEXR file cannot be read as a picture.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
pub enum ExrPictureError {
    /// The file is damaged, or has no channels R, G and B.
    #[error("{name}: not an OpenEXR picture with channels R, G and B: {reason}")]
    #[hint("save it as OpenEXR with channels R, G and B, or as PNG")]
    NoPicture {
        /// Path of the file.
        name: String,
        /// Reason given by the decoder.
        reason: String,
    },
    /// The picture has more than [`MOST_PIXELS`] pixels.
    #[error("{name}: a picture has {MOST_PIXELS} pixels at most, found `{width} x {height}`")]
    #[hint("make it smaller")]
    TooLarge {
        /// Path of the file.
        name: String,
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
}

/// Whether `bytes` begin like an OpenEXR file.
#[must_use]
pub fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Decodes the first part of an OpenEXR file with channels R, G and B to linear sRGB. Values above
/// 1 stay. Values that are not finite become 0. We convert from the primaries and white of
/// attribute `chromaticities`, or assume sRGB without it. We composite transparent parts on black.
/// `name` stands for the path in errors.
///
/// # Errors
/// [`ExrPictureError`] for another file, a damaged one, and one that is too large.
pub fn linear_picture(name: &str, bytes: &[u8]) -> Result<Picture, ExrPictureError> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(no_picture(name))?;
    for header in &meta.headers {
        let Vec2(width, height) = header.layer_size;
        if (width as u64).saturating_mul(height as u64) > MOST_PIXELS {
            return Err(ExrPictureError::TooLarge { name: name.to_owned(), width, height });
        }
        let list = &header.channels.list;
        let sample_bytes = list.iter().map(|channel| channel.sample_type.bytes_per_sample() as u64);
        let announced = (width as u64 * height as u64).saturating_mul(sample_bytes.sum());
        check_expansion(announced, bytes.len() as u64).map_err(|error| {
            ExrPictureError::NoPicture { name: name.to_owned(), reason: error.to_string() }
        })?;
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size, _| Field::filled(size.width(), size.height(), [0.0_f32; 3]),
            move |picture: &mut Picture, at, (r, g, b, _): (f32, f32, f32, f32)| {
                picture[(at.x(), at.y())] =
                    [r, g, b].map(|value: f32| if value.is_finite() { value } else { 0.0 });
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(no_picture(name))?;
    let mut picture = image.layer_data.channel_data.pixels;
    if let Some(own) = image.attributes.chromaticities.as_ref().and_then(srgb_from) {
        picture.values_mut().par_iter_mut().for_each(|rgb| {
            *rgb = own.apply(rgb.map(f64::from)).map(|value| value as f32);
        });
    }
    Ok(picture)
}

fn no_picture(name: &str) -> impl Fn(exr::error::Error) -> ExrPictureError {
    move |error| ExrPictureError::NoPicture {
        name: name.to_owned(),
        reason: foreign_message(&error),
    }
}

/// Matrix from linear light of other primaries to linear sRGB. `None` for the primaries of sRGB,
/// and for primaries that span no colours.
fn srgb_from(chromaticities: &Chromaticities) -> Option<Matrix3> {
    let Chromaticities { red, green, blue, white } = chromaticities;
    let srgb = [(0.64, 0.33), (0.30, 0.60), (0.15, 0.06), (0.3127, 0.3290)];
    let own = [red, green, blue, white];
    if own.iter().zip(srgb).all(|(found, (x, y)): (&&Vec2<f32>, (f32, f32))| {
        (found.0 - x).abs() < ROUNDING && (found.1 - y).abs() < ROUNDING
    }) || own.iter().any(|place| place.1 <= 0.0)
    {
        return None;
    }
    let xyz = own.map(|&Vec2(x, y)| {
        let x = f64::from(x);
        let y = f64::from(y);
        [x / y, 1.0, (1.0 - x - y) / y]
    });
    let [r, g, b, w] = xyz;
    let primaries = Matrix3([0, 1, 2].map(|row: usize| [r[row], g[row], b[row]]));
    let shares = primaries.inverse().apply(w);
    let scaled = primaries.0.map(|[r, g, b]| [r * shares[0], g * shares[1], b * shares[2]]);
    let hundred = Matrix3(scaled.map(|row| row.map(|value| 100.0 * value)));
    let white = Xyz::from(w.map(|value| 100.0 * value));
    let adapted = Adaptation::Bradford.matrix(white, RgbSpace::Srgb.white());
    let matrix = RgbSpace::Srgb.xyz_from_linear().inverse().after(&adapted.after(&hundred));
    matrix.0.iter().flatten().all(|value| value.is_finite()).then_some(matrix)
}

/// Reduces a picture to `width` x `height` cells. A cell is the mean of the pixels with their
/// centre in it.
///
/// # Panics
/// If a side is 0 or longer than the side of `picture`.
#[must_use]
pub fn reduced(picture: &Picture, width: usize, height: usize) -> Picture {
    let columns = picture.width();
    let rows = picture.height();
    assert!((1..=columns).contains(&width) && (1..=rows).contains(&height), "{width} x {height}");
    fn edge(cell: usize, cells: usize, pixels: usize) -> usize {
        cell * pixels / cells
    }
    let mut small = Field::filled(width, height, [0.0_f32; 3]);
    small.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        let lines = edge(y, height, rows)..edge(y + 1, height, rows);
        for (x, out) in row.iter_mut().enumerate() {
            let from = edge(x, width, columns);
            let to = edge(x + 1, width, columns);
            let mut sum = [0.0_f64; 3];
            for line in lines.clone() {
                for pixel in picture.row(line, from, to - from) {
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += f64::from(*value);
                    }
                }
            }
            let count = (lines.len() * (to - from)) as f64;
            *out = sum.map(|sum| (sum / count) as f32);
        }
    });
    small
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::linear_exr;

    fn bright() -> Field<[f32; 4]> {
        let mut picture = Field::filled(4, 2, [0.5, 0.25, 0.125, 1.0]);
        picture[(3, 1)] = [12.0, 0.0, 1.0, 1.0];
        picture
    }

    #[test]
    fn a_linear_picture_keeps_its_values_also_above_white() {
        let file = linear_exr(&bright(), 0.1).unwrap();
        assert!(is_exr(&file), "it begins as OpenEXR does");
        let read = linear_picture("a.exr", &file).unwrap();
        assert_eq!((read.width(), read.height()), (4, 2));
        assert_eq!((read[(0, 0)], read[(3, 1)]), ([0.5, 0.25, 0.125], [12.0, 0.0, 1.0]));
    }

    #[test]
    fn other_primaries_keep_their_white_and_move_their_colours() {
        let rec2020 = Chromaticities {
            red: Vec2(0.708, 0.292),
            green: Vec2(0.17, 0.797),
            blue: Vec2(0.131, 0.046),
            white: Vec2(0.3127, 0.329),
        };
        let matrix = srgb_from(&rec2020).unwrap();
        for value in matrix.apply([1.0; 3]) {
            assert!((value - 1.0).abs() < 2e-3, "white stays white: {value}");
        }
        // ITU-R BT.2087, table 2: the first row of BT.2020 to BT.709.
        let row = [1.6605, -0.5876, -0.0728];
        for (found, wanted) in matrix.0[0].iter().zip(row) {
            assert!((found - wanted).abs() < 3e-3, "{:?}", matrix.0);
        }
        let srgb = Chromaticities {
            red: Vec2(0.64, 0.33),
            green: Vec2(0.3, 0.6),
            blue: Vec2(0.15, 0.06),
            white: Vec2(0.3127, 0.329),
        };
        assert_eq!(srgb_from(&srgb), None, "sRGB needs no matrix");
    }

    #[test]
    fn a_file_without_colours_is_refused_with_its_name() {
        let file = linear_exr(&bright(), 0.1).unwrap();
        for bytes in [&b"\x76\x2f\x31\x01"[..], &file[..file.len() / 2], b"no picture"] {
            let error = linear_picture("b.exr", bytes).unwrap_err();
            assert!(error.to_string().contains("b.exr") && error.hint().is_some(), "{error}");
        }
    }

    #[test]
    fn a_reduced_picture_has_the_means() {
        let picture = linear_picture("a", &linear_exr(&bright(), 0.1).unwrap()).unwrap();
        let small = reduced(&picture, 2, 1);
        assert_eq!(small[(0, 0)], [0.5, 0.25, 0.125]);
        assert_eq!(small[(1, 0)][0], (3.0 * 0.5 + 12.0) / 4.0);
        assert_eq!(reduced(&picture, 4, 2), picture, "one pixel a cell");
    }
}
