//! Errors in reading and writing swatch files.

use crate::hint::Explain;

/// A fault of a palette, with its place.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SwatchFileError {
    /// Bytes that are not what the format wants there.
    #[error("{file}, byte {offset}: {wanted} is wanted, found `{found}`")]
    Bytes {
        /// The file.
        file: String,
        /// Counted from 0.
        offset: usize,
        /// What should stand there.
        wanted: &'static str,
        /// What stands there.
        found: String,
    },
    /// A line that is not what the format wants there.
    #[error("{file}, line {line}: {wanted} is wanted, found `{text}`")]
    Line {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// What should stand there.
        wanted: &'static str,
        /// What stands there, cut short.
        text: String,
    },
    /// A colour that the format cannot hold.
    #[error("{format} holds no such colour as that of `{name}`")]
    Color {
        /// The format.
        format: &'static str,
        /// The swatch.
        name: String,
    },
    /// More than the format can count.
    #[error("{format} holds up to 65535 {what}, found `{found}`")]
    TooMany {
        /// The format.
        format: &'static str,
        /// Colours, or letters of a name.
        what: &'static str,
        /// How many.
        found: usize,
    },
}

impl Explain for SwatchFileError {}
