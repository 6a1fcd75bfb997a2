//! Writing a file piece by piece. Use this if the file is too large for the memory.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::replace::{Replacement, unnamed};
use super::whole::{FileAction, FileError};

/// A file that you write piece by piece. Until you call [`FileInPieces::finish`], the path holds
/// what it held before. If you drop this value instead, nothing remains of it.
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
    /// Begins a file that replaces `path` when you finish it.
    ///
    /// # Errors
    /// [`FileError`] with the path, in the cases of [`super::write_whole`].
    pub fn create(path: &Path) -> Result<Self, FileError> {
        let replacement = Replacement::begin(path).map_err(|reason| fault(path, reason))?;
        Ok(Self { path: path.to_owned(), replacement })
    }

    /// Adds `bytes` at the end.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), FileError> {
        self.replacement.write(bytes).map_err(|reason| fault(&self.path, reason))
    }

    /// Flushes the file to the disk and gives it its name.
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
