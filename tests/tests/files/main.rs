//! Painting files and exported pictures, read back with the library and with independent readers.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod earlier;
mod export;
mod painting;
