//! The kernels of this crate, for the test that validates them.

use crate::coherence::{ANCHOR_TEXTURES, DEPTHS, GATHER_SPLATS};
use crate::gpu::Kernel;
use crate::morphology::EXTREMUM;
use crate::surface::ADD_STENCIL;

/// Every compute kernel of this crate.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&DEPTHS, &GATHER_SPLATS, &ANCHOR_TEXTURES, &EXTREMUM, &ADD_STENCIL]
}
