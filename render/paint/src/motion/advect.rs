//! Conservative advection: the column over a cell moves by its velocity and is
//! shared among the cells it then covers.
//!
//! Baxter, Wendt and Lin 2004, section 4.1. As the column moves by one cell at
//! most in x and in y, it covers four cells: where it was, beside, above or
//! below, and the corner between.

use super::Motion;
use crate::layer::Cell;

/// What leaves a cell, and where to; what stays is the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outflow {
    /// To the neighbour in x.
    pub beside: Cell,
    /// To the neighbour in y.
    pub along: Cell,
    /// To the neighbour in both.
    pub corner: Cell,
}

/// Of 65536 parts, those of a column of `volume` that may move: all but the
/// adhesion.
#[inline(always)]
#[must_use]
pub fn mobile_share(motion: &Motion, volume: u32) -> u32 {
    if volume <= motion.adhesion {
        return 0;
    }
    65536 - (motion.adhesion << 16).div_ceil(volume)
}

/// What leaves `cell` at `speed`, the absolute velocity in 1/256 cell, if
/// `mobile` of 65536 parts may move.
#[inline(always)]
#[must_use]
pub fn outflow(cell: &Cell, mobile: u32, speed: (u32, u32)) -> Outflow {
    let moving = cell.share(mobile);
    let sideways = moving.small_share(speed.0);
    let corner = sideways.small_share(speed.1);
    let along = moving.minus(&sideways).small_share(speed.1);
    Outflow { beside: sideways.minus(&corner), along, corner }
}
