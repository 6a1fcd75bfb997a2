//! Picture files for other programs: PNG, TIFF, linear OpenEXR and OpenEXR of several parts,
//! layers as OpenRaster, PLY, frames and animations (GIF, APNG).
//!
//! The functions take plain data and return bytes, the same bytes for the same data; the
//! caller writes the files. Only [`Sequence`] works on a folder.

mod error;
mod exr_part;
mod linear_exr;
mod srgb_samples;
mod reduced;
mod png;
mod tiff16;
mod open_raster;
mod ply;
mod picture_file;
mod frame;
mod compressed;
mod color_table;
mod animation;
mod sequence_error;
mod sequence;
mod animation_file;

pub use animation::{Apng, Gif};
pub use animation_file::AnimationFormat;
pub use color_table::ColorTable;
pub use compressed::CompressedFrame;
pub use error::{ExportError, check_cell, check_size};
pub use exr_part::{ExrPart, exr_file, exr_parts};
pub use frame::{Frame, FrameError, FrameRate, frame_of, frame_png, read_frame};
pub use linear_exr::{float_exr, linear_exr, rgb_channels};
pub use open_raster::OpenRaster;
pub use picture_file::{OutsideGamut, PictureFile, PictureFormat, picture_file};
pub use ply::ply;
pub use png::{Png, grey16, png8, png16, rgba16};
pub use reduced::{reduced, reduced_size};
pub use sequence::{Sequence, SequenceSettings};
pub use sequence_error::SequenceError;
pub use srgb_samples::{Srgb16, srgb8, srgb16};
pub use tiff16::{Tiff, tiff16};
