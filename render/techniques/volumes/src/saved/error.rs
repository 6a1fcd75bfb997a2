//! Reasons why a saved state cannot be used.

use documents::hint::{Explain, Fault, Hint};

/// A saved state cannot be used. Whoever reads it starts from the beginning instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum SavedError {
    /// The file holds something else.
    #[error("not a saved {kind}")]
    Foreign {
        /// Kind of state that was wanted.
        kind: &'static str,
    },
    /// The file was written by another version.
    #[error("a saved {kind} of version {found}; this program reads version {read}")]
    Version {
        /// Kind of state.
        kind: &'static str,
        /// Version of the file.
        found: u32,
        /// Version that is read.
        read: u32,
    },
    /// The state belongs to another scene, to other settings, or to another wish.
    #[error("saved for another scene, or with other settings")]
    Other,
    /// The file was cut short or changed.
    #[error("cut short or damaged")]
    Damaged,
}

impl Explain for SavedError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("leave the file out to start from the beginning"))
    }

    fn fault(&self) -> Fault {
        Fault::Input
    }
}
