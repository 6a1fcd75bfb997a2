//! Files as instruments write them.
//!
//! In scope: finding the format, and the spectra of a file with what the file says of them.
//! Out of scope: whether those are readings of paint (see `calibrate::measurement`).

mod error;

mod record;

mod choice;

mod points;

mod text;

mod number;

mod axis;

mod layout;

mod columns;

mod bruker;

mod avantes;

mod ocean_optics;

mod qtx;

mod cgats;

mod cgats_fields;

mod cgats_words;

mod jcamp;

mod jcamp_data;

mod xml;

mod cxf;

mod tm27;

mod sekonic;

mod format;

mod read;

pub use choice::{ChoiceError, chosen, file_and_name};
pub use cxf::{CxfHead, write_cxf};
pub use error::InstrumentError;
pub use format::Format;
pub use read::{InstrumentFile, read};
pub use record::{MeasuredQuantity, Record, Role, Unit};
pub use text::decoded;
