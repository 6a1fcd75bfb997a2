//! Changes of the picture beside the canvas and of the lines drawn on it.

use std::path::PathBuf;

use super::drawing::DrawnFile;

/// A change of the picture beside the canvas.
#[derive(Debug, Clone, PartialEq)]
pub enum ReferenceChange {
    /// Pins the picture in this file.
    Open(PathBuf),
    /// Removes the picture.
    Close,
    /// Shows lines read from a file, in place of those of the same kind.
    Draw(DrawnFile),
    /// These lines were saved.
    Saved(DrawnFile),
}
