//! Replacing a file by way of a temporary file in the same folder.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::temporary::{PREFIX, Temporary, clean};

/// Flushes the directory entries of `folder` to the disk, so that a renamed file keeps its new name
/// after a power failure. This does nothing on systems without this operation.
pub fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

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

/// A file during writing. Its bytes go to a temporary file beside its target.
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

    pub(super) fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.temporary.file()?.write_all(bytes)
    }

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

/// A chain of links is followed this far, as Linux does it.
const MOST_LINKS: usize = 40;

/// `path` from the root on with all symbolic links resolved, also those that lead to a file or a folder that does not
/// exist yet.
///
/// # Errors
/// If links lead in a circle, or the current folder is not known.
pub(super) fn resolved(path: &Path) -> io::Result<PathBuf> {
    let mut whole = std::path::absolute(path)?;
    for _ in 0..MOST_LINKS {
        if let Ok(found) = whole.canonicalize() {
            return Ok(found);
        }
        let (Some(folder), Some(name)) = (whole.parent(), whole.file_name()) else {
            return Err(io::ErrorKind::NotFound.into());
        };
        let folder = resolved(folder)?;
        match folder.join(name).read_link() {
            // An absolute link replaces the folder.
            Ok(link) => whole = folder.join(link),
            Err(_) => return Ok(folder.join(name)),
        }
    }
    Err(io::Error::other("the links lead in a circle"))
}

/// Resolves symbolic links in `path`. Returns the target and the folder that contains it.
fn target(path: &Path) -> io::Result<(PathBuf, PathBuf)> {
    let target = resolved(path)?;
    let folder = target.parent().unwrap_or(Path::new(".")).to_owned();
    Ok((target, folder))
}

/// Metadata of the regular file at `target`, or `None` if it does not exist. This fails for a
/// folder or a device.
fn regular_file(target: &Path) -> io::Result<Option<std::fs::Metadata>> {
    match std::fs::metadata(target) {
        Ok(found) if found.is_file() => Ok(Some(found)),
        Ok(_) => Err(io::Error::other("not a regular file")),
        Err(_) => Ok(None),
    }
}

/// Removes the name of the temporary file, which the crate `tempfile` adds to errors. Nobody chose
/// this name, and the file is gone.
pub(super) fn unnamed(error: io::Error) -> io::Error {
    let text = error.to_string();
    match text.split_once(" at path ") {
        Some((reason, path)) if path.contains(PREFIX) => io::Error::new(error.kind(), reason),
        _ => error,
    }
}
