//! Cubes of ENVI: a text header and a file of plain numbers.

mod fields;

mod header;

mod data_file;

mod scan;

pub use header::EnviHeader;

pub(crate) use data_file::header_of;
pub(crate) use fields::is_header;
pub(crate) use scan::open;
