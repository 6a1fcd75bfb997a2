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

use std::io::Write;

use render::gpu::{BackendChoice, Device, choose};

/// The device to test on, hardware before software; none where there is none.
fn device() -> Option<Device> {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let mut file = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        file.write_all(format!("{name}\n").as_bytes()).unwrap();
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device
}
