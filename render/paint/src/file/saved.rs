//! Opening and saving documents by path.

use std::path::Path;

use super::error::PaintingFileError;
use super::read::read;
use super::write::write;
use crate::document::Document;

impl Document {
    /// Reads a painting from its file (OpenEXR, see [`crate::file`]).
    ///
    /// # Errors
    /// [`PaintingFileError`] if the file cannot be read or is not a valid painting.
    pub fn open(path: &Path) -> Result<Self, PaintingFileError> {
        read(&path.display().to_string(), &documents::file::read(path)?)
    }

    /// Writes the painting to a file (OpenEXR, see [`crate::file`]), which is replaced as a
    /// whole or not at all.
    ///
    /// # Errors
    /// [`PaintingFileError`] if the document is inconsistent or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), PaintingFileError> {
        Ok(documents::file::write_whole(path, &write(self)?)?)
    }
}
