//! Reading parts of a file by position, from several threads.

use std::fs::File;
use std::path::{Path, PathBuf};

use super::error::CubeError;

/// A file that is read by position.
#[derive(Debug)]
pub(crate) struct PositionalFile {
    path: PathBuf,
    bytes: u64,
    #[cfg(unix)]
    file: File,
    #[cfg(not(unix))]
    file: std::sync::Mutex<File>,
}

impl PositionalFile {
    /// Opens the regular file at `path`.
    pub(crate) fn open(path: &Path) -> Result<Self, CubeError> {
        let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
        Self::of(file, path)
    }

    /// Takes an open file, which messages call `path`.
    pub(crate) fn of(file: File, path: &Path) -> Result<Self, CubeError> {
        let about = file.metadata().map_err(|reason| CubeError::reading(path, reason))?;
        if !about.is_file() {
            let way_out = "name a file on a disk: a cube is read in any order";
            return Err(CubeError::format(path, "not a regular file", way_out));
        }
        #[cfg(not(unix))]
        let file = std::sync::Mutex::new(file);
        Ok(Self { path: path.to_owned(), bytes: about.len(), file })
    }

    /// Bytes of the file when it was opened.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Fills `buffer` from the byte `position` on.
    pub(crate) fn read_at(&self, buffer: &mut [u8], position: u64) -> Result<(), CubeError> {
        self.fill(buffer, position).map_err(|reason| match reason.kind() {
            std::io::ErrorKind::UnexpectedEof => CubeError::data(
                &self.path,
                format!("ends before byte {}", position.saturating_add(buffer.len() as u64)),
                "the file became shorter while it was read: copy it again",
            ),
            _ => CubeError::reading(&self.path, reason),
        })
    }

    #[cfg(unix)]
    fn fill(&self, buffer: &mut [u8], position: u64) -> std::io::Result<()> {
        std::os::unix::fs::FileExt::read_exact_at(&self.file, buffer, position)
    }

    #[cfg(not(unix))]
    fn fill(&self, buffer: &mut [u8], position: u64) -> std::io::Result<()> {
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
