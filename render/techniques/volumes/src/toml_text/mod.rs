//! TOML of users: places of keys in a text, faults of values, errors with file and line.

mod key_path;
mod places;
mod fault;
mod error;
mod parsed;

pub use error::TextError;
pub use fault::Fault;
pub use key_path::{KeyPath, KeyStep};

pub(crate) use fault::Checked;
pub(crate) use parsed::{Source, read_text};
