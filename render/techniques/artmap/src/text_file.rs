//! Files of text.

use std::io::{Error, ErrorKind};
use std::path::Path;

use documents::file::{FileAction, FileError, read};

/// Reads a file of UTF-8 text.
///
/// # Errors
/// [`FileError`] if the file cannot be read or holds other bytes.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    String::from_utf8(read(path)?).map_err(|_| FileError {
        path: path.to_owned(),
        action: FileAction::Read,
        reason: Error::from(ErrorKind::InvalidData).into(),
    })
}
