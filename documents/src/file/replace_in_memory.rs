//! The operations of `replace` in a page, where files lie in memory.

use std::io;
use std::path::{Path, PathBuf};

use super::disk;

/// Does nothing, because what you write is in the file at once.
pub fn sync_folder(_: &Path) {}

/// Does nothing, because nobody can interrupt a write.
pub fn abandon_writes() {}

pub(super) fn check(path: &Path) -> io::Result<()> {
    match path.parent() {
        Some(folder) if disk::is_dir(folder) && !disk::is_dir(path) => Ok(()),
        Some(folder) if disk::is_dir(folder) => Err(io::ErrorKind::IsADirectory.into()),
        _ => Err(io::ErrorKind::NotFound.into()),
    }
}

/// `path` from the root on. There are no links in memory.
pub(super) fn resolved(path: &Path) -> io::Result<PathBuf> {
    disk::absolute(path)
}

pub(super) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    disk::write(path, bytes)
}
