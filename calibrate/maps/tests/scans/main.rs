//! Scans written by the tests are read as cubes, and maps are written and resumed.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod written;
mod envi;
mod envi_faults;
mod listed;
mod headers;
mod specim;
mod pictures;
mod zarr;
mod store;
mod blocks;
mod stored;
