//! Cubes of ENVI: a text header and a file of plain numbers. Read, and written.

mod fields;
mod header;
mod data_file;
mod scan;

#[cfg(feature = "files")]
mod written;

pub use header::EnviHeader;
#[cfg(feature = "files")]
pub use written::{EnviAbout, EnviWriter, WRITTEN_SCALE, written_data};

#[cfg(feature = "files")]
pub(crate) use data_file::header_of;
pub(crate) use data_file::{check_size, places};
pub(crate) use fields::is_header;
#[cfg(feature = "files")]
pub(crate) use scan::open;
pub(crate) use scan::{check_length, opened};
