//! Inputs of a sub-step that all threads share.

use super::head_paint::HeadPaint;
use super::penetration::PenetrationMap;
use crate::contact::Contact;
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
    /// The cells that may move: the contact's rectangle grown by one cell.
    #[inline(always)]
    pub(super) fn moving(&self) -> Rect {
        self.contact.rect.grown(1, self.bounds)
    }
}
