//! Changes of the picture beside the canvas and of the lines drawn on it.

use std::path::PathBuf;

use super::drawing::DrawnFile;

/// A change of the picture beside the canvas.
#[derive(Debug, Clone, PartialEq)]
pub enum ReferenceChange {
    /// Pins the picture in this file.
    Open(PathBuf),
    /// Pins the picture in a file again, with lines that were drawn on it and may be in no file.
    Restore {
        /// File of the picture.
        picture: PathBuf,
        /// The lines.
        drawings: Vec<DrawnFile>,
    },
    /// Removes the picture.
    Close,
    /// Shows lines read from a file, in place of those of the same kind.
    Draw(DrawnFile),
    /// These lines were saved.
    Saved(DrawnFile),
}
