//! Conservative advection: the column over a cell moves by its velocity and is divided
//! among the cells that it then covers.
//!
//! Baxter, Wendt and Lin 2004, section 4.1. As the column moves by at most one cell along
//! x and y, it covers four cells: its own, the neighbours in x and in y, and the diagonal
//! neighbour.

use super::constants::MotionConstants;
use crate::layer::Cell;

/// Paint that leaves a cell, by destination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outflow {
    /// Paint that moves to the neighbour in x.
    pub in_x: Cell,
    /// Paint that moves to the neighbour in y.
    pub in_y: Cell,
    /// Paint that moves to the diagonal neighbour.
    pub diagonal: Cell,
}

/// Share of a column of `volume` quanta that may move, in parts of 65536: all but the
/// adhesion.
#[inline(always)]
#[must_use]
pub fn mobile_share(motion: &MotionConstants, volume: u32) -> u32 {
    if volume <= motion.adhesion_quanta {
        return 0;
    }
    65536 - (motion.adhesion_quanta << 16).div_ceil(volume)
}

/// Computes the paint that leaves `cell` in one sub-step. `mobile` is the share that may
/// move in parts of 65536, `speed` the absolute velocity along x and y in 1/16384 cell.
#[inline(always)]
#[must_use]
pub fn outflow(cell: &Cell, mobile: u32, speed: (u32, u32)) -> Outflow {
    let moving = cell.share_of_65536(mobile);
    let (x, y) = (4 * speed.0, 4 * speed.1);
    let sideways = moving.share_of_65536(x);
    let diagonal = sideways.share_of_65536(y);
    let in_y = moving.minus(&sideways).share_of_65536(y);
    Outflow { in_x: sideways.minus(&diagonal), in_y, diagonal }
}
