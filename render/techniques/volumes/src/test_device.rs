//! A graphics device for tests, and how far its pictures may be from the processor's.

use std::io::Write;

use graphics::compute::Compute;
use graphics::field::Field;
use graphics::gpu::{BackendChoice, choose};

/// A device, hardware before software. `None` without an adapter, with a note on standard error.
/// Appends the name of the adapter (or `none`) to the file that the environment variable
/// `IMPASTO_GPU_TESTS` names, if it is set.
pub(crate) fn device() -> Option<Compute> {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let mut list = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        writeln!(list, "{name}").unwrap();
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device.map(Compute::gpu)
}

/// Greatest difference of two pictures, and the share of pixels that differ by more than 1/255.
pub(crate) fn far(one: &Field<[f32; 4]>, other: &Field<[f32; 4]>) -> (f32, f32) {
    assert_eq!((one.width(), one.height()), (other.width(), other.height()));
    let mut most = 0.0_f32;
    let mut over = 0;
    for (a, b) in one.values().iter().zip(other.values()) {
        let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(off.is_finite(), "{a:?} {b:?}");
        most = most.max(off);
        over += usize::from(off > 1.0 / 255.0);
    }
    (most, over as f32 / one.values().len().max(1) as f32)
}
