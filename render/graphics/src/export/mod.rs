//! Writes picture files for other programs: PNG, TIFF, linear OpenEXR and OpenEXR of several
//! parts, layers as OpenRaster, PLY, frames and animations (GIF, APNG).
//!
//! You pass plain data to these functions and get bytes, the same bytes for the same data. You
//! write the files yourself. Only [`Sequence`] works on a folder.

mod exr;
mod picture_file;
mod open_raster;
mod ply;
mod frame;
mod animation;
mod sequence;

use documents::hint::Explain;

pub use animation::{Apng, ColorTable, Gif};
pub use exr::{ExrPart, exr_file, exr_parts, float_exr, linear_exr, rgb_channels};
pub use frame::{CompressedFrame, Frame, FrameError, FrameRate, frame_of, frame_png, read_frame};
pub use open_raster::{OpenRaster, reduced, reduced_size};
pub use picture_file::{
    OutsideGamut, PictureFile, PictureFormat, Png, Srgb16, Tiff, grey16, picture_file, png8, png16,
    rgba16, srgb8, srgb16, tiff16,
};
pub use ply::ply;
pub use sequence::{AnimationFormat, Sequence, SequenceError, SequenceSettings};

/// Data that we cannot write as a picture.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ExportError {
    /// The picture is empty or larger than the format allows.
    #[error("a picture has 1 to 1073741822 cells a side, found `{width} x {height}`")]
    Size {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
    /// The planes of one picture differ in size.
    #[error("`{plane}` has another size than the picture of {width} x {height}")]
    Differs {
        /// Name of the plane that differs.
        plane: String,
        /// Width of the first plane in pixels.
        width: usize,
        /// Height of the first plane in pixels.
        height: usize,
    },
    /// A value is infinite or not a number.
    #[error("{what} at x {x}, y {y} is not a finite number, found `{found}`")]
    NotFinite {
        /// Quantity that the value stands for.
        what: String,
        /// Column from 0.
        x: usize,
        /// Row from 0.
        y: usize,
        /// Value of the pixel.
        found: f32,
    },
    /// An amount of pigment is negative.
    #[error("{what} at x {x}, y {y} is 0 and up, found `{found}`")]
    Negative {
        /// Name of the pigment.
        what: String,
        /// Column from 0.
        x: usize,
        /// Row from 0.
        y: usize,
        /// Height in mm.
        found: f32,
    },
    /// The size of a pixel is out of range.
    #[error("a cell is 0.0001 to 100 mm wide, found `{0}`")]
    Cell(f64),
    /// Wavelengths do not rise, or there is not one per plane.
    #[error(
        "wavelengths rise, in nm above 0, one for each plane; found `{found}` for plane {plane}"
    )]
    Wavelength {
        /// Index of the plane, from 0.
        plane: usize,
        /// The wavelength, or the number of wavelengths.
        found: String,
    },
    /// The encoder failed.
    #[error("no {format} could be made: {reason}")]
    Encoder {
        /// Name of the format.
        format: &'static str,
        /// Reason given by the encoder.
        reason: String,
    },
}

/// Checks that a pixel size can be stored in PNG and OpenEXR: 0.0001 to 100 mm.
///
/// # Errors
/// [`ExportError::Cell`].
pub fn check_cell(cell_mm: f64) -> Result<(), ExportError> {
    if (1e-4..=100.0).contains(&cell_mm) { Ok(()) } else { Err(ExportError::Cell(cell_mm)) }
}

/// Checks that a picture is not empty and not larger than the formats allow.
///
/// # Errors
/// [`ExportError::Size`].
pub fn check_size(width: usize, height: usize) -> Result<(), ExportError> {
    let sides = 1..=1_073_741_822;
    if sides.contains(&width) && sides.contains(&height) {
        Ok(())
    } else {
        Err(ExportError::Size { width, height })
    }
}
