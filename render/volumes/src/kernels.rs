//! The kernels of volumes, for the test that validates them.

use graphics::gpu::Kernel;

use crate::drawing::{FINISH, REGION, SHADE};

/// Every compute kernel of volumes.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&SHADE, &REGION, &FINISH]
}
