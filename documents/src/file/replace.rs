//! Replacing a file by way of a temporary file in the same folder: at once, or piece by piece where
//! it is too large for the memory.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::temporary::{PREFIX, Temporary, clean};
use super::whole::{FileAction, FileError};

/// Flushes the directory entries of `folder` to the disk, so that a renamed file keeps
/// its new name after a power failure. Does nothing on systems without this operation.
pub fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

/// Checks that [`replace`] could write `path`, and leaves no file behind.
pub(super) fn check(path: &Path) -> io::Result<()> {
    let (target, folder) = target(path)?;
    regular_file(&target)?;
    Temporary::new(&folder).map(drop).map_err(unnamed)
}

/// Writes `bytes` to a temporary file beside `path` and renames it to `path`.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace_named(path, bytes).map_err(unnamed)
}

fn replace_named(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut replacement = Replacement::begin(path)?;
    replacement.write(bytes)?;
    replacement.finish()
}

/// A file that is being written to a temporary file beside its target.
#[derive(Debug)]
pub(super) struct Replacement {
    temporary: Temporary,
    target: PathBuf,
    folder: PathBuf,
    before: Option<std::fs::Metadata>,
}

impl Replacement {
    /// Opens a temporary file in the folder of `path`.
    pub(super) fn begin(path: &Path) -> io::Result<Self> {
        let (target, folder) = target(path)?;
        let before = regular_file(&target)?;
        clean(&folder);
        Ok(Self { temporary: Temporary::new(&folder)?, target, folder, before })
    }

    /// Adds `bytes` at the end.
    pub(super) fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.temporary.file()?.write_all(bytes)
    }

    /// Flushes the file to the disk and renames it to the target.
    pub(super) fn finish(mut self) -> io::Result<()> {
        let file = self.temporary.file()?;
        file.sync_all()?;
        if let Some(before) = self.before {
            file.set_permissions(before.permissions())?;
        }
        self.temporary.persist(&self.target)?;
        sync_folder(&self.folder);
        Ok(())
    }
}

/// Resolves symbolic links in `path`. Returns the target and the folder that contains it.
fn target(path: &Path) -> io::Result<(PathBuf, PathBuf)> {
    let target = path.canonicalize().or_else(|_| std::path::absolute(path))?;
    let folder = target.parent().unwrap_or(Path::new(".")).to_owned();
    Ok((target, folder))
}

/// Metadata of the regular file at `target`, `None` if it does not exist. A folder or a
/// device is an error.
fn regular_file(target: &Path) -> io::Result<Option<std::fs::Metadata>> {
    match std::fs::metadata(target) {
        Ok(found) if found.is_file() => Ok(Some(found)),
        Ok(_) => Err(io::Error::other("not a regular file")),
        Err(_) => Ok(None),
    }
}

/// An error without the name of a temporary file, which the crate `tempfile` adds: nobody chose
/// that name, and the file is gone.
pub(super) fn unnamed(error: io::Error) -> io::Error {
    let text = error.to_string();
    match text.split_once(" at path ") {
        Some((reason, path)) if path.contains(PREFIX) => io::Error::new(error.kind(), reason),
        _ => error,
    }
}

/// A file that is written piece by piece. Until [`FileInPieces::finish`] the path holds what it held
/// before. If you drop this value instead, nothing remains of it.
///
/// ```
/// use documents::file::FileInPieces;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("scan.bil");
/// let mut file = FileInPieces::create(&path)?;
/// file.write(b"first")?;
/// file.write(b", second")?;
/// assert!(!path.exists());
/// file.finish()?;
/// assert_eq!(std::fs::read(&path)?, b"first, second");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FileInPieces {
    path: PathBuf,
    replacement: Replacement,
}

impl FileInPieces {
    /// Begins a file that replaces `path` when it is finished.
    ///
    /// # Errors
    /// [`FileError`] with the path, in the cases of [`super::write_whole`].
    pub fn create(path: &Path) -> Result<Self, FileError> {
        let replacement = Replacement::begin(path).map_err(|reason| fault(path, reason))?;
        Ok(Self { path: path.to_owned(), replacement })
    }

    /// Adds `bytes` at the end.
    ///
    /// # Errors
    /// [`FileError`] with the path, for example for a full disk.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), FileError> {
        self.replacement.write(bytes).map_err(|reason| fault(&self.path, reason))
    }

    /// Flushes the file to the disk and gives it its name.
    ///
    /// # Errors
    /// [`FileError`] with the path.
    pub fn finish(self) -> Result<(), FileError> {
        self.replacement.finish().map_err(|reason| fault(&self.path, reason))
    }
}

fn fault(path: &Path, reason: io::Error) -> FileError {
    let reason = Arc::new(unnamed(reason));
    FileError { path: path.to_owned(), action: FileAction::Write, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dropped_file_leaves_what_was_there_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.bil");
        std::fs::write(&path, "old").unwrap();
        let mut file = FileInPieces::create(&path).unwrap();
        file.write(b"new").unwrap();
        drop(file);
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file");
        let missing = folder.path().join("missing/a.bil");
        let error = FileInPieces::create(&missing).unwrap_err();
        assert!(error.to_string().ends_with("a.bil: cannot be written"), "{error}");
    }
}
