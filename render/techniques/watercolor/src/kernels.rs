//! The kernels of watercolor, for the test that validates them.

use super::effects::{COLOR_MASK, DENSITY, DRY_BRUSH, EDGE_BLUR, EDGES, PAPER_SHADING, WOBBLE};
use super::toon::TOON;
use graphics::gpu::Kernel;

/// Every compute kernel of watercolor.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&TOON, &DENSITY, &EDGE_BLUR, &EDGES, &WOBBLE, &DRY_BRUSH, &COLOR_MASK, &PAPER_SHADING]
}
