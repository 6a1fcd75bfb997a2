//! Errors of painting files.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};
use pigment::library::LibraryError;

/// A painting's file cannot be read, or a painting cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PaintingFileError {
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
    /// The file is OpenEXR, but not a painting of impasto.
    #[error("{file}: not a painting of impasto: {reason}")]
    Format {
        /// Path of the file.
        file: String,
        /// Reason, with what was found.
        reason: String,
    },
    /// The file has a version that this program does not know.
    #[error("{file}: this program reads paintings up to version {newest}, found `{found}`")]
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
    /// A value is not a possible amount or height.
    #[error("{file}: part `{part}`, channel `{channel}`, x {x}, y {y}: {wanted}, found `{found}`")]
    Value {
        /// Path of the file.
        file: String,
        /// Name of the part.
        part: String,
        /// Name of the channel.
        channel: String,
        /// Column on the canvas, from 0.
        x: u32,
        /// Row on the canvas, from 0.
        y: u32,
        /// Range of values allowed.
        wanted: &'static str,
        /// Value found, in mm.
        found: String,
    },
    /// The painting would take more memory than allowed.
    #[error("{file}: the painting takes {bytes} bytes in memory, the limit is {limit}")]
    TooLarge {
        /// Path of the file.
        file: String,
        /// Bytes that the painting needs.
        bytes: u64,
        /// Most bytes allowed.
        limit: u64,
    },
    /// The painting is inconsistent, so no file can hold it.
    #[error("the painting cannot be saved: {reason}")]
    Unwritable {
        /// Reason, with the layer.
        reason: String,
    },
}

impl Explain for PaintingFileError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::File(error) => return error.hint(),
            Self::Container { .. } => {
                "the file is truncated, damaged or not OpenEXR: restore it from a backup"
            }
            Self::Format { .. } => "choose a painting that was saved by impasto",
            Self::Version { .. } => "a newer impasto may read it",
            Self::Library(error) => return error.hint(),
            Self::Channel { .. } | Self::Value { .. } => {
                "another program changed the file: keep channels as they were, in mm"
            }
            Self::TooLarge { .. } => "reduce the canvas, or merge dry layers",
            Self::Header { .. } | Self::Part { .. } | Self::Unwritable { .. } => return None,
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
