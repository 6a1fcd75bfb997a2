//! Errors of a timelapse.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};
use graphics::export::{ExportError, FrameError, SequenceError};

use crate::file::PaintingFileError;
use crate::painting::PaintingError;
use crate::session::SessionError;
use crate::strokes::ScriptError;

/// Why a timelapse cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum TimelapseError {
    /// A setting is out of range.
    #[error("{name} takes {wanted}, found `{found}`")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Range of the setting.
        wanted: &'static str,
        /// Value of the setting.
        found: f64,
    },
    /// The settings ask for too many frames.
    #[error("a timelapse has at most {most} frames, found `{found}`")]
    Frames {
        /// Greatest number of frames.
        most: usize,
        /// Number of frames asked for.
        found: usize,
    },
    /// The script is invalid.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// The session refuses an action.
    #[error("action {index} ({kind})")]
    Action {
        /// Index of the action, from 0.
        index: usize,
        /// Key of the action in the file.
        kind: &'static str,
        /// Error of the session.
        #[source]
        error: Box<SessionError>,
    },
    /// A picture cannot be computed.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// The painting that the script continues cannot be encoded.
    #[error(transparent)]
    Start(#[from] PaintingFileError),
    /// A picture has colours that are no numbers.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The folder of frames cannot be used.
    #[error(transparent)]
    Sequence(#[from] SequenceError),
    /// The animation cannot be encoded.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// The animation cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

impl Explain for TimelapseError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Setting { .. } => None,
            Self::Frames { .. } => Some(Hint::new("take a frame less often")),
            Self::Script(error) => error.hint(),
            Self::Action { error, .. } => error.hint(),
            Self::Painting(error) => error.hint(),
            Self::Start(error) => error.hint(),
            Self::Export(error) => error.hint(),
            Self::Sequence(error) => error.hint(),
            Self::Frame(error) => error.hint(),
            Self::File(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Setting { .. } | Self::Frames { .. } => Fault::Setting,
            Self::Script(error) => error.fault(),
            Self::Action { error, .. } => error.fault(),
            Self::Painting(error) => error.fault(),
            Self::Start(error) => error.fault(),
            Self::Export(error) => error.fault(),
            Self::Sequence(error) => error.fault(),
            Self::Frame(error) => error.fault(),
            Self::File(error) => error.fault(),
        }
    }
}
