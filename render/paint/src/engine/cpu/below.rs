//! The surface below the wet paint during a stroke.

use super::bed::Bed;
use crate::mask::Mask;
use graphics::field::Field;

/// Floor, bed and mask of a canvas.
#[derive(Debug, Clone, Copy)]
pub(super) struct Below<'a> {
    /// Height of ground and dry paint in quanta.
    pub(super) floor: &'a Field<i32>,
    /// Surface before the stroke.
    pub(super) bed: &'a Bed,
    /// Covered cells; `None` if all are open.
    pub(super) mask: Option<&'a Mask>,
}
