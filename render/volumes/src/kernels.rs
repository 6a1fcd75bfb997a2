//! The kernels of volumes, for the test that validates them.

use graphics::gpu::Kernel;

use crate::drawing::{FINISH, REGION, SHADE};
use crate::motion::STEP;

/// Every compute kernel of volumes.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&STEP, &SHADE, &REGION, &FINISH]
}
