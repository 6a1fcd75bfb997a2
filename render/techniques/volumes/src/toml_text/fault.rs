//! A value that is wrong, and the way out.

use documents::hint::{Explain, Hint};

use super::key_path::KeyPath;

/// Result of a check.
pub(crate) type Checked = Result<(), Box<Fault>>;

/// A value that is out of its range, or does not fit the values beside it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key} takes {wanted}, found `{found}`")]
pub struct Fault {
    /// Path of the value.
    pub key: KeyPath,
    /// Values that are allowed.
    pub wanted: String,
    /// The value as text.
    pub found: String,
    /// Sentence on the way out.
    pub hint: String,
}

impl Fault {
    /// A fault of the value at `key`.
    pub(crate) fn new(
        key: &KeyPath,
        wanted: impl Into<String>,
        found: impl std::fmt::Display,
        hint: impl Into<String>,
    ) -> Box<Self> {
        let wanted = wanted.into();
        let hint = hint.into();
        Box::new(Self { key: key.clone(), wanted, found: found.to_string(), hint })
    }
}

impl Explain for Fault {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::verbatim(self.hint.clone()))
    }
}
