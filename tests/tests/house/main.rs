//! The rules of this house, read from its files.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod files;

mod crates;

mod modules;

mod sources;

mod words;
