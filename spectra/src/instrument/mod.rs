//! Files of measuring instruments.
//!
//! This module detects the format and reads the spectra with everything that the file states about
//! them. If you want to use them as readings of paint, see `calibrate::measurement`.

mod quantity;
mod measured;
mod points;
mod decode;
mod stated;
mod columns;
mod long_table;
mod avantes;
mod field_spectrometers;
mod qtx;
mod cgats;
mod jcamp;
mod xml;
mod light_meters;
mod ocean_optics;
mod workbook;
mod cxf;
mod envi_library;
mod format;
mod read;

pub use cxf::{CxfHead, write_cxf};
pub use decode::decode_text;
pub use documents::file::split_file_and_sheet;
pub use format::{FileText, Format};
pub use long_table::is_long_table;
pub use measured::{
    ChoiceError, InstrumentError, MeasuredSpectrum, ReflectanceError, Role, Unit, choose_spectrum,
    deviations, split_file_and_name,
};
pub use quantity::MeasuredQuantity;
pub use read::{
    FileOptions, InstrumentFile, OpenError, OpenedSpectrum, bytes_of, open, open_spectrum, read,
    read_with,
};
pub use stated::{StatedGeometry, StatedValues};
