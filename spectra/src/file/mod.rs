//! Reading a whole file, and replacing a file atomically.

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
mod replace;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
mod unsupported;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
use unsupported as replace;

mod whole;

pub use replace::sync_folder;
pub use whole::{FileAction, FileError, check_writable, read, write_whole};
