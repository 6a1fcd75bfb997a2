//! Spectral scans, read in blocks of rows.
//!
//! A reader opens a scan as raw values with a layout; [`Cube`] turns them into reflectance and tells
//! for each pixel whether it can be mapped. Memory is that of one block, whatever the size of the
//! scan: plain files are read by position, on a disk or by the caller ([`ReadAt`]), packed images are unpacked into a temporary file first.

mod error;
mod positional;
mod wavelengths;
mod conversion;
mod window;
mod block;
mod options;
mod opened;
mod readings;
mod interpret;
mod raw_file;

#[cfg(feature = "files")]
mod spool;

#[cfg(feature = "files")]
mod wavelength_file;
pub mod envi;

#[cfg(feature = "files")]
mod specim;

#[cfg(feature = "files")]
mod spectral_exr;

#[cfg(feature = "files")]
mod stack;

#[cfg(feature = "files")]
mod zarr_cube;
mod scan;
mod sampling;
mod kinds;
mod reading_files;
mod listed;

#[cfg(feature = "files")]
mod open;

pub use crate::numbers::{ByteOrder, NumberType};
pub use block::Block;
pub use conversion::{GREATEST_REFLECTANCE, LEAST_REFLECTANCE};
pub use error::CubeError;
pub use listed::ScanFile;
pub use options::{CubeOptions, CubeScale, DarkReading};
pub use positional::ReadAt;
pub use raw_file::Interleave;
pub use sampling::SpreadPixels;
pub use scan::{Cube, CubeValues};
