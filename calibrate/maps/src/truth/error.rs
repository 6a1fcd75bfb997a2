//! Errors of truth that cannot be written, read or compared.

use std::path::PathBuf;

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};

use crate::store::StoreError;

/// Truth that cannot be written, read or compared.
#[derive(Debug, thiserror::Error)]
pub enum TruthError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The maps cannot be read.
    #[error(transparent)]
    Maps(#[from] StoreError),
    /// The folder holds something else.
    #[error("{}: holds files that are no truth of a simulated scan", path.display())]
    Exists {
        /// Path of the folder.
        path: PathBuf,
    },
    /// The folder holds no truth, or damaged one.
    #[error("{}: {problem}", path.display())]
    Damaged {
        /// Path of the file or folder.
        path: PathBuf,
        /// The fault that was found.
        problem: String,
    },
    /// Rows do not fit the truth that is written.
    #[error("{}: {problem}", path.display())]
    Rows {
        /// Path of the folder.
        path: PathBuf,
        /// The numbers that disagree.
        problem: String,
    },
    /// Maps and truth are of different scans.
    #[error(
        "{}: the maps end at row {} and column {}, the truth has {lines} x {samples} pixels",
        path.display(), ends.0, ends.1
    )]
    Size {
        /// Path of the truth.
        path: PathBuf,
        /// Ends of the mapped rows and columns.
        ends: (usize, usize),
        /// Rows of the truth.
        lines: usize,
        /// Columns of the truth.
        samples: usize,
    },
}

impl Explain for TruthError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Maps(error) => error.hint(),
            Self::Exists { .. } => Some(Hint::new("name another folder, or empty this one")),
            Self::Damaged { .. } => Some(Hint::new("simulate the scan again")),
            Self::Rows { .. } => None,
            Self::Size { .. } => Some(Hint::new("name the truth of the scan that was mapped")),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Maps(error) => error.fault(),
            Self::Exists { .. } | Self::Size { .. } => Fault::Setting,
            Self::Damaged { .. } | Self::Rows { .. } => Fault::Input,
        }
    }
}
