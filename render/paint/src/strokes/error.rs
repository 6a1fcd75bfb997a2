//! Errors of scripts.

use std::fmt;

use documents::hint::{Explain, Hint};

/// Location of a value in a script.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ValueLocation {
    /// Index of the action from 0, and its key; `None` for a value of the header.
    pub action: Option<(usize, &'static str)>,
    /// Index of the sample in its stroke, from 0.
    pub sample: Option<usize>,
    /// Path of the field, such as `pressure` or `canvas.cell_mm`.
    pub field: String,
}

impl fmt::Display for ValueLocation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((index, kind)) = self.action {
            write!(formatter, "action {index} ({kind}), ")?;
        }
        if let Some(index) = self.sample {
            write!(formatter, "sample {index}, ")?;
        }
        formatter.write_str(&self.field)
    }
}

/// A value that is out of range or does not fit the rest of the script.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{location}: {wanted}, found `{found}`")]
pub struct InvalidValue {
    /// Location of the value.
    pub location: ValueLocation,
    /// Description of the values that are allowed.
    pub wanted: String,
    /// The value as text.
    pub found: String,
    /// Advice for correcting the value, if there is any.
    pub hint: Option<Hint>,
}

impl Explain for InvalidValue {
    fn hint(&self) -> Option<Hint> {
        self.hint.clone()
    }
}

/// Why a script cannot be read or played.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScriptError {
    /// The file is longer than [`MAX_FILE_BYTES`](super::MAX_FILE_BYTES).
    #[error("{file}: a script has at most {limit} bytes, found `{bytes}`")]
    TooLong {
        /// Name of the file.
        file: String,
        /// Length of the file in bytes.
        bytes: usize,
        /// Longest length in bytes.
        limit: usize,
    },
    /// The file is not UTF-8.
    #[error("{file}: line {line}: no UTF-8, found byte `0x{byte:02x}`")]
    Encoding {
        /// Name of the file.
        file: String,
        /// Line number from 1.
        line: usize,
        /// First byte that is not part of a UTF-8 sequence.
        byte: u8,
    },
    /// The file is not JSON, or its keys and types are not those of a script.
    #[error("{file}: line {line}, column {column}: {reason}")]
    Syntax {
        /// Name of the file.
        file: String,
        /// Line number from 1.
        line: usize,
        /// Column number from 1.
        column: usize,
        /// Message of the JSON parser.
        reason: String,
    },
    /// The file is JSON of another format.
    #[error("{file}: `format` must be \"strokes\", found `{found}`")]
    Format {
        /// Name of the file.
        file: String,
        /// Value of the key `format`.
        found: String,
    },
    /// The script has a version that this program does not know.
    #[error("{file}: this program reads strokes up to version {newest}, found `{found}`")]
    Version {
        /// Name of the file.
        file: String,
        /// Value of the key `version`.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
    /// A value of a file is invalid.
    #[error("{file}: {invalid}")]
    Value {
        /// Name of the file.
        file: String,
        /// The value and its location.
        invalid: Box<InvalidValue>,
    },
    /// A value of a script in memory is invalid.
    #[error(transparent)]
    Invalid(#[from] Box<InvalidValue>),
}

impl Explain for ScriptError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::TooLong { .. } => {
                Some(Hint::new("record fewer samples a second, or several scripts"))
            }
            Self::Encoding { .. } => Some(Hint::new("save the script as UTF-8")),
            Self::Version { .. } => Some(Hint::new("a newer impasto may read it")),
            Self::Value { invalid, .. } | Self::Invalid(invalid) => invalid.hint(),
            Self::Syntax { .. } | Self::Format { .. } => None,
        }
    }
}
