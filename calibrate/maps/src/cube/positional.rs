//! Reading parts of a file by position, from several threads.

use std::fmt::Debug;
#[cfg(feature = "files")]
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::CubeError;

/// Bytes that are read by position: a file on a disk, or slices of one that a browser holds.
pub trait ReadAt: Debug + Send + Sync {
    /// Number of bytes.
    fn bytes(&self) -> u64;

    /// Fills `buffer` from the byte `position` on.
    ///
    /// # Errors
    /// [`io::ErrorKind::UnexpectedEof`] if the bytes end before, or any other error of reading.
    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()>;
}

/// A file that is read by position.
#[derive(Debug, Clone)]
pub(crate) struct PositionalFile {
    path: PathBuf,
    source: Arc<dyn ReadAt>,
}

impl PositionalFile {
    /// Opens the regular file at `path`.
    #[cfg(feature = "files")]
    pub(crate) fn open(path: &Path) -> Result<Self, CubeError> {
        let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
        Self::of(file, path)
    }

    /// Takes an open file, which messages call `path`.
    #[cfg(feature = "files")]
    pub(crate) fn of(file: File, path: &Path) -> Result<Self, CubeError> {
        let about = file.metadata().map_err(|reason| CubeError::reading(path, reason))?;
        if !about.is_file() {
            let way_out = "name a file on a disk: a cube is read in any order";
            return Err(CubeError::format(path, "not a regular file", way_out));
        }
        #[cfg(not(unix))]
        let file = std::sync::Mutex::new(file);
        Ok(Self::with(Arc::new(DiskFile { bytes: about.len(), file }), path))
    }

    /// Takes bytes that lie anywhere, which messages call `path`.
    pub(crate) fn with(source: Arc<dyn ReadAt>, path: &Path) -> Self {
        Self { path: path.to_owned(), source }
    }

    /// Bytes of the file when it was opened.
    #[cfg(feature = "files")]
    pub(crate) fn bytes(&self) -> u64 {
        self.source.bytes()
    }

    /// Fills `buffer` from the byte `position` on.
    pub(crate) fn read_at(&self, buffer: &mut [u8], position: u64) -> Result<(), CubeError> {
        self.source.read_exact_at(buffer, position).map_err(|reason| match reason.kind() {
            io::ErrorKind::UnexpectedEof => CubeError::data(
                &self.path,
                format!("ends before byte {}", position.saturating_add(buffer.len() as u64)),
                "the file became shorter while it was read: copy it again",
            ),
            _ => CubeError::reading(&self.path, reason),
        })
    }
}

/// A regular file on a disk.
#[cfg(feature = "files")]
#[derive(Debug)]
struct DiskFile {
    /// Bytes when it was opened.
    bytes: u64,
    #[cfg(unix)]
    file: File,
    #[cfg(not(unix))]
    file: std::sync::Mutex<File>,
}

#[cfg(feature = "files")]
impl ReadAt for DiskFile {
    fn bytes(&self) -> u64 {
        self.bytes
    }

    #[cfg(unix)]
    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()> {
        std::os::unix::fs::FileExt::read_exact_at(&self.file, buffer, position)
    }

    #[cfg(not(unix))]
    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()> {
        use std::io::{Read, Seek, SeekFrom};
        let mut file = self.file.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        file.seek(SeekFrom::Start(position))?;
        file.read_exact(buffer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_read_by_position_and_the_end_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cube.raw");
        std::fs::write(&path, [0, 1, 2, 3, 4]).unwrap();
        let file = PositionalFile::open(&path).unwrap();
        let mut part = [0; 2];
        file.read_at(&mut part, 3).unwrap();
        assert_eq!((part, file.bytes()), ([3, 4], 5));
        let error = file.read_at(&mut part, 4).unwrap_err().to_string();
        assert!(error.ends_with("cube.raw: ends before byte 6"), "{error}");
        let error = PositionalFile::open(folder.path()).unwrap_err().to_string();
        assert!(error.ends_with("not a regular file"), "{error}");
    }
}
