//! A layer of paint: for every cell, how much of each of eight pigments, and of
//! vehicle.

use crate::amount::{share_of_256, share_of_65536};
use graphics::field::Field;
use graphics::tile::Rect;

/// How many pigments a layer can hold.
pub const SLOTS: usize = 8;

/// What one cell holds, in quanta: the paint of each of the layer's pigments,
/// and transparent vehicle (oil, medium). Their sum is the cell's volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cell {
    /// Of each pigment's paint, by slot.
    pub pigments: [u32; SLOTS],
    /// Of vehicle.
    pub vehicle: u32,
}

impl Cell {
    /// The height of the column, in quanta.
    #[inline(always)]
    #[must_use]
    pub fn volume(&self) -> u32 {
        let mut volume = self.vehicle;
        for amount in self.pigments {
            volume += amount;
        }
        volume
    }

    /// `share` of 65536 parts of everything, rounded down.
    #[inline(always)]
    #[must_use]
    pub fn share(&self, share: u32) -> Self {
        self.with(
            self,
            #[inline(always)]
            |amount, _| share_of_65536(amount, share),
        )
    }

    /// `share` of 256 parts of everything, rounded down.
    #[inline(always)]
    #[must_use]
    pub fn small_share(&self, share: u32) -> Self {
        self.with(
            self,
            #[inline(always)]
            |amount, _| share_of_256(amount, share),
        )
    }

    /// This and `other` together.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        self.with(
            other,
            #[inline(always)]
            |amount, other| amount + other,
        )
    }

    /// This without `part`, which it holds.
    #[inline(always)]
    #[must_use]
    pub fn minus(&self, part: &Self) -> Self {
        self.with(
            part,
            #[inline(always)]
            |amount, part| amount - part,
        )
    }

    /// This and `other` together, modulo 2^32: for sums that owe in between.
    #[inline(always)]
    #[must_use]
    pub fn wrapping_plus(&self, other: &Self) -> Self {
        self.with(
            other,
            #[inline(always)]
            |amount, other| amount.wrapping_add(other),
        )
    }

    /// This without `part`, modulo 2^32.
    #[inline(always)]
    #[must_use]
    pub fn wrapping_minus(&self, part: &Self) -> Self {
        self.with(
            part,
            #[inline(always)]
            |amount, part| amount.wrapping_sub(part),
        )
    }

    /// `act` on each amount and that of `other`. A loop, as the closures of
    /// `map` and `from_fn` are not always inlined, and then are not compiled for
    /// the instructions that the caller chose.
    #[inline(always)]
    fn with(&self, other: &Self, act: impl Fn(u32, u32) -> u32) -> Self {
        let mut result = *self;
        let mut i = 0;
        while i < SLOTS {
            result.pigments[i] = act(self.pigments[i], other.pigments[i]);
            i += 1;
        }
        result.vehicle = act(self.vehicle, other.vehicle);
        result
    }
}

/// Paint over a rectangle of cells: wet or dry on the canvas, or on the head of
/// a brush. 36 bytes a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Of each pigment's paint, in quanta, by slot.
    pub pigments: Field<[u32; SLOTS]>,
    /// Of vehicle, in quanta.
    pub vehicle: Field<u32>,
}

impl Layer {
    /// No paint.
    #[must_use]
    pub fn empty(width: usize, height: usize) -> Self {
        Self {
            pigments: Field::filled(width, height, [0; SLOTS]),
            vehicle: Field::filled(width, height, 0),
        }
    }

    /// Cells in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.vehicle.width()
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.vehicle.height()
    }

    /// The cell of this `index`, counted row by row.
    #[inline(always)]
    #[must_use]
    pub fn cell(&self, index: usize) -> Cell {
        Cell { pigments: self.pigments.values()[index], vehicle: self.vehicle.values()[index] }
    }

    /// Puts `cell` at this `index`.
    #[inline(always)]
    pub fn set_cell(&mut self, index: usize, cell: Cell) {
        self.pigments.values_mut()[index] = cell.pigments;
        self.vehicle.values_mut()[index] = cell.vehicle;
    }

    /// The paint in `rect`.
    ///
    /// # Panics
    /// If it has cells that the layer has not.
    #[must_use]
    pub fn part(&self, rect: Rect) -> Self {
        Self { pigments: self.pigments.part(rect), vehicle: self.vehicle.part(rect) }
    }

    /// Puts `part` in the place of what begins at column `x` of row `y`.
    ///
    /// # Panics
    /// If it reaches beyond the layer.
    pub fn put(&mut self, (x, y): (usize, usize), part: &Self) {
        self.pigments.put((x, y), &part.pigments);
        self.vehicle.put((x, y), &part.vehicle);
    }

    /// The sum of each pigment over all cells, and of vehicle last.
    #[must_use]
    pub fn totals(&self) -> [u64; SLOTS + 1] {
        let mut totals = [0; SLOTS + 1];
        for pigments in self.pigments.values() {
            for (total, &amount) in totals.iter_mut().zip(pigments) {
                *total += u64::from(amount);
            }
        }
        totals[SLOTS] = self.vehicle.values().iter().map(|&amount| u64::from(amount)).sum();
        totals
    }
}
