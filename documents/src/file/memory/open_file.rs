//! Files that are open.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::fs::TryLockError;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::metadata::{Metadata, metadata};
use super::tree::{from_root, tree};

/// Paths that are locked.
static LOCKED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// An open file. What is written is in the file at once.
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
    /// Opens a file that is there.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Whether it is read; it always can be.
    pub fn read(&mut self, _: bool) -> &mut Self {
        self
    }

    /// Whether it is written; it always can be.
    pub fn write(&mut self, _: bool) -> &mut Self {
        self
    }

    /// Whether it is made if it is missing.
    pub fn create(&mut self, create: bool) -> &mut Self {
        self.create = create;
        self
    }

    /// Whether its content is removed.
    pub fn truncate(&mut self, truncate: bool) -> &mut Self {
        self.truncate = truncate;
        self
    }

    /// Whether all is written at its end.
    pub fn append(&mut self, append: bool) -> &mut Self {
        self.append = append;
        self
    }

    /// Opens the file.
    ///
    /// # Errors
    /// If it is missing and not to be made, or cannot be made.
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
    /// Opens a file that is there.
    ///
    /// # Errors
    /// If it is missing.
    pub fn open(path: impl AsRef<Path>) -> io::Result<Self> {
        OpenOptions::new().open(path)
    }

    /// Makes an empty file.
    ///
    /// # Errors
    /// If its folder is missing, or it is a folder.
    pub fn create(path: impl AsRef<Path>) -> io::Result<Self> {
        OpenOptions::new().create(true).truncate(true).open(path)
    }

    /// How a file is opened.
    #[must_use]
    pub fn options() -> OpenOptions {
        OpenOptions::new()
    }

    /// Does nothing: what is written is in the file at once.
    ///
    /// # Errors
    /// None.
    pub fn sync_all(&self) -> io::Result<()> {
        Ok(())
    }

    /// Size and time of the file.
    ///
    /// # Errors
    /// If it was removed.
    pub fn metadata(&self) -> io::Result<Metadata> {
        metadata(&self.path)
    }

    /// Cuts the file off, or fills it up with zeros.
    ///
    /// # Errors
    /// If it was removed.
    pub fn set_len(&self, bytes: u64) -> io::Result<()> {
        self.change(|content| content.resize(bytes as usize, 0))
    }

    /// Locks the file until [`File::unlock`] or its end.
    ///
    /// # Errors
    /// If it is locked already.
    pub fn try_lock(&self) -> Result<(), TryLockError> {
        let mut locked = LOCKED.lock().unwrap_or_else(PoisonError::into_inner);
        if !locked.insert(self.path.clone()) {
            return Err(TryLockError::WouldBlock);
        }
        self.locks.set(true);
        Ok(())
    }

    /// Gives the lock up.
    ///
    /// # Errors
    /// None.
    pub fn unlock(&self) -> io::Result<()> {
        if self.locks.take() {
            LOCKED.lock().unwrap_or_else(PoisonError::into_inner).remove(&self.path);
        }
        Ok(())
    }

    /// Changes the content, which is copied only if another holds it too.
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
