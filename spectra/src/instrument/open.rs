//! Opening instrument files by path.

use std::path::Path;

use super::choice::{ChoiceError, choose_spectrum, split_file_and_name};
use super::error::InstrumentError;
use super::measured::MeasuredSpectrum;
use super::read::{InstrumentFile, read};
use super::workbook::split_file_and_sheet;
use documents::file::{self, FileError};
use documents::hint::{Explain, Fault, Hint};

/// Bytes of a file that is given as `FILE` or `FILE.xlsx#SHEET`.
///
/// # Errors
/// [`FileError`] if the file cannot be read.
pub fn bytes_of(path: impl AsRef<Path>) -> Result<Vec<u8>, FileError> {
    let path = path.as_ref();
    let sheet = path.to_str().map(split_file_and_sheet).filter(|(_, sheet)| sheet.is_some());
    file::read(sheet.map_or(path, |(file, _)| Path::new(file)))
}

/// Reads all spectra of an instrument's file, or of the sheet `FILE.xlsx#SHEET`. The format is detected from
/// the content.
///
/// # Errors
/// [`OpenError`] if the file cannot be read or is faulty.
pub fn open(path: impl AsRef<Path>) -> Result<InstrumentFile, OpenError> {
    let path = path.as_ref();
    Ok(read(&path.display().to_string(), &bytes_of(path)?, None)?)
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

/// Reads one spectrum, given as `FILE` or `FILE#NAME`; of a certain sheet as `FILE.xlsx#SHEET#NAME`.
///
/// # Errors
/// [`OpenError`] if the file cannot be read or is faulty, or if the spectrum is not
/// determined: no spectrum of that name, or several in a file given without a name.
pub fn open_spectrum(file_and_name: &str) -> Result<OpenedSpectrum, OpenError> {
    let (file, name) = split_file_and_name(file_and_name);
    let bytes = bytes_of(file)?;
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
