//! A graphics device for tests, and how far its pictures may be from the processor's.

use std::io::Write;

use graphics::compute::Compute;
use graphics::gpu::{BackendChoice, choose};

use super::passes::PaintedPicture;

/// Cover below which a pixel shows nothing in 8 bits, whatever its colour.
const INVISIBLE: f32 = 1.0 / 255.0;

/// A device, hardware before software. `None` without an adapter, with a note on standard error.
/// Appends the name of the adapter (or `none`) to the file that the environment variable
/// `IMPASTO_GPU_TESTS` names, if it is set.
pub(super) fn device() -> Option<Compute> {
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

/// Greatest differences of two pictures: of cover, of encoded colour where it can be seen, and of
/// height; then the number of pixels whose colour was compared.
pub(super) fn differences(one: &PaintedPicture, other: &PaintedPicture) -> ([f32; 3], usize) {
    let size = |picture: &PaintedPicture| (picture.color.width(), picture.color.height());
    assert_eq!(size(one), size(other));
    let mut most = [0.0_f32; 3];
    let mut compared = 0;
    for (a, b) in one.color.values().iter().zip(other.color.values()) {
        let off: Vec<f32> = a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect();
        assert!(off.iter().all(|off| off.is_finite()), "{a:?} {b:?}");
        most[0] = most[0].max(off[3]);
        if a[3].min(b[3]) >= INVISIBLE {
            most[1] = off[..3].iter().fold(most[1], |most, &off| most.max(off));
            compared += 1;
        }
    }
    let heights = one.height_mm.values().iter().zip(other.height_mm.values());
    most[2] = heights.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    (most, compared)
}
