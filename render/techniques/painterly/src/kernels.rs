//! The kernels of models in brushwork, for the test that validates them.

use super::passes_on_device::PASSES;
use graphics::gpu::Kernel;

/// Every compute kernel of models in brushwork.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&PASSES]
}
