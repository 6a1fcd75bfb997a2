//! Lines drawn on the reference picture: marks of samples and guides of strokes, as files.

use std::path::{Path, PathBuf};

use artmap::passages::Marks;
use painterly::guides::Guides;

use super::problem::Problem;
use crate::language::english;

/// A kind of drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawingKind {
    /// Marks of samples.
    Marks,
    /// Guides of strokes.
    Guides,
}

/// Lines drawn on the reference picture.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawing {
    /// Marks of samples.
    Marks(Marks),
    /// Guides of strokes.
    Guides(Guides),
}

/// A drawing and its file.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnFile {
    /// The lines.
    pub drawing: Drawing,
    /// The file that holds them, or that is suggested for them.
    pub path: PathBuf,
}

impl DrawingKind {
    /// Word for drawings of this kind.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Marks => english("marks"),
            Self::Guides => english("guides"),
        }
    }

    /// File beside a picture that is suggested for its drawing: `orchard.marks.toml` for
    /// `orchard.png`.
    #[must_use]
    pub fn beside(self, picture: &Path) -> PathBuf {
        picture.with_extension(format!("{}.toml", self.name()))
    }

    /// Reads a drawing of this kind.
    ///
    /// # Errors
    /// [`Problem`] with the place in the file.
    pub(super) fn open(self, path: &Path) -> Result<Drawing, Problem> {
        match self {
            Self::Marks => {
                Marks::open(path).map(Drawing::Marks).map_err(|error| Problem::from_error(&error))
            }
            Self::Guides => {
                Guides::open(path).map(Drawing::Guides).map_err(|error| Problem::from_error(&error))
            }
        }
    }
}

impl Drawing {
    /// The kind of the drawing.
    #[must_use]
    pub fn kind(&self) -> DrawingKind {
        match self {
            Self::Marks(_) => DrawingKind::Marks,
            Self::Guides(_) => DrawingKind::Guides,
        }
    }

    /// Writes the drawing.
    ///
    /// # Errors
    /// [`Problem`] if the file cannot be written.
    pub(super) fn save(&self, path: &Path) -> Result<(), Problem> {
        match self {
            Self::Marks(marks) => marks.save(path).map_err(|error| Problem::from_error(&error)),
            Self::Guides(guides) => guides.save(path).map_err(|error| Problem::from_error(&error)),
        }
    }
}
