//! Saving the script of a scene, beside its subject and its library.

use std::path::{Path, PathBuf};

use documents::file::disk;
use documents::file::write_whole;
use documents::hint::Hint;
use volumes::script::Script;

use super::event::SceneRecording;
use crate::failure::FileFailure;

impl SceneRecording {
    /// Writes the script in a file, which lies beside the file of its subject. A library of the
    /// painter's own is copied beside it, unless it lies there already.
    ///
    /// # Errors
    /// [`FileFailure`] for a file beside another subject, one that cannot be written, and another
    /// library of the same name.
    pub fn save(&self, path: &Path) -> Result<(), FileFailure> {
        if let Some(subject) =
            self.subject.as_deref().filter(|own| folder_of(own) != folder_of(path))
        {
            let what = format!("{}: a script lies beside its subject", path.display());
            let folder = subject.parent().unwrap_or(Path::new(".")).display();
            let hint = Some(Hint::new(format!("save it in {folder}")));
            return Err(FileFailure { what, hint });
        }
        let text = match &self.library {
            None => self.text.to_string(),
            Some(library) => {
                let name = library.file_name().unwrap_or_default();
                copied(library, &path.with_file_name(name))?;
                let script = Script::from_own_text("the scene", &self.text);
                let mut script = script.map_err(|error| FileFailure::explained(&error))?;
                script.library = Some(name.to_string_lossy().into_owned());
                script.to_text().map_err(|error| FileFailure::explained(&error))?
            }
        };
        write_whole(path, text.as_bytes()).map_err(|error| FileFailure::explained(&error))
    }
}

/// The folder that a file lies in.
fn folder_of(path: &Path) -> Option<PathBuf> {
    let path = disk::absolute(path).unwrap_or_else(|_| path.to_owned());
    path.parent().and_then(|folder| disk::canonicalize(folder).ok())
}

/// Copies a library to `to`, unless it is there.
fn copied(library: &Path, to: &Path) -> Result<(), FileFailure> {
    let read =
        |path: &Path| disk::read(path).map_err(|error| FileFailure::io(path, "read", &error));
    let bytes = read(library)?;
    if disk::exists(to) {
        if read(to)? == bytes {
            return Ok(());
        }
        let what = format!("{}: another library has this name", to.display());
        let hint = Some(Hint::new("save the script in another folder"));
        return Err(FileFailure { what, hint });
    }
    write_whole(to, &bytes).map_err(|error| FileFailure::explained(&error))
}
