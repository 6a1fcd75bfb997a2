//! States as files: bytes that hold every number to the bit, with a name, a version, whose state it
//! is, and a checksum.

mod error;
mod bytes;
mod sealed;

pub use error::SavedError;

pub(crate) use bytes::{Reader, Stored, stored};
pub(crate) use sealed::{Kind, identity, opened, sealed};
