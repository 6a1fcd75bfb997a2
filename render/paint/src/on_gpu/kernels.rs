//! All kernels of painting, in one list.

use super::{light, motion, rest};
use graphics::gpu::Kernel;

/// Every kernel that painting on a device runs.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![
        &motion::BEGIN,
        &motion::PRESS,
        &motion::ADVECT,
        &motion::TRANSFER,
        &rest::DRY,
        &rest::RAISE,
        &rest::KEEP,
        &light::PRIME,
        &light::BAKE,
        &light::SHOW,
    ]
}
