//! Painting on the GPU: kernels are valid WGSL, their structs have the layout of the Rust structs,
//! and their results match the CPU.
//!
//! Without a graphics adapter the tests that need one pass, with a note on stderr. If the
//! environment variable `IMPASTO_GPU_TESTS` names a file, each of them appends a line to it: the
//! name of its adapter, or
//! `none`.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod kernels;
mod motion;
mod light;

use suite::program::device;
