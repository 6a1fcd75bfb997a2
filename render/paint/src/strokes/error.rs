//! Why a script cannot be replayed.

use std::fmt;

/// Where in a script something is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ValueLocation {
    /// The action, counted from 0, with its key; none outside of the actions.
    pub action: Option<(usize, &'static str)>,
    /// The sample of a stroke, counted from 0.
    pub sample: Option<usize>,
    /// The field, such as `pressure` or `canvas.cell_mm`.
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

/// A value that no script may have.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{place}: {wanted}, found `{found}`")]
pub struct InvalidValue {
    /// Where.
    pub place: ValueLocation,
    /// What was wanted.
    pub wanted: String,
    /// What stands there.
    pub found: String,
    /// What to try.
    pub hint: Option<String>,
}

/// Why a script cannot be replayed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScriptError {
    /// Longer than is read.
    #[error("{file}: a script has at most {limit} bytes, found `{bytes}`")]
    TooLong {
        /// The file.
        file: String,
        /// Its length.
        bytes: usize,
        /// The limit.
        limit: usize,
    },
    /// No UTF-8.
    #[error("{file}: line {line}: no UTF-8, found byte `0x{byte:02x}`")]
    Encoding {
        /// The file.
        file: String,
        /// Where, from 1.
        line: usize,
        /// The byte that is not part of a letter.
        byte: u8,
    },
    /// No JSON, or keys and values that do not fit.
    #[error("{file}: line {line}, column {column}: {reason}")]
    Syntax {
        /// The file.
        file: String,
        /// Where, from 1.
        line: usize,
        /// Where, from 1.
        column: usize,
        /// What the parser said.
        reason: String,
    },
    /// Another kind of file.
    #[error("{file}: `format` must be \"strokes\", found `{found}`")]
    Format {
        /// The file.
        file: String,
        /// What stands there.
        found: String,
    },
    /// Another version.
    #[error("{file}: this program reads strokes up to version {newest}, found `{found}`")]
    Version {
        /// The file.
        file: String,
        /// Its version.
        found: String,
        /// The newest known.
        newest: u64,
    },
    /// A value out of range in a file.
    #[error("{file}: {fault}")]
    Value {
        /// The file.
        file: String,
        /// What and where.
        fault: Box<InvalidValue>,
    },
    /// A value out of range in a script at hand.
    #[error(transparent)]
    Invalid(#[from] Box<InvalidValue>),
}

impl ScriptError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::TooLong { .. } => {
                Some("record fewer samples a second, or several scripts".into())
            }
            Self::Encoding { .. } => Some("save the script as UTF-8".into()),
            Self::Version { .. } => Some("a newer impasto may read it".into()),
            Self::Value { fault, .. } | Self::Invalid(fault) => fault.hint.clone(),
            Self::Syntax { .. } | Self::Format { .. } => None,
        }
    }
}
