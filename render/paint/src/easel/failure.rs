//! Why an easel refuses something.

use crate::painting::PaintingError;
use crate::strokes::{Fault, StrokesError};

/// What an easel refuses. Nothing is changed then, unless the backend failed.
#[derive(Debug, thiserror::Error)]
pub enum EaselError {
    /// A surface refuses it, or its backend could not go on.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// A number out of range, or a name that nothing has.
    #[error(transparent)]
    Fault(#[from] Box<Fault>),
    /// A header that cannot be recorded under.
    #[error(transparent)]
    Strokes(#[from] StrokesError),
    /// A canvas and a palette that do not go together.
    #[error("canvas and palette have different {what}")]
    Unlike {
        /// What differs.
        what: &'static str,
    },
    /// Saving is for whoever has the files.
    #[error("an easel saves nothing")]
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

impl EaselError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Painting(error) => error.hint(),
            Self::Fault(fault) => fault.hint.clone(),
            Self::Strokes(error) => error.hint(),
            Self::Unlike { .. } => Some("set the palette up after the canvas".to_owned()),
            Self::Save => Some("write the documents of the easel".to_owned()),
            Self::NoStroke => Some("set the brush down first".to_owned()),
            Self::NoControl { .. } => Some("light, gloss and opacity can be".to_owned()),
        }
    }
}
