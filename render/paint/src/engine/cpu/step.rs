//! Inputs of a sub-step that all threads share.

use super::head_paint::HeadPaint;
use super::penetration::PenetrationMap;
use crate::contact::{Contact, Touch};
use crate::motion::MotionConstants;
use graphics::tile::Rect;

#[derive(Debug, Clone, Copy)]
pub(super) struct SubStep<'a> {
    pub(super) motion: &'a MotionConstants,
    pub(super) contact: &'a Contact,
    pub(super) bounds: Rect,
    /// The contact's rectangle grown by two cells.
    pub(super) reach: Rect,
    pub(super) penetration: &'a PenetrationMap,
    /// Paint on the head at the start of the sub-step.
    pub(super) head: &'a HeadPaint,
}

impl SubStep<'_> {
    /// Touches of the cells in contact of row `y`, and of those between them.
    #[inline(always)]
    pub(super) fn touches(&self, y: usize) -> &[Touch] {
        let rect = self.contact.rect;
        let columns = self.penetration.in_contact(y);
        let first = (y - rect.y) * rect.width + columns.start - rect.x;
        &self.contact.touches[first..][..columns.len()]
    }
}
