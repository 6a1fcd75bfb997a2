//! Errors of scripts.

use documents::hint::{Explain, Fault as FaultKind, Hint};

use crate::toml_text::{Fault, TextError};

/// Reasons why a script cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum ScriptError {
    /// The file cannot be read, is not TOML, or has a wrong key or value.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The file is TOML of another format.
    #[error("{file}, line {line}: format takes \"paint-volumes\", found `{found}`")]
    Format {
        /// Name of the file.
        file: String,
        /// Line of the key `format`, or the first.
        line: usize,
        /// Value of the key, or `nothing`.
        found: String,
    },
    /// The script has a version that this program does not know.
    #[error("{file}, line {line}: version takes 1 to {newest}, found `{found}`")]
    Version {
        /// Name of the file.
        file: String,
        /// Line of the key `version`.
        line: usize,
        /// Value of the key.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
}

impl From<Box<Fault>> for ScriptError {
    fn from(fault: Box<Fault>) -> Self {
        Self::Text(fault.into())
    }
}

impl Explain for ScriptError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Text(error) => error.hint(),
            Self::Format { .. } => Some(Hint::verbatim(
                "a script begins with format = \"paint-volumes\" and version = 1",
            )),
            Self::Version { .. } => Some(Hint::verbatim("a newer impasto may read it")),
        }
    }

    fn fault(&self) -> FaultKind {
        match self {
            Self::Text(error) => error.fault(),
            Self::Format { .. } | Self::Version { .. } => FaultKind::Input,
        }
    }
}
