//! Files that are open, and the calls of [`std::fs`] that open, list and move them. A call fails
//! whenever [`std::fs`] would.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs::TryLockError;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
use web_time::SystemTime;

use super::{Change, Metadata, from_root, metadata, tree};

static LOCKED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// An open file. What you write is in the file at once.
#[derive(Debug)]
pub struct File {
    path: PathBuf,
    at: u64,
    appends: bool,
    locks: Cell<bool>,
}

/// How a file is opened.
#[derive(Debug, Clone, Copy, Default)]
pub struct OpenOptions {
    create: bool,
    truncate: bool,
    append: bool,
}

impl OpenOptions {
    /// Options that open an existing file.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Does nothing, because you can always read.
    pub fn read(&mut self, _: bool) -> &mut Self {
        self
    }

    /// Does nothing, because you can always write.
    pub fn write(&mut self, _: bool) -> &mut Self {
        self
    }

    /// Whether to make the file if it is missing.
    pub fn create(&mut self, create: bool) -> &mut Self {
        self.create = create;
        self
    }

    /// Whether to remove the content.
    pub fn truncate(&mut self, truncate: bool) -> &mut Self {
        self.truncate = truncate;
        self
    }

    /// Whether to write everything at the end.
    pub fn append(&mut self, append: bool) -> &mut Self {
        self.append = append;
        self
    }

    /// Opens the file.
    pub fn open(&self, path: impl AsRef<Path>) -> io::Result<File> {
        let path = from_root(path.as_ref());
        let mut tree = tree();
        match tree.file(&path) {
            Ok(_) if self.truncate => tree.put(&path, Arc::default())?,
            Ok(_) => {}
            Err(error) if error.kind() == io::ErrorKind::NotFound && self.create => {
                tree.put(&path, Arc::default())?;
            }
            Err(error) => return Err(error),
        }
        Ok(File { path, at: 0, appends: self.append, locks: Cell::new(false) })
    }
}

impl File {
    /// Opens an existing file.
    pub fn open(path: impl AsRef<Path>) -> io::Result<Self> {
        OpenOptions::new().open(path)
    }

    /// Makes an empty file.
    pub fn create(path: impl AsRef<Path>) -> io::Result<Self> {
        OpenOptions::new().create(true).truncate(true).open(path)
    }

    /// Options for opening a file.
    #[must_use]
    pub fn options() -> OpenOptions {
        OpenOptions::new()
    }

    /// Does nothing, because what you write is in the file at once.
    pub fn sync_all(&self) -> io::Result<()> {
        Ok(())
    }

    /// Size and time of the file.
    pub fn metadata(&self) -> io::Result<Metadata> {
        metadata(&self.path)
    }

    /// Cuts the file off, or fills it up with zeros.
    pub fn set_len(&self, bytes: u64) -> io::Result<()> {
        self.change(|content| content.resize(bytes as usize, 0))
    }

    /// Locks the file until you call [`File::unlock`] or drop it.
    pub fn try_lock(&self) -> Result<(), TryLockError> {
        let mut locked = LOCKED.lock().unwrap_or_else(PoisonError::into_inner);
        if !locked.insert(self.path.clone()) {
            return Err(TryLockError::WouldBlock);
        }
        self.locks.set(true);
        Ok(())
    }

    /// Gives the lock up.
    pub fn unlock(&self) -> io::Result<()> {
        if self.locks.take() {
            LOCKED.lock().unwrap_or_else(PoisonError::into_inner).remove(&self.path);
        }
        Ok(())
    }

    /// Changes the content. This copies it only if someone else holds it too.
    fn change(&self, change: impl FnOnce(&mut Vec<u8>)) -> io::Result<()> {
        let mut tree = tree();
        let mut bytes = tree.file(&self.path)?;
        change(Arc::make_mut(&mut bytes));
        tree.put(&self.path, bytes)
    }
}

impl Drop for File {
    fn drop(&mut self) {
        let _ = self.unlock();
    }
}

impl Read for File {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let bytes = tree().file(&self.path)?;
        let rest = bytes.get(self.at as usize..).unwrap_or_default();
        let count = rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&rest[..count]);
        self.at += count as u64;
        Ok(count)
    }
}

impl Write for File {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        let at = if self.appends { self.metadata()?.len() } else { self.at };
        let end = at + buffer.len() as u64;
        self.change(|content| {
            if content.len() < end as usize {
                content.resize(end as usize, 0);
            }
            content[at as usize..end as usize].copy_from_slice(buffer);
        })?;
        self.at = end;
        Ok(buffer.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for File {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let end = self.metadata()?.len();
        let at = match to {
            SeekFrom::Start(at) => Some(at),
            SeekFrom::End(by) => end.checked_add_signed(by),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
        };
        self.at = at.ok_or(io::ErrorKind::InvalidInput)?;
        Ok(self.at)
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

    /// Size, kind and time of the entry.
    pub fn metadata(&self) -> io::Result<Metadata> {
        metadata(&self.0)
    }
}

/// Content of a file.
pub fn read(path: impl AsRef<Path>) -> io::Result<Vec<u8>> {
    tree().file(path.as_ref()).map(|bytes| bytes.to_vec())
}

/// Content of a file of text.
pub fn read_to_string(path: impl AsRef<Path>) -> io::Result<String> {
    String::from_utf8(read(path)?)
        .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
}

/// Writes a file.
pub fn write(path: impl AsRef<Path>, bytes: impl AsRef<[u8]>) -> io::Result<()> {
    tree().put(path.as_ref(), Arc::new(bytes.as_ref().to_vec()))
}

/// Entries of a folder, by name.
pub fn read_dir(path: impl AsRef<Path>) -> io::Result<std::vec::IntoIter<io::Result<DirEntry>>> {
    let entries = tree().entries(path.as_ref())?;
    Ok(entries.into_iter().map(|path| Ok(DirEntry(path))).collect::<Vec<_>>().into_iter())
}

/// Makes a folder.
pub fn create_dir(path: impl AsRef<Path>) -> io::Result<()> {
    tree().make_folder(path.as_ref())
}

/// Makes a folder and those above it.
pub fn create_dir_all(path: impl AsRef<Path>) -> io::Result<()> {
    tree().make_folders(path.as_ref())
}

/// Removes a file.
pub fn remove_file(path: impl AsRef<Path>) -> io::Result<()> {
    tree().remove_file(path.as_ref())
}

/// Removes an empty folder.
pub fn remove_dir(path: impl AsRef<Path>) -> io::Result<()> {
    let mut tree = tree();
    if !tree.entries(path.as_ref())?.is_empty() {
        return Err(io::ErrorKind::DirectoryNotEmpty.into());
    }
    tree.remove_folder(path.as_ref())
}

/// Removes a folder with all that lies in it.
pub fn remove_dir_all(path: impl AsRef<Path>) -> io::Result<()> {
    tree().remove_folder(path.as_ref())
}

/// Gives a file or folder another path. A file replaces whatever lies there.
pub fn rename(from: impl AsRef<Path>, to: impl AsRef<Path>) -> io::Result<()> {
    tree().rename(from.as_ref(), to.as_ref())
}

/// Copies a file. Returns its number of bytes.
pub fn copy(from: impl AsRef<Path>, to: impl AsRef<Path>) -> io::Result<u64> {
    let mut tree = tree();
    let bytes = tree.file(from.as_ref())?;
    let length = bytes.len() as u64;
    tree.put(to.as_ref(), bytes)?;
    Ok(length)
}

/// Copies a file. Both share the content until you write one of them.
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
