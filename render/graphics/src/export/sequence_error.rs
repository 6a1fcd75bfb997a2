//! Reasons why a folder of frames cannot be used.

use std::path::PathBuf;

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};

use super::frame::FrameError;

/// Name of the file that says what the frames of a folder belong to.
pub(super) const MANIFEST: &str = "animation.json";

/// A folder of frames cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SequenceError {
    /// A frame or the manifest cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file or folder cannot be read or changed.
    #[error("{}: {source}", .path.display())]
    Io {
        /// Path of the file or folder.
        path: PathBuf,
        /// Reason given by the system.
        source: std::io::Error,
    },
    /// The folder holds frames but no manifest that says what they belong to.
    #[error("{}: the folder holds frames but no {MANIFEST}", .path.display())]
    Foreign {
        /// Path of the first such frame.
        path: PathBuf,
    },
    /// `animation.json` is not a manifest of this version.
    #[error("{}: {reason}", .path.display())]
    Manifest {
        /// Path of the manifest.
        path: PathBuf,
        /// Reason why it is rejected.
        reason: String,
    },
    /// A frame cannot be encoded or decoded.
    #[error("{}: {source}", .path.display())]
    Frame {
        /// Path of the frame.
        path: PathBuf,
        /// Error of the encoder or decoder.
        source: FrameError,
    },
    /// The frames cannot be joined to an animation.
    #[error(transparent)]
    Animation(#[from] FrameError),
}

impl Explain for SequenceError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::File(_) | Self::Io { .. } => "is the folder writable, and is there room?",
            Self::Foreign { .. } => "name an empty folder, or move the frames away",
            Self::Manifest { .. } => "name an empty folder, or remove this one",
            Self::Frame { source, .. } | Self::Animation(source) => return source.hint(),
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Frame { source, .. } | Self::Animation(source) => source.fault(),
            _ => Fault::Environment,
        }
    }
}
