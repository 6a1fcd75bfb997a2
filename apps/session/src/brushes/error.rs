//! Errors of brush files.

use documents::hint::{Explain, Hint};

/// A file of brushes that cannot be used, with the key that is at fault.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {}{what}", place(key))]
pub struct BrushFileError {
    /// Name of the file.
    pub file: String,
    /// Path of the key in the file, such as `presets[2].options.range`; empty for the whole file.
    pub key: String,
    /// Tells what is wrong there.
    pub what: String,
    /// Advice on what to do.
    pub hint: Option<Hint>,
}

fn place(key: &str) -> String {
    if key.is_empty() { String::new() } else { format!("key `{key}`: ") }
}

impl Explain for BrushFileError {
    fn hint(&self) -> Option<Hint> {
        self.hint.clone()
    }
}
