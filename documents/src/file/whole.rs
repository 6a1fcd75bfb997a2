//! Reading a whole file or the standard input, and replacing a file atomically.

use std::ffi::OsStr;
use std::fmt;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::replace::{check, replace};
use crate::hint::Explain;

/// We could not read or write a file. Nothing on the disk has changed.
#[derive(Debug, Clone, Explain)]
#[hint(inner = reason)]
#[fault(Environment)]
pub struct FileError {
    /// Path of the file as you gave it.
    pub path: PathBuf,
    /// Whether reading or writing failed.
    pub action: FileAction,
    /// The error of the operating system. We share it, so that you can clone errors that hold this
    /// one.
    pub reason: Arc<io::Error>,
}

impl FileError {
    /// The error `reason` of reading `path`. Use this if you do not call [`read`].
    #[must_use]
    pub fn reading(path: &Path, reason: io::Error) -> Self {
        error(path, FileAction::Read, reason)
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: cannot be {}", self.path.display(), self.action.participle())
    }
}

impl std::error::Error for FileError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&*self.reason)
    }
}

impl PartialEq for FileError {
    /// Compares path, action and the kind of the system's error.
    fn eq(&self, other: &Self) -> bool {
        (&self.path, self.action, self.reason.kind())
            == (&other.path, other.action, other.reason.kind())
    }
}

/// The operation on a file that failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileAction {
    /// Reading the whole file.
    Read,
    /// Writing the whole file.
    Write,
}

impl FileAction {
    fn participle(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Write => "written",
        }
    }
}

/// Reads all bytes of a file. The path `-` is standard input. We read it to its end once and keep
/// the bytes, so that you get the same ones if you read it again. For a file called `-` write
/// `./-`.
pub fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    let bytes = match is_standard_input(path) {
        true => standard_input(),
        false => super::disk::read(path),
    };
    bytes.map_err(|reason| error(path, FileAction::Read, reason))
}

/// Replaces the file at `path` by `bytes`, or creates it. We write the bytes to a temporary file in
/// the same folder, flush it to the disk and rename it, so that `path` always holds either the old
/// content or the new one. If `path` is a symbolic link, this replaces its target. An existing file
/// keeps its permissions. This also removes temporary files that earlier runs left in the folder.
///
/// # Errors
/// [`FileError`] with the path, also if `path` is a folder or a device. In a browser
/// (wasm32-unknown-unknown) files lie in memory ([`super::disk`]).
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    replace(path, bytes).map_err(|reason| error(path, FileAction::Write, reason))
}

/// Checks that [`write_whole`] could write `path` now, and leaves nothing behind. Call this if you
/// want to fail before a long computation.
///
/// # Errors
/// [`FileError`] in the cases of [`write_whole`].
pub fn check_writable(path: &Path) -> Result<(), FileError> {
    check(path).map_err(|reason| error(path, FileAction::Write, reason))
}

/// Most bytes that one stored byte of a compressed picture can expand to: 1032 by ZIP, a third more by
/// PXR24, which stores three of four bytes, less by PIZ and run lengths.
pub const EXPANSION: u64 = 1400;

/// A header announces more than its file can hold, so the file is truncated or made to take the memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{file_bytes} bytes cannot hold the {announced} that its header announces")]
pub struct ExpansionError {
    /// Length of the file.
    pub file_bytes: u64,
    /// Bytes that the header announces, unpacked.
    pub announced: u64,
}

/// Checks that a compressed file of `file_bytes` can hold the bytes that its header announces. Call this
/// before you allocate memory for them.
///
/// # Errors
/// [`ExpansionError`] if one stored byte would have to expand to more than [`EXPANSION`].
pub fn check_expansion(announced: u64, file_bytes: u64) -> Result<(), ExpansionError> {
    match announced <= EXPANSION.saturating_mul(file_bytes) {
        true => Ok(()),
        false => Err(ExpansionError { file_bytes, announced }),
    }
}

/// Whether the system gives `bytes` of memory now, all at once. Call this before work that needs them, so that a limit
/// such as `prlimit --as` ends it with words rather than in the allocator.
#[must_use]
pub fn has_memory(bytes: u64) -> bool {
    let bytes = usize::try_from(bytes).unwrap_or(usize::MAX);
    Vec::<u8>::new().try_reserve_exact(bytes).is_ok()
}

fn error(path: &Path, action: FileAction, reason: io::Error) -> FileError {
    FileError { path: path.to_owned(), action, reason: Arc::new(reason) }
}

/// The path that stands for standard input.
pub const STANDARD_INPUT: &str = "-";

/// Whether `path` stands for standard input: `-`.
#[must_use]
pub fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == OsStr::new(STANDARD_INPUT)
}

/// Whether you can read `path`: it is an existing file or standard input.
#[must_use]
pub fn is_there(path: &Path) -> bool {
    is_standard_input(path) || super::disk::is_file(path)
}

/// Whether a text looks like the path of a file, `FILE` or `FILE#NAME`: it has a folder, an ending of letters or a
/// name behind it. If there is no such file, say that it cannot be read.
///
/// ```
/// use documents::file::looks_like_path;
///
/// assert!(looks_like_path("book.ase") && looks_like_path("scans/book") && looks_like_path("book#Sky"));
/// assert!(!looks_like_path("teal") && !looks_like_path("52,-10.5,8") && !looks_like_path("#4a7d8c"));
/// ```
#[must_use]
pub fn looks_like_path(text: &str) -> bool {
    let (file, name) =
        text.rsplit_once('#').map_or((text, None), |(file, name)| (file, Some(name)));
    let ending = Path::new(file).extension().and_then(OsStr::to_str);
    let has_ending = ending.is_some_and(|ending| ending.starts_with(char::is_alphabetic));
    !file.is_empty() && (name.is_some() || has_ending || file.contains(['/', '\\']))
}

/// All bytes of standard input, read once.
pub(super) fn standard_input() -> io::Result<Vec<u8>> {
    static BYTES: Mutex<Option<Vec<u8>>> = Mutex::new(None);
    let mut bytes = BYTES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(bytes) = &*bytes {
        return Ok(bytes.clone());
    }
    let mut read = Vec::new();
    io::stdin().lock().read_to_end(&mut read)?;
    *bytes = Some(read.clone());
    Ok(read)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn writing_replaces_the_file_and_leaves_no_temporary_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        check_writable(&path).unwrap();
        assert!(names(folder.path()).is_empty(), "the check leaves no file");
        write_whole(&path, b"one").unwrap();
        write_whole(&path, b"two").unwrap();
        assert_eq!(read(&path).unwrap(), b"two");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_write_error_names_the_file_and_leaves_no_temporary_file() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("missing").join("a.txt");
        let error = write_whole(&inside, b"one").unwrap_err();
        assert!(error.to_string().ends_with("a.txt: cannot be written"), "{error}");
        assert!(error.hint().is_some(), "the folder is missing");
        for error in [error, check_writable(&inside).unwrap_err()] {
            let reason = error.reason.to_string();
            assert!(!reason.is_empty() && !reason.contains(".impasto-"), "{reason}");
        }
        std::fs::create_dir(folder.path().join("b.exr")).unwrap();
        write_whole(&folder.path().join("b.exr"), b"one").unwrap_err();
        check_writable(&folder.path().join("b.exr")).unwrap_err();
        assert_eq!(names(folder.path()), ["b.exr"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_symbolic_link_is_kept_and_its_target_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.txt");
        let link = folder.path().join("link.txt");
        write_whole(&file, b"one").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_whole(&link, b"two").unwrap();
        assert_eq!(read(&file).unwrap(), b"two");
        assert!(link.is_symlink(), "the link itself was replaced");
    }
}
