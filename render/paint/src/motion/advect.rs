//! Conservative advection. The column over a cell moves by its velocity and we divide it among the
//! cells that it then covers.
//!
//! Baxter, Wendt and Lin 2004, section 4.1. As the column moves by at most one cell along
//! x and y, it covers four cells: its own, the neighbours in x and in y, and the diagonal
//! neighbour.

use super::MotionConstants;
use crate::amount::{ratio_of_65536, share_of_65536};

/// Shares of a column that leave it in one sub-step, by destination, in parts of 65536.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outflow {
    /// Share that moves to the neighbour in x.
    pub in_x: u32,
    /// Share that moves to the neighbour in y.
    pub in_y: u32,
    /// Share that moves to the diagonal neighbour.
    pub diagonal: u32,
}

/// Share of a column of `volume` quanta that may move, in parts of 65536: all but the
/// adhesion.
#[inline(always)]
#[must_use]
pub fn mobile_share(motion: &MotionConstants, volume: u32) -> u32 {
    let moving = volume.saturating_sub(motion.adhesion_quanta);
    ratio_of_65536(moving, volume)
}

/// Computes the shares of a column that leave it in one sub-step. `mobile` is the share that may
/// move in parts of 65536, `speed` the absolute velocity along x and y in 1/16384 cell.
#[inline(always)]
#[must_use]
pub fn outflow(mobile: u32, speed: (u32, u32)) -> Outflow {
    let x = 4 * speed.0;
    let y = 4 * speed.1;
    let sideways = share_of_65536(mobile, x);
    let diagonal = share_of_65536(sideways, y);
    let in_y = share_of_65536(mobile - sideways, y);
    Outflow { in_x: sideways - diagonal, in_y, diagonal }
}
