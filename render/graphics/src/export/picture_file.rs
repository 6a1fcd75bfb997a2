//! Files of pictures in linear sRGB: the formats to choose from.

use std::path::Path;

use documents::hint::{Explain, Hint};

use super::error::ExportError;
use super::linear_exr::linear_exr;
use super::png::{Png, png8, png16};
use super::tiff16::{Tiff, tiff16};
use crate::field::Field;

/// Least share of pixels outside the gamut that is worth a note.
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
    /// OpenEXR of linear sRGB with 32-bit floats, unclipped.
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
    /// Share of pixels outside the gamut of the format, whose chroma was reduced, 0..1.
    pub outside: f64,
}

/// Some colours of a picture were outside sRGB and lost chroma.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{:.1} % of the cells are outside sRGB and lost chroma", 100.0 * .share)]
pub struct OutsideGamut {
    /// Share of pixels, 0..1.
    pub share: f64,
}

impl Explain for OutsideGamut {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("linear OpenEXR (.exr) keeps them"))
    }
}

impl PictureFile {
    /// A note if a noteworthy share of pixels, 0.05 % or more, was outside the gamut.
    #[must_use]
    pub fn outside_gamut(&self) -> Option<OutsideGamut> {
        (self.outside >= NOTEWORTHY).then_some(OutsideGamut { share: self.outside })
    }
}

/// Encodes a picture in linear sRGB (white at 1; the fourth value is ignored); a pixel is
/// `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are
/// not finite.
pub fn picture_file(
    picture: &Field<[f32; 4]>,
    cell_mm: f64,
    format: PictureFormat,
) -> Result<PictureFile, ExportError> {
    let png = |Png { bytes, outside }| (bytes, outside);
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
