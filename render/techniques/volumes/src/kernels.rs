//! The kernels of volumes. A test validates them.

use graphics::gpu::Kernel;

use crate::drawing::{FINISH, REGION, SHADE};
use crate::motion::STEP;
use crate::wetting::SPILL;

/// Every compute kernel of volumes.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    [&SPILL[..], &[&STEP, &SHADE, &REGION, &FINISH]].concat()
}
