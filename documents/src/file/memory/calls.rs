//! The calls of [`std::fs`].

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
use web_time::SystemTime;

use super::metadata::{Metadata, metadata};
use super::tree::{Change, tree};

/// An entry of a folder.
#[derive(Debug, Clone)]
pub struct DirEntry(PathBuf);

impl DirEntry {
    /// Path of the entry.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        self.0.clone()
    }

    /// Name of the entry.
    #[must_use]
    pub fn file_name(&self) -> OsString {
        self.0.file_name().unwrap_or_default().to_owned()
    }

    /// Size, kind and time of the entry.
    ///
    /// # Errors
    /// If it was removed since the folder was listed.
    pub fn metadata(&self) -> io::Result<Metadata> {
        metadata(&self.0)
    }
}

/// Content of a file.
///
/// # Errors
/// If there is no file at `path`.
pub fn read(path: impl AsRef<Path>) -> io::Result<Vec<u8>> {
    tree().file(path.as_ref()).map(|bytes| bytes.to_vec())
}

/// Content of a file of text.
///
/// # Errors
/// If there is no file at `path`, or it is no UTF-8.
pub fn read_to_string(path: impl AsRef<Path>) -> io::Result<String> {
    String::from_utf8(read(path)?)
        .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
}

/// Writes a file.
///
/// # Errors
/// If its folder is missing, or it is a folder.
pub fn write(path: impl AsRef<Path>, bytes: impl AsRef<[u8]>) -> io::Result<()> {
    tree().put(path.as_ref(), Arc::new(bytes.as_ref().to_vec()))
}

/// Entries of a folder, by name.
///
/// # Errors
/// If there is no folder at `path`.
pub fn read_dir(path: impl AsRef<Path>) -> io::Result<std::vec::IntoIter<io::Result<DirEntry>>> {
    let entries = tree().entries(path.as_ref())?;
    Ok(entries.into_iter().map(|path| Ok(DirEntry(path))).collect::<Vec<_>>().into_iter())
}

/// Makes a folder.
///
/// # Errors
/// If something lies there, or the folder above it is missing.
pub fn create_dir(path: impl AsRef<Path>) -> io::Result<()> {
    tree().make_folder(path.as_ref())
}

/// Makes a folder and those above it.
///
/// # Errors
/// If a file is in the way.
pub fn create_dir_all(path: impl AsRef<Path>) -> io::Result<()> {
    tree().make_folders(path.as_ref())
}

/// Removes a file.
///
/// # Errors
/// If there is none at `path`.
pub fn remove_file(path: impl AsRef<Path>) -> io::Result<()> {
    tree().remove_file(path.as_ref())
}

/// Removes an empty folder.
///
/// # Errors
/// If there is none at `path`, or it is not empty.
pub fn remove_dir(path: impl AsRef<Path>) -> io::Result<()> {
    let mut tree = tree();
    if !tree.entries(path.as_ref())?.is_empty() {
        return Err(io::ErrorKind::DirectoryNotEmpty.into());
    }
    tree.remove_folder(path.as_ref())
}

/// Removes a folder with all that lies in it.
///
/// # Errors
/// If there is none at `path`.
pub fn remove_dir_all(path: impl AsRef<Path>) -> io::Result<()> {
    tree().remove_folder(path.as_ref())
}

/// Gives a file or folder another path. A file replaces what lay there.
///
/// # Errors
/// If there is none at `from`, or `to` cannot be used.
pub fn rename(from: impl AsRef<Path>, to: impl AsRef<Path>) -> io::Result<()> {
    tree().rename(from.as_ref(), to.as_ref())
}

/// Copies a file. Returns its number of bytes.
///
/// # Errors
/// If there is none at `from`, or `to` cannot be used.
pub fn copy(from: impl AsRef<Path>, to: impl AsRef<Path>) -> io::Result<u64> {
    let mut tree = tree();
    let bytes = tree.file(from.as_ref())?;
    let length = bytes.len() as u64;
    tree.put(to.as_ref(), bytes)?;
    Ok(length)
}

/// Copies a file: the content is shared until one of both is written.
///
/// # Errors
/// Those of [`copy`].
pub fn hard_link(from: impl AsRef<Path>, to: impl AsRef<Path>) -> io::Result<()> {
    copy(from, to).map(drop)
}

/// Files that have changed since the last call, in the order of their paths.
pub fn take_changes() -> Vec<Change> {
    tree().take_changes()
}

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
/// Time of the start of the page in ms, without its highest bits.
pub(crate) fn start_number() -> u32 {
    static NUMBER: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    *NUMBER.get_or_init(|| {
        let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        since.as_millis() as u32
    })
}
