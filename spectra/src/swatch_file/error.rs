//! Errors in reading and writing swatch files.

use documents::hint::Explain;

/// A swatch file that cannot be read or written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SwatchFileError {
    /// Bytes do not follow the format.
    #[error("{file}, byte {offset}: expected {expected}, found `{found}`")]
    Bytes {
        /// Path of the file.
        file: String,
        /// Offset in bytes, from 0.
        offset: usize,
        /// Description of the expected content.
        expected: &'static str,
        /// The content that was found.
        found: String,
    },
    /// A line does not follow the format.
    #[error("{file}, line {line}: expected {expected}, found `{text}`")]
    Line {
        /// Path of the file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// Description of the expected content.
        expected: &'static str,
        /// The content of the line, shortened.
        text: String,
    },
    /// The format cannot represent a colour.
    #[error("{format} files cannot hold the colour of `{name}`")]
    Color {
        /// Extension of the format.
        format: &'static str,
        /// Name of the swatch.
        name: String,
    },
    /// There are more items than the format can count.
    #[error("{format} files hold up to 65535 {what}, found `{found}`")]
    TooMany {
        /// Extension of the format.
        format: &'static str,
        /// The things that are counted, in the plural.
        what: &'static str,
        /// Number of items.
        found: usize,
    },
}

impl Explain for SwatchFileError {}
