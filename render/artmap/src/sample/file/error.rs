//! Errors of files of samples.

use pigment::LibraryError;
use spectra::file::FileError;
use spectra::hint::{Explain, Fault, Hint};

/// A file of samples cannot be read, or samples cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SampleFileError {
    /// The file cannot be read from or written to the disk.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is not OpenEXR, or is damaged.
    #[error("{file}: not an intact OpenEXR file: {reason}")]
    Container {
        /// Path of the file.
        file: String,
        /// Reason given by the decoder.
        reason: String,
    },
    /// The file is OpenEXR, but holds no samples of impasto.
    #[error("{file}: no samples of impasto: {reason}")]
    Format {
        /// Path of the file.
        file: String,
        /// Reason, with the value found.
        reason: String,
    },
    /// The file has a version that this program does not know.
    #[error("{file}: this program reads samples up to version {newest}, found `{found}`")]
    Version {
        /// Path of the file.
        file: String,
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
    /// A channel is missing or malformed.
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
    /// The samples are inconsistent, so no file can hold them.
    #[error("the samples cannot be saved: {reason}")]
    Unwritable {
        /// Reason, with the sample.
        reason: String,
    },
}

impl Explain for SampleFileError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::File(error) => return error.hint(),
            Self::Library(error) => return error.hint(),
            Self::Container { .. } => {
                "the file is truncated, damaged or not OpenEXR: make the samples again"
            }
            Self::Format { .. } => "choose a file of samples that was made by impasto",
            Self::Version { .. } => "a newer impasto may read it",
            Self::Header { .. } => "make the samples again",
            Self::Part { .. } | Self::Channel { .. } => {
                "another program changed the file: keep parts, sizes and channels as they were"
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
