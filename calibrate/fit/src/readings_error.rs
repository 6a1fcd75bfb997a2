//! Errors of measurement files of any known format.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};
use spectra::instrument::InstrumentError;
use spectra::referencing::{ReferenceFilesError, ReferencingError};

use crate::measurement::{MeasurementError, RecipesError};

/// Measurement files that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadingsError {
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// An instrument's file is faulty.
    #[error(transparent)]
    Instrument(#[from] InstrumentError),
    /// Readings are faulty or contradict each other.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// The recipes are faulty or do not fit the readings.
    #[error(transparent)]
    Recipes(#[from] RecipesError),
    /// White, dark or tile cannot be read.
    #[error(transparent)]
    References(#[from] ReferenceFilesError),
    /// Counts and white do not make a reflectance.
    #[error("{file}: cannot be set against the white of {white}")]
    Referencing {
        /// File of the samples.
        file: String,
        /// White as the caller named it.
        white: String,
        /// Reason with the wavelength.
        #[source]
        reason: ReferencingError,
    },
    /// A white is given, but the file is a measurement CSV, which holds reflectances.
    #[error("a white needs counts as an instrument writes them, found a CSV: `{file}`")]
    CsvOfCounts {
        /// File name as the caller gave it.
        file: String,
    },
}

impl Explain for ReadingsError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Instrument(error) => error.hint(),
            Self::Measurement(error) => error.hint(),
            Self::Recipes(error) => error.hint(),
            Self::References(error) => error.hint(),
            Self::Referencing { reason, .. } => reason.hint(),
            Self::CsvOfCounts { .. } => Some(Hint::new(
                "give the spectrometer's own file, or two columns `nm counts`, or leave out [white_reading]",
            )),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Instrument(error) => error.fault(),
            Self::References(error) => error.fault(),
            Self::CsvOfCounts { .. } => Fault::Setting,
            Self::Measurement(_) | Self::Recipes(_) | Self::Referencing { .. } => Fault::Input,
        }
    }
}
