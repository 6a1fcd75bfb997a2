//! Errors of texts in TOML.

use documents::file::FileError;
use documents::hint::{Explain, Fault as FaultKind, Hint};

use super::fault::Fault;
use super::key_path::KeyPath;

/// Reasons why a text in TOML cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TextError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is longer than any that a person writes.
    #[error("{file}: it has {bytes} bytes, more than `{most}`")]
    TooLong {
        /// Name of the file.
        file: String,
        /// Length of the file in bytes.
        bytes: usize,
        /// Longest length in bytes.
        most: usize,
    },
    /// The file holds bytes that are not UTF-8.
    #[error("{file}, line {line}: this is no UTF-8 text, found byte `0x{byte:02x}`")]
    Encoding {
        /// Name of the file.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// First byte that belongs to no letter.
        byte: u8,
    },
    /// The text is not TOML, or has an unknown key or a value of a wrong type.
    #[error("{file}, line {line}: {}{reason}", key.as_ref().map_or(String::new(), |key| format!("{key}: ")))]
    Syntax {
        /// Name of the file.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// Path of the value; none where the text is not TOML.
        key: Option<KeyPath>,
        /// Reason, with the value.
        reason: String,
        /// Sentence on the way out.
        hint: String,
    },
    /// A value is wrong.
    #[error("{file}, line {line}: {fault}")]
    Value {
        /// Name of the file.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// The value and the way out.
        fault: Box<Fault>,
    },
    /// A value that was made by code is wrong.
    #[error(transparent)]
    Invalid(#[from] Box<Fault>),
}

impl Explain for TextError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::TooLong { .. } => Some(Hint::new("divide it, or record less often")),
            Self::Encoding { .. } => Some(Hint::new("save the file as UTF-8")),
            Self::Syntax { hint, .. } => Some(Hint::verbatim(hint.clone())),
            Self::Value { fault, .. } | Self::Invalid(fault) => fault.hint(),
        }
    }

    fn fault(&self) -> FaultKind {
        match self {
            Self::File(error) => error.fault(),
            _ => FaultKind::Input,
        }
    }
}
