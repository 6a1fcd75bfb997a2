//! The operations of `replace` on targets without a file system.

use std::io;
use std::path::Path;

/// Does nothing: there are no folders.
pub fn sync_folder(_: &Path) {}

/// Does nothing: there are no writes.
pub fn abandon_writes() {}

pub(super) fn check(_: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

pub(super) fn replace(_: &Path, _: &[u8]) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
