//! The graphics device of the GPU tests.

use std::io::Write;

use graphics::gpu::{BackendChoice, Device, choose};

/// Opens the graphics device for a test, a hardware adapter before a software one. `None` without
/// an adapter, with a note on standard error. Appends the name of the adapter (or `none`) to the
/// file that the environment variable `IMPASTO_GPU_TESTS` names, if it is set.
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
