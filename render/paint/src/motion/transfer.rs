//! Transfer of paint between a cell of the canvas and the cell of the head above it.
//!
//! Baxter, Wendt and Lin 2004, algorithm 1: the side that has more paint gives a tenth of
//! it to the other; less where both have nearly the same or where the head is slow, and
//! never more than a fixed amount. Of the paint on the canvas, only the height that the
//! head has penetrated counts. Where several cells of the canvas lie under one cell of the
//! head, each may take an equal share of the head's paint.

use super::constants::MotionConstants;
use crate::amount::share_of_256;
use crate::contact::Touch;

/// The side that paint is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Paint is deposited on the canvas.
    Brush,
    /// Paint is picked up from the canvas.
    Canvas,
}

/// The transfer between one cell of the canvas and the head's cell above it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exchange {
    /// The side that paint is taken from.
    pub source: Source,
    /// Share of the source's whole cell that is transferred, in parts of 65536.
    pub share: u32,
}

/// Computes the transfer of one sub-step.
///
/// `penetration` is that at the start of the sub-step, in quanta, 0 and up; the volumes
/// are those of the two cells now, in quanta.
#[inline(always)]
#[must_use]
pub fn exchange(
    motion: &MotionConstants,
    touch: Touch,
    penetration: u32,
    canvas_volume: u32,
    brush_volume: u32,
) -> Exchange {
    let canvas = canvas_volume.min(penetration);
    let brush = brush_volume / touch.sharers().max(1);
    let (source, amount, whole) = if brush > canvas {
        (Source::Brush, brush, brush_volume)
    } else {
        (Source::Canvas, canvas, canvas_volume)
    };
    let difference = (brush.abs_diff(canvas) / (motion.full_transfer_quanta / 256)).min(256);
    let wanted = share_of_256(share_of_256(amount / 10, difference), touch.transfer_weight());
    let transferred = wanted.min(motion.max_transfer_quanta);
    Exchange { source, share: (transferred << 16).checked_div(whole).unwrap_or(0) }
}
