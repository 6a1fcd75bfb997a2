//! The lock by which programs know whether a session still runs.

use documents::file::disk::File;
use std::path::Path;

const LOCK: &str = "lock";

/// Lock of a session, held while this value exists.
#[derive(Debug)]
pub(super) struct SessionLock(File);

impl SessionLock {
    /// Makes and locks the file of the session in `folder`.
    ///
    /// # Errors
    /// If the file cannot be made, or another program locked it.
    pub(super) fn create(folder: &Path) -> std::io::Result<Self> {
        Self::of(File::create(folder.join(LOCK))?)
    }

    /// Locks the file of the session in `folder`.
    ///
    /// # Errors
    /// If there is none, or the program of the session still runs.
    pub(super) fn open(folder: &Path) -> std::io::Result<Self> {
        Self::of(File::options().read(true).write(true).open(folder.join(LOCK))?)
    }

    fn of(file: File) -> std::io::Result<Self> {
        file.try_lock()?;
        Ok(Self(file))
    }
}

impl Drop for SessionLock {
    fn drop(&mut self) {
        // Closing the file would not do: a process that is being started by another thread holds
        // copies of all open files until it runs its own program, and the lock with them.
        let _ = self.0.unlock();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_of_the_open_file_does_not_keep_the_lock() {
        let folder = tempfile::tempdir().unwrap();
        let lock = SessionLock::create(folder.path()).unwrap();
        assert!(SessionLock::open(folder.path()).is_err(), "it is held");
        let copy = lock.0.try_clone().unwrap();
        drop(lock);
        assert!(SessionLock::open(folder.path()).is_ok(), "it was given up");
        drop(copy);
    }
}
