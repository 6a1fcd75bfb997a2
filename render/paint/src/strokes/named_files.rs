//! Files that a script names: its pigment library, and the pictures of its grounds.

use std::path::{Path, PathBuf};

use pigment::library::{LibraryError, PigmentLibrary};

use super::script::StrokeScript;
use crate::ground::GroundRelief;

/// The pigment library of a script.
#[derive(Debug, Clone)]
pub struct ScriptLibrary {
    /// The library that the script names, or the shipped oils.
    pub library: PigmentLibrary,
    /// Name in the script of a library that does not exist. `library` then holds the shipped
    /// oils.
    pub missing: Option<String>,
}

impl StrokeScript {
    /// Opens the library of the script: the shipped oils if it names no library or gives
    /// their title, else a file relative to `folder`, the folder of the script.
    ///
    /// # Errors
    /// [`LibraryError`] if the file exists and is not a valid library.
    pub fn open_library(&self, folder: &Path) -> Result<ScriptLibrary, LibraryError> {
        let shipped = PigmentLibrary::van_gogh_oils();
        let Some(name) = self.library.as_ref().filter(|name| **name != shipped.title) else {
            return Ok(ScriptLibrary { library: shipped, missing: None });
        };
        let path = folder.join(name);
        if documents::file::disk::is_file(&path) {
            return Ok(ScriptLibrary { library: PigmentLibrary::open(path)?, missing: None });
        }
        Ok(ScriptLibrary { library: shipped, missing: Some(name.clone()) })
    }

    /// Joins `folder` and the relative paths of ground pictures, and returns the complete paths.
    pub fn complete_picture_paths(&mut self, folder: &Path) -> Vec<PathBuf> {
        let mut paths = Vec::new();
        for surface in std::iter::once(&mut self.canvas).chain(&mut self.mixing) {
            if let GroundRelief::Image(picture) = &mut surface.ground.relief {
                let path = folder.join(&picture.path);
                picture.path = path.display().to_string();
                paths.push(path);
            }
        }
        paths
    }
}
