//! The file system of the machine or, in a page, one in memory (`memory`).
//!
//! Both have the calls of [`std::fs`], so that your code runs in a page too.

use std::path::{Path, PathBuf};

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
pub use std::fs::{
    File, OpenOptions, copy, create_dir, create_dir_all, hard_link, metadata, read, read_dir,
    read_to_string, remove_dir, remove_dir_all, remove_file, rename, write,
};

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
pub use super::memory::{
    Change, File, OpenOptions, copy, create_dir, create_dir_all, hard_link, metadata, read,
    read_dir, read_to_string, remove_dir, remove_dir_all, remove_file, rename, take_changes, write,
};

/// Whether something lies at `path`.
#[must_use]
pub fn exists(path: &Path) -> bool {
    metadata(path).is_ok()
}

/// Whether a file lies at `path`.
#[must_use]
pub fn is_file(path: &Path) -> bool {
    metadata(path).is_ok_and(|found| found.is_file())
}

/// Whether a folder lies at `path`.
#[must_use]
pub fn is_dir(path: &Path) -> bool {
    metadata(path).is_ok_and(|found| found.is_dir())
}

/// `path` from the root on. This does not look at the disk.
///
/// # Errors
/// See [`std::path::absolute`]. In a page this never fails, because the root is its current folder.
pub fn absolute(path: &Path) -> std::io::Result<PathBuf> {
    #[cfg(all(target_family = "wasm", target_os = "unknown"))]
    return Ok(super::memory::from_root(path));
    #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
    std::path::absolute(path)
}

/// `path` from the root on, without links.
///
/// # Errors
/// If nothing lies there, see [`std::fs::canonicalize`].
pub fn canonicalize(path: &Path) -> std::io::Result<PathBuf> {
    #[cfg(all(target_family = "wasm", target_os = "unknown"))]
    return metadata(path).map(|_| super::memory::from_root(path));
    #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
    std::fs::canonicalize(path)
}

/// Number of this process. A page has none, so you get the time of its start in ms.
#[must_use]
pub fn process_number() -> u32 {
    #[cfg(all(target_family = "wasm", target_os = "unknown"))]
    return super::memory::start_number();
    #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
    std::process::id()
}
