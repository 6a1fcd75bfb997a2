//! Why a file of kept mixtures cannot be read.

use documents::hint::{Explain, Hint};

/// Fault of a file of kept mixtures.
#[derive(Debug, thiserror::Error)]
pub enum SwatchBookError {
    /// The file is not JSON.
    #[error("{file}: {source}")]
    Json {
        /// Name of the file.
        file: String,
        /// Line and column of the fault.
        source: serde_json::Error,
    },
    /// The file is JSON of another kind, or of a later version.
    #[error("{file}: key `{key}`: expected {expected}, found `{found}`")]
    Kind {
        /// Name of the file.
        file: String,
        /// `format` or `version`.
        key: &'static str,
        /// Value of this version.
        expected: String,
        /// Value in the file.
        found: String,
    },
    /// A value cannot be used.
    #[error("{file}: key `{key}`: {reason}")]
    Value {
        /// Name of the file.
        file: String,
        /// Path of the key, such as `swatches[3].vehicle`.
        key: String,
        /// Expected value, and the one found.
        reason: String,
    },
}

impl Explain for SwatchBookError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Json { .. } => "choose a file that the studio has written",
            Self::Kind { key: "version", .. } => {
                "a later version of the studio wrote it; use that one"
            }
            Self::Kind { .. } => "choose a file of kept mixtures",
            Self::Value { .. } => "correct this value in the file",
        }))
    }
}
