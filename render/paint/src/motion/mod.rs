//! What one sub-step does to one cell, in whole numbers: the specification that
//! both backends follow.
//!
//! Baxter, Wendt and Lin 2004, section 4. Lengths are in cells (heights in
//! quanta), times in sub-steps, in which the head moves by one cell at most.
//!
//! # A sub-step
//! On the contact's rectangle grown by two cells, within the canvas:
//!
//! 1. [`press::penetration`] of each touched cell, from the floor and the wet
//!    volume at the start; [`press::APART`] everywhere else.
//! 2. [`press::velocity`] of each cell of the rectangle grown by one, with the
//!    central differences of penetration, where apart and cells beyond the
//!    rectangle count as 0. A component that would carry paint off the canvas
//!    counts as 0; near crowded columns, [`press::yielding`].
//! 3. [`advect::outflow`] of each of these cells, of the amounts at the start,
//!    for all cells at once.
//! 4. [`transfer::exchange`] for every touched cell whose penetration in step 1
//!    was not apart, with that penetration: between the cell of the canvas as
//!    step 3 left it and the cell of the head as it was at the start, for all
//!    cells at once. What several cells exchange with one cell of the head adds
//!    up there; as none takes more than a tenth of its share, the head's cell
//!    never owes.
//!
//! A column receives from eight neighbours at most, none of them crowded, so that
//! advection leaves every column below [`crate::amount::FULL`].

pub mod press;

pub mod advect;

pub mod transfer;

use crate::amount::QUANTA_PER_CELL;

/// The constants of motion, as whole numbers.
///
/// The paper's lengths have no unit. One of its units of height is taken as ten
/// cells (1 mm at 0.1 mm), so that a sub-step may leave a hundredth of a cell.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Motion {
    /// Quanta of difference in penetration, over two cells, that push paint by
    /// 1/256 cell: the paper's c is `QUANTA_PER_CELL / 128 / push`.
    pub push: i32,
    /// The height, in quanta, that always stays behind; below 65536.
    pub adhesion: u32,
    /// The most that changes sides, in quanta; below 65536.
    pub most: u32,
    /// The difference in amounts, in quanta, from which the full share changes
    /// sides; 256 and up.
    pub cutoff: u32,
}

impl Default for Motion {
    /// The paper's: at most 0.001, cutoff 1/30. Ours: c = 1/4, adhesion 1/500 of
    /// a cell.
    fn default() -> Self {
        Self {
            push: (QUANTA_PER_CELL / 32) as i32,
            adhesion: QUANTA_PER_CELL / 500,
            most: QUANTA_PER_CELL / 100,
            cutoff: QUANTA_PER_CELL / 3,
        }
    }
}
