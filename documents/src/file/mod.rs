//! Reading a whole file, and replacing a file atomically.

#[cfg(any(test, all(target_family = "wasm", target_os = "unknown")))]
#[cfg_attr(
    not(target_family = "wasm"),
    allow(dead_code, unreachable_pub, unused_imports, reason = "tests alone use a part of it")
)]
mod memory;
pub mod disk;

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
mod temporary;

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
mod replace;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
mod replace_in_memory;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
use replace_in_memory as replace;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
use replace_in_memory as temporary;

mod signals;
mod whole;
mod named;
mod output;

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
mod pieces;

pub use named::{NamedFileError, NamedFiles, Outside};
pub use output::{
    Output, OutputError, OutputFolder, create_folder, is_stream, refuse_same, split_file_and_sheet,
};
#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
pub use pieces::FileInPieces;
pub use replace::sync_folder;
pub use signals::end_cleanly_on_signals;
pub use temporary::abandon_writes;
pub use whole::{
    EXPANSION, ExpansionError, FileAction, FileError, STANDARD_INPUT, check_expansion,
    check_writable, has_memory, is_standard_input, is_there, looks_like_path, read, write_whole,
};
