//! Faults of regions.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};
use graphics::picture::PhotographError;

/// Regions cannot be read, or do not fit the subject.
#[derive(Debug, thiserror::Error)]
pub enum RegionsError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The picture of labels cannot be read.
    #[error(transparent)]
    Labels(#[from] PhotographError),
    /// The text is not TOML, or has an unknown or repeated key or a value of a wrong type.
    #[error("{file}, line {line}: {reason}")]
    Syntax {
        /// Name of the file.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// Message of the parser.
        reason: String,
    },
    /// A region has a fault.
    #[error("{file}, region `{region}`: {fault}")]
    Region {
        /// Name of the file.
        file: String,
        /// Name of the region.
        region: String,
        /// The fault.
        fault: String,
        /// The way out.
        hint: String,
    },
}

impl RegionsError {
    pub(super) fn region(file: &str, region: &str, fault: String, hint: &str) -> Self {
        let file = file.to_owned();
        let region = region.to_owned();
        Self::Region { file, region, fault, hint: hint.to_owned() }
    }
}

impl Explain for RegionsError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Labels(error) => error.hint(),
            Self::Syntax { .. } => Some(Hint::new(
                "a region has a name and one of polygon, label and material; docs/guide/painterly.md lists all keys",
            )),
            Self::Region { hint, .. } => Some(Hint::new(hint.clone())),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Labels(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
