//! Why a file is no painting.

use pigment::library::LibraryError;

/// A file that cannot be read, or a painting that cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PaintingFileError {
    /// No OpenEXR file, or a damaged one.
    #[error("{file}: no sound OpenEXR file: {reason}")]
    Container {
        /// The file.
        file: String,
        /// What is wrong with it.
        reason: String,
    },
    /// An OpenEXR file without our attribute, or with another format's.
    #[error("{file}: no impasto painting: {reason}")]
    Format {
        /// The file.
        file: String,
        /// What was found.
        reason: String,
    },
    /// Another version.
    #[error("{file}: this program reads paintings up to version {newest}, found `{found}`")]
    Version {
        /// The file.
        file: String,
        /// Its version.
        found: String,
        /// The newest known.
        newest: u64,
    },
    /// A description that contradicts itself.
    #[error("{file}: attribute `impasto`: {reason}")]
    Header {
        /// The file.
        file: String,
        /// What is wrong.
        reason: String,
    },
    /// The pigment library in the file is none.
    #[error(transparent)]
    Library(#[from] LibraryError),
    /// A layer's part as a whole.
    #[error("{file}: part `{part}` {reason}")]
    Part {
        /// The file.
        file: String,
        /// The part.
        part: String,
        /// What is wrong.
        reason: String,
    },
    /// A channel as a whole.
    #[error("{file}: part `{part}`, channel `{channel}` {reason}")]
    Channel {
        /// The file.
        file: String,
        /// The part.
        part: String,
        /// The channel.
        channel: String,
        /// What is wrong.
        reason: String,
    },
    /// A value that no painting has.
    #[error("{file}: part `{part}`, channel `{channel}`, x {x}, y {y}: {wanted}, found `{found}`")]
    Value {
        /// The file.
        file: String,
        /// The part.
        part: String,
        /// The channel.
        channel: String,
        /// Column on the canvas, from 0.
        x: u32,
        /// Row on the canvas, from 0.
        y: u32,
        /// What was wanted.
        wanted: &'static str,
        /// What stands there, in mm.
        found: String,
    },
    /// More than memory should be given.
    #[error("{file}: the painting takes {bytes} bytes in memory, the limit is {limit}")]
    TooLarge {
        /// The file.
        file: String,
        /// What it would take.
        bytes: u64,
        /// What it may take.
        limit: u64,
    },
    /// A painting that no file can hold.
    #[error("the painting cannot be saved: {reason}")]
    Unwritable {
        /// Why not.
        reason: String,
    },
}

impl PaintingFileError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Container { .. } => {
                Some("the file is cut off, damaged or no OpenEXR: take it from a backup")
            }
            Self::Format { .. } => {
                Some("`impasto paint STROKES.json --output PAINTING.exr` makes one")
            }
            Self::Version { .. } => Some("a newer impasto may read it"),
            Self::Library(error) => error.hint(),
            Self::Channel { .. } | Self::Value { .. } => {
                Some("another program changed the file: keep channels as they were, in mm")
            }
            Self::TooLarge { .. } => Some("reduce the canvas, or merge dry layers"),
            Self::Header { .. } | Self::Part { .. } | Self::Unwritable { .. } => None,
        }
    }
}
