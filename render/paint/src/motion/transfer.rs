//! Paint changing sides between a cell of the canvas and the cell of the head
//! above it.
//!
//! Baxter, Wendt and Lin 2004, algorithm 1: from the side that has more, a
//! tenth of what it has, less where both have nearly the same and where the
//! head is slow, and never more than a fixed amount. Of the canvas only the part
//! that the head has entered counts. Where several cells of the canvas lie under
//! one of the head, each may draw on its share.

use super::Motion;
use crate::amount::share_of_256;
use crate::contact::Touch;
use crate::layer::Cell;

/// Which side gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Giver {
    /// Paint is laid down.
    Brush,
    /// Paint is picked up.
    Canvas,
}

/// Who gives, and of the giver's whole cell how many of 65536 parts.
///
/// `penetration` is that at the start of the sub-step, 0 and up; the volumes are
/// those of the cells now.
#[inline(always)]
#[must_use]
pub fn exchange(
    motion: &Motion,
    touch: Touch,
    penetration: u32,
    canvas_volume: u32,
    brush_volume: u32,
) -> (Giver, u32) {
    let canvas = canvas_volume.min(penetration);
    let brush = brush_volume / touch.sharers().max(1);
    let (giver, amount, whole) = if brush > canvas {
        (Giver::Brush, brush, brush_volume)
    } else {
        (Giver::Canvas, canvas, canvas_volume)
    };
    let unlike = (brush.abs_diff(canvas) / (motion.cutoff / 256)).min(256);
    let wanted = share_of_256(share_of_256(amount / 10, unlike), touch.speed());
    let given = wanted.min(motion.most);
    (giver, (given << 16).checked_div(whole).unwrap_or(0))
}

/// What `giver` hands over: `share` of 65536 parts of everything.
#[inline(always)]
#[must_use]
pub fn handed_over(giver: &Cell, share: u32) -> Cell {
    giver.share(share)
}
