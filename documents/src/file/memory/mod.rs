//! A file system in memory, with the calls of [`std::fs`] that impasto uses.
//!
//! A page has no disk. Its files lie here; the page itself copies those that should outlive it to
//! the browser's storage, for which [`take_changes`] tells it what has changed.

mod tree;
mod metadata;
mod open_file;
mod calls;

pub use calls::*;
pub use metadata::metadata;
pub use open_file::{File, OpenOptions};
pub use tree::Change;
pub(super) use tree::from_root;

#[cfg(test)]
mod tests;
