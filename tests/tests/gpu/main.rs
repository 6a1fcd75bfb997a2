//! Painting on a graphics device: its kernels are valid WGSL, hold their
//! structs where Rust does, and compute what the processor computes.
//!
//! Where there is no adapter the tests that need one pass and say so. If the
//! variable `IMPASTO_GPU_TESTS` names a file, each adds a line to it: the
//! adapter it ran on, or `none`.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod kernels;

mod reference;

mod motion;

mod rest;

mod light;

mod device;

mod program;

use suite::adapter::device;
