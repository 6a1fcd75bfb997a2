//! Why an session refuses something.

use crate::painting::PaintingError;
use crate::strokes::{InvalidValue, ScriptError};

/// What an session refuses. Nothing is changed then, unless the backend failed.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// A surface refuses it, or its backend could not go on.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// A number out of range, or a name that nothing has.
    #[error(transparent)]
    Invalid(#[from] Box<InvalidValue>),
    /// A header that cannot be recorded under.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A canvas and a palette that do not go together.
    #[error("canvas and palette have different {what}")]
    Unlike {
        /// What differs.
        what: &'static str,
    },
    /// Saving is for whoever has the files.
    #[error("an session saves nothing")]
    Save,
    /// Samples without a brush on a surface.
    #[error("no stroke is open")]
    NoStroke,
    /// Dragging something that is no slider.
    #[error("`{kind}` cannot be adjusted bit by bit")]
    NoControl {
        /// The key of the action.
        kind: &'static str,
    },
}

impl SessionError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Painting(error) => error.hint(),
            Self::Invalid(fault) => fault.hint.clone(),
            Self::Script(error) => error.hint(),
            Self::Unlike { .. } => Some("set the palette up after the canvas".to_owned()),
            Self::Save => Some("write the documents of the session".to_owned()),
            Self::NoStroke => Some("set the brush down first".to_owned()),
            Self::NoControl { .. } => Some("light, gloss and opacity can be".to_owned()),
        }
    }
}
