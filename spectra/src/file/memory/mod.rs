//! A file system in memory, with the calls of [`std::fs`] that impasto uses.
//!
//! A page has no disk. Its files lie here; the page itself copies those that should outlive it to
//! the browser's storage, for which [`take_changes`] tells it what has changed.

mod tree;

mod open_file;

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use web_time::SystemTime;

use tree::{Node, Tree};

pub use open_file::{File, OpenOptions};
pub(super) use tree::from_root;

/// A file that has changed: its path, and its content or `None` if it is gone.
pub type Change = (PathBuf, Option<Arc<Vec<u8>>>);

static TREE: Mutex<Tree> = Mutex::new(Tree::new());

fn tree() -> MutexGuard<'static, Tree> {
    TREE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Size, kind and time of what lies at a path.
#[derive(Debug, Clone)]
pub struct Metadata {
    /// Number of bytes; none of a folder.
    bytes: Option<u64>,
    modified: SystemTime,
}

#[allow(clippy::len_without_is_empty, reason = "the calls of std::fs::Metadata")]
impl Metadata {
    /// Whether it is a file.
    #[must_use]
    pub fn is_file(&self) -> bool {
        self.bytes.is_some()
    }

    /// Whether it is a folder.
    #[must_use]
    pub fn is_dir(&self) -> bool {
        self.bytes.is_none()
    }

    /// Number of bytes; 0 of a folder.
    #[must_use]
    pub fn len(&self) -> u64 {
        self.bytes.unwrap_or(0)
    }

    /// Time of the last change.
    ///
    /// # Errors
    /// None.
    pub fn modified(&self) -> io::Result<SystemTime> {
        Ok(self.modified)
    }
}

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

    /// What the entry is.
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

/// What lies at `path`.
///
/// # Errors
/// If nothing lies there.
pub fn metadata(path: impl AsRef<Path>) -> io::Result<Metadata> {
    let tree = tree();
    let (node, modified) = tree.find(path.as_ref())?;
    let bytes = match node {
        Node::File(bytes) => Some(bytes.len() as u64),
        Node::Folder => None,
    };
    Ok(Metadata { bytes, modified })
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
pub(super) fn start_number() -> u32 {
    static NUMBER: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    *NUMBER.get_or_init(|| {
        let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        since.as_millis() as u32
    })
}

#[cfg(test)]
mod tests;
