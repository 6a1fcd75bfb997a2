//! Files that are read whole, and written whole or not at all.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::hint::{Explain, Fault, Hint};

/// Why a file was not read or written. Nothing was changed on the disk.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be {}", path.display(), action.participle())]
pub struct FileError {
    /// The file, as the caller named it.
    pub path: PathBuf,
    /// Whether it was to be read or written.
    pub action: FileAction,
    /// The system's reason.
    #[source]
    pub reason: io::Error,
}

/// What was to be done with a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileAction {
    /// Read the whole file.
    Read,
    /// Write the whole file.
    Write,
}

impl FileAction {
    fn participle(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Write => "written",
        }
    }
}

impl Explain for FileError {
    fn hint(&self) -> Option<Hint> {
        self.reason.hint()
    }

    fn fault(&self) -> Fault {
        Fault::Environment
    }
}

/// The bytes of a file.
///
/// # Errors
/// [`FileError`] with the path.
pub fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    std::fs::read(path).map_err(|reason| error(path, FileAction::Read, reason))
}

/// Writes `bytes` to a temporary file beside `path`, and renames it when all of it is
/// on the disk: at every moment `path` holds the old content or the new one. A link
/// keeps pointing where it does, and a file keeps its permissions.
///
/// # Errors
/// [`FileError`] with the path, also where `path` is a folder or a device.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    replace(path, bytes).map_err(|reason| error(path, FileAction::Write, reason))
}

/// Checks that [`write_whole`] could write `path` now, and leaves nothing behind. For
/// programs that want to fail before the slow part.
///
/// # Errors
/// As [`write_whole`].
pub fn check_writable(path: &Path) -> Result<(), FileError> {
    let checked = target(path).and_then(|(target, folder)| {
        ordinary(&target)?;
        temporary(&folder).map(drop)
    });
    checked.map_err(|reason| error(path, FileAction::Write, reason))
}

/// Brings the entries of `folder` to the disk, so that a file that was renamed there
/// keeps its name through a loss of power. Systems that cannot do so are left alone.
pub fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let (target, folder) = target(path)?;
    let before = ordinary(&target)?;
    let mut file = temporary(&folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    if let Some(before) = before {
        file.as_file().set_permissions(before.permissions())?;
    }
    file.persist(&target)?;
    sync_folder(&folder);
    Ok(())
}

/// `path` with links followed, and the folder that holds it.
fn target(path: &Path) -> io::Result<(PathBuf, PathBuf)> {
    let target = path.canonicalize().or_else(|_| std::path::absolute(path))?;
    let folder = target.parent().unwrap_or(Path::new(".")).to_owned();
    Ok((target, folder))
}

/// Metadata of the file at `target`, if there is one; an error for a folder or a device.
fn ordinary(target: &Path) -> io::Result<Option<std::fs::Metadata>> {
    match std::fs::metadata(target) {
        Ok(found) if found.is_file() => Ok(Some(found)),
        Ok(_) => Err(io::Error::other("this is no ordinary file")),
        Err(_) => Ok(None),
    }
}

/// A temporary file in `folder`, removed when dropped.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".impasto-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The permissions of any new file; the user's mask applies.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

fn error(path: &Path, action: FileAction, reason: io::Error) -> FileError {
    FileError { path: path.to_owned(), action, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_written_whole_and_leaves_nothing_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        check_writable(&path).unwrap();
        assert!(names(folder.path()).is_empty(), "a check leaves nothing");
        write_whole(&path, b"one").unwrap();
        write_whole(&path, b"two").unwrap();
        assert_eq!(read(&path).unwrap(), b"two");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_file_that_cannot_be_written_is_named_and_leaves_no_trace() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("missing").join("a.txt");
        let error = write_whole(&inside, b"one").unwrap_err();
        assert!(error.to_string().ends_with("a.txt: cannot be written"), "{error}");
        assert!(error.hint().is_some(), "the folder is missing");
        std::fs::create_dir(folder.path().join("b.exr")).unwrap();
        write_whole(&folder.path().join("b.exr"), b"one").unwrap_err();
        check_writable(&folder.path().join("b.exr")).unwrap_err();
        assert_eq!(names(folder.path()), ["b.exr"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_keeps_pointing_where_it_does() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("a.txt"), folder.path().join("link.txt"));
        write_whole(&file, b"one").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_whole(&link, b"two").unwrap();
        assert_eq!(read(&file).unwrap(), b"two");
        assert!(link.is_symlink(), "the link itself was replaced");
    }
}
