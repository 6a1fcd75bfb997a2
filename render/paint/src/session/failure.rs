//! Errors of a painting session.

use documents::hint::{Explain, Fault, Hint};

use crate::file::PaintingFileError;
use crate::painting::PaintingError;
use crate::strokes::{InvalidValue, ScriptError, ScriptStartError};

/// Why a session refuses an action. Nothing is changed then, unless the device failed.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// A surface refuses the action, or its device failed.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// A number is out of range, or a name is unknown.
    #[error(transparent)]
    Invalid(#[from] Box<InvalidValue>),
    /// The header of a recording is invalid.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A canvas cannot be made.
    #[error(transparent)]
    Start(#[from] ScriptStartError),
    /// The painting cannot be saved.
    #[error(transparent)]
    File(#[from] PaintingFileError),
    /// Canvas and palette do not go together.
    #[error("canvas and palette have different {what}")]
    Unlike {
        /// Name of what differs.
        what: &'static str,
    },
    /// The action saves a file. Sessions do not write files; their owner does.
    #[error("a session saves nothing")]
    Save,
    /// There is no open stroke, or it was lifted.
    #[error("no stroke is open")]
    NoStroke,
    /// An action other than light, gloss and opacity was adjusted.
    #[error("`{kind}` cannot be adjusted bit by bit")]
    NoControl {
        /// Key of the action in a script.
        kind: &'static str,
    },
}

impl Explain for SessionError {
    fn hint(&self) -> Option<Hint> {
        let hint = match self {
            Self::Painting(error) => return error.hint(),
            Self::Invalid(invalid) => return invalid.hint(),
            Self::Script(error) => return error.hint(),
            Self::Start(error) => return error.hint(),
            Self::File(error) => return error.hint(),
            Self::Unlike { .. } => "set the palette up after the canvas",
            Self::Save => "write the documents of the session",
            Self::NoStroke => "set the brush down first",
            Self::NoControl { .. } => "light, gloss, stiffness and opacity can be",
        };
        Some(Hint::new(hint))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Painting(error) => error.fault(),
            Self::File(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
