//! All kernels of watercolor, in one list.

use super::morphology::CROSSING;
use crate::gpu::Kernel;

/// Every kernel that watercolor on a device runs.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&CROSSING]
}
