//! Opening instrument files by path.

use std::path::Path;

use super::choice::{ChoiceError, choose_spectrum, split_file_and_name};
use super::error::InstrumentError;
use super::measured::MeasuredSpectrum;
use super::read::{InstrumentFile, read};
use crate::file::{self, FileError};
use crate::hint::{Explain, Fault, Hint};

/// Reads all spectra of an instrument's file. The format is detected from the content.
///
/// # Errors
/// [`OpenError`] if the file cannot be read or is faulty.
pub fn open(path: impl AsRef<Path>) -> Result<InstrumentFile, OpenError> {
    let path = path.as_ref();
    Ok(read(&path.display().to_string(), &file::read(path)?, None)?)
}

/// One spectrum of a file, with the content of that file.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenedSpectrum {
    /// Path of the file, as it was given.
    pub file: String,
    /// All bytes of the file, for a checksum.
    pub bytes: Vec<u8>,
    /// The selected spectrum.
    pub spectrum: MeasuredSpectrum,
}

/// Reads one spectrum, given as `FILE` or `FILE#NAME`.
///
/// # Errors
/// [`OpenError`] if the file cannot be read or is faulty, or if the spectrum is not
/// determined: no spectrum of that name, or several in a file given without a name.
pub fn open_spectrum(file_and_name: &str) -> Result<OpenedSpectrum, OpenError> {
    let (file, name) = split_file_and_name(file_and_name);
    let bytes = file::read(Path::new(file))?;
    let found = read(file, &bytes, None)?.spectra;
    let spectrum = choose_spectrum(file, &found, name)?.clone();
    Ok(OpenedSpectrum { file: file.to_owned(), bytes, spectrum })
}

/// A file of an instrument that cannot be opened.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OpenError {
    /// The file cannot be read from the disk.
    #[error(transparent)]
    File(#[from] FileError),
    /// The content is faulty or of no known format.
    #[error(transparent)]
    Instrument(#[from] InstrumentError),
    /// The requested spectrum is not determined.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
}

impl Explain for OpenError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Instrument(error) => error.hint(),
            Self::Choice(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Instrument(error) => error.fault(),
            Self::Choice(error) => error.fault(),
        }
    }
}
