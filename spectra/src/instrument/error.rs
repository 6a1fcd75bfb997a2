//! What can be wrong with an instrument's file, and where.

/// Why an instrument's file cannot be used. Every variant names the file, and
/// the line where there is one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InstrumentError {
    /// The file holds no spectrum.
    #[error("{file}: no spectrum in this {format} file")]
    Empty {
        /// The file.
        file: String,
        /// What it was read as.
        format: &'static str,
    },
    /// A line is not what the format wants there.
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
}
