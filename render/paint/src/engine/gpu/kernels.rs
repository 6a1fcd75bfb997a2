//! The list of all kernels of the paint engine.

use super::{drying, render, sub_step, tops, undo_tiles};
use graphics::gpu::Kernel;

/// Every kernel that painting on a device runs, for tests that validate them.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![
        &sub_step::BEGIN,
        &sub_step::PRESS,
        &sub_step::ADVECT,
        &sub_step::TRANSFER,
        &sub_step::WICK,
        &sub_step::NOTE_BED,
        &drying::DRY,
        &drying::MOVE_FLOOR,
        &undo_tiles::UNDO_TILE,
        &render::PRIME,
        &render::BAKE,
        &tops::RAISE,
        &render::SHOW,
    ]
}
