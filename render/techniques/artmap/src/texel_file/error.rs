//! Errors of files of texels.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};
use pigment::LibraryError;

/// A file of samples or an art map cannot be read or written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TexelFileError {
    /// The file cannot be read from or written to the disk.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is not OpenEXR, or is damaged.
    #[error("{file}: not an intact OpenEXR file: {reason}")]
    Container {
        /// Path of the file.
        file: String,
        /// Content that was expected, in words.
        content: &'static str,
        /// Reason given by the decoder.
        reason: String,
    },
    /// The file is OpenEXR, but holds something else.
    #[error("{file}: no {content} of impasto: {reason}")]
    Format {
        /// Path of the file.
        file: String,
        /// Content that was expected, in words.
        content: &'static str,
        /// Reason, with the value found.
        reason: String,
    },
    /// The file has a version that this program does not know.
    #[error("{file}: {content} of version `{found}`, this program reads versions up to {newest}")]
    Version {
        /// Path of the file.
        file: String,
        /// Content in words.
        content: &'static str,
        /// Version of the file.
        found: String,
        /// Newest version that can be read.
        newest: u64,
    },
    /// The description in attribute `impasto` is invalid.
    #[error("{file}: attribute `impasto`: {reason}")]
    Header {
        /// Path of the file.
        file: String,
        /// Content in words.
        content: &'static str,
        /// Reason, with the key.
        reason: String,
    },
    /// The pigment library in the file is invalid.
    #[error(transparent)]
    Library(#[from] LibraryError),
    /// A part of the file is missing or malformed.
    #[error("{file}: part `{part}` {reason}")]
    Part {
        /// Path of the file.
        file: String,
        /// Name of the part.
        part: String,
        /// Reason, continuing the sentence that starts with the part.
        reason: String,
    },
    /// A channel is missing or malformed, or one of its values is impossible.
    #[error("{file}: part `{part}`, channel `{channel}` {reason}")]
    Channel {
        /// Path of the file.
        file: String,
        /// Name of the part.
        part: String,
        /// Name of the channel.
        channel: String,
        /// Reason, continuing the sentence that starts with the channel.
        reason: String,
    },
    /// A part has possible values, but not those that were written.
    #[error("{file}: part `{part}` does not hold the values that were written")]
    Changed {
        /// Path of the file.
        file: String,
        /// Content in words.
        content: &'static str,
        /// Name of the part.
        part: String,
    },
    /// The content is inconsistent, so no file can hold it.
    #[error("the {content} cannot be saved: {reason}")]
    Unwritable {
        /// Content in words.
        content: &'static str,
        /// Reason, with the sample or tile.
        reason: String,
    },
}

impl Explain for TexelFileError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::File(error) => return error.hint(),
            Self::Library(error) => return error.hint(),
            Self::Container { content, .. } => {
                format!("the file is truncated, damaged or not OpenEXR: make the {content} again")
            }
            Self::Format { content, .. } => {
                format!("choose another file, which impasto wrote as {content}")
            }
            Self::Version { .. } => "a newer impasto may read it".to_owned(),
            Self::Header { content, .. } => format!("make the {content} again"),
            Self::Part { .. } | Self::Channel { .. } => "another program changed the file: keep \
                parts, sizes and channels as they were"
                .to_owned(),
            Self::Changed { content, .. } => {
                format!("the file is damaged or was changed: make the {content} again")
            }
            Self::Unwritable { .. } => return None,
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
