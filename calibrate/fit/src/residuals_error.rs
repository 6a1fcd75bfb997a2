//! Reasons why residuals cannot be used.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};
use spectra::Grid;

/// A file that holds no residuals, or residuals that do not suit a library.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ResidualsError {
    /// The file could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text is not JSON, or its keys are not those of residuals.
    #[error("{file}: {reason}")]
    Syntax {
        /// File name as the caller gave it.
        file: String,
        /// Message of the JSON parser.
        reason: String,
    },
    /// The key `format` does not name residuals.
    #[error("{file}: `format` must be \"impasto-residuals\", found `{found}`")]
    Format {
        /// File name as the caller gave it.
        file: String,
        /// Value of the key `format`, or what the file begins with.
        found: String,
    },
    /// The file's version is newer than this program.
    #[error("{file}: this program reads residuals up to version {newest}, found `{found}`")]
    Version {
        /// File name as the caller gave it.
        file: String,
        /// Version of the file.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
    /// A value is impossible, or values are missing.
    #[error("{file}: sample {sample}: {what}")]
    Figures {
        /// File name as the caller gave it.
        file: String,
        /// Name of the sample.
        sample: String,
        /// Description of the fault.
        what: String,
    },
    /// The residuals do not cover the library's wavelengths.
    #[error("the residuals are known on {found}, the library needs {needed}")]
    Wavelengths {
        /// Wavelengths of the residuals.
        found: Grid,
        /// Wavelengths of the library.
        needed: Grid,
    },
    /// Too few mixtures were left out.
    #[error("the residuals hold `{found}` mixtures, {least} are needed to tell how a library errs")]
    Few {
        /// Number of mixtures.
        found: usize,
        /// Least number that is needed.
        least: usize,
    },
}

impl Explain for ResidualsError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Syntax { .. } | Self::Format { .. } => {
                Some(Hint::new("`impasto validate READINGS.csv [residuals=FILE.json]` makes them"))
            }
            Self::Version { .. } => Some(Hint::new("a newer impasto may read it")),
            Self::Figures { .. } => None,
            Self::Wavelengths { .. } => Some(Hint::new(
                "take the residuals of the readings from which the library was fitted, or state [model_error=0.1]",
            )),
            Self::Few { .. } => {
                Some(Hint::new("validate readings of more mixtures, or state [model_error=0.1]"))
            }
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
