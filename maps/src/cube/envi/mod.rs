//! Cubes of ENVI: a text header and a file of plain numbers. Read, and written.

mod fields;

mod header;

mod data_file;

mod scan;

mod written;

pub use header::EnviHeader;
pub use written::{EnviAbout, EnviWriter, WRITTEN_SCALE, written_data};

pub(crate) use data_file::header_of;
pub(crate) use fields::is_header;
pub(crate) use scan::open;
