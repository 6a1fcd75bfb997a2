//! The device that tests run on.

use std::io::Write;

use render::gpu::{BackendChoice, Device, choose};

/// The device to test on, hardware before software; none where there is none,
/// which is said. Adds a line to the file of `IMPASTO_GPU_TESTS`.
///
/// # Panics
/// If that file cannot be written.
#[must_use]
pub fn device() -> Option<Device> {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
        let written = file.and_then(|mut file| file.write_all(format!("{name}\n").as_bytes()));
        assert!(written.is_ok(), "IMPASTO_GPU_TESTS: {written:?}");
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device
}
