//! Standard input as a file to read.

use std::ffi::OsStr;
use std::io::{self, Read};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// The path that stands for standard input.
pub const STANDARD_INPUT: &str = "-";

/// Whether `path` stands for standard input: `-`.
#[must_use]
pub fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == OsStr::new(STANDARD_INPUT)
}

/// Whether `path` can be read: a file that is there, or standard input.
#[must_use]
pub fn is_there(path: &Path) -> bool {
    is_standard_input(path) || super::disk::is_file(path)
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
