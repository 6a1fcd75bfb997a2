//! Scans written by the tests are read as cubes, and maps are written and resumed.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod written;
mod envi;
mod specim;
mod pictures;
mod store;
