//! Spectral scans, read in blocks of rows.
//!
//! A reader opens a scan as raw values with a layout. [`Cube`] turns them into reflectance and says for
//! each pixel whether it can be mapped. You need memory for one block only, whatever the size of the
//! scan: plain files are read by position, on a disk or by the caller ([`ReadAt`]), packed images are
//! unpacked into a temporary file first.

mod error;
mod options;
mod window;
mod white;
mod interpret;
mod raw_file;

#[cfg(feature = "files")]
mod side_files;
pub mod envi;

#[cfg(feature = "files")]
mod gdal;

#[cfg(feature = "files")]
mod stack;

#[cfg(feature = "files")]
mod zarr_cube;
mod scan;
mod listed;

#[cfg(feature = "files")]
mod open;

pub use crate::numbers::{ByteOrder, NumberType};
pub use error::CubeError;
pub use listed::ScanFile;
pub use options::{CubeOptions, CubeScale, DarkReading};
pub use raw_file::{Interleave, ReadAt};
pub use scan::{Cube, CubeValues, SpreadPixels};
pub use window::{Block, GREATEST_REFLECTANCE, LEAST_REFLECTANCE};
