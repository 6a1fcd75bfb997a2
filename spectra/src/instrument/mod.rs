//! Files of measuring instruments.
//!
//! In scope: detecting the format, and reading the spectra with everything that the file states
//! about them. Out of scope: interpreting them as readings of paint (see
//! `calibrate::measurement`).

mod error;
mod measured;
mod choice;
mod points;
mod text;
mod number;
mod axis;
mod layout;
mod columns;
mod bruker;
mod avantes;
mod binary_bytes;
mod asd;
mod spectral_evolution;
mod svc;
mod uprtek;
mod avasoft;
mod avasoft7;
mod avasoft8;
mod ocean_optics;
mod qtx;
mod cgats_words;
mod cgats_fields;
mod cgats;
mod jcamp_data;
mod jcamp_tuples;
mod jcamp;
mod xml;
mod zip_archive;
mod procspec;
mod workbook;
mod content_kind;
mod file_text;
mod cxf;
mod tm27;
mod sekonic;
mod format;
mod read;
mod open;

pub use choice::{ChoiceError, choose_spectrum, split_file_and_name};
pub use cxf::{CxfHead, write_cxf};
pub use error::InstrumentError;
pub use file_text::FileText;
pub use format::Format;
pub use measured::{MeasuredQuantity, MeasuredSpectrum, ReflectanceError, Role, Unit};
pub use open::{OpenError, OpenedSpectrum, bytes_of, open, open_spectrum};
pub use read::{InstrumentFile, read};
pub use text::decode_text;
pub use workbook::split_file_and_sheet;
