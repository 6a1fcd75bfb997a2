//! A layer of paint: the amounts of eight pigments and of vehicle in every cell.

use crate::amount::{share_of_256, share_of_65536};
use graphics::field::Field;
use graphics::tile::Rect;
use pigment::PigmentId;

/// Number of pigments that a layer can hold, each in a slot of its own.
pub const SLOTS: usize = 8;

/// The pigments of a layer by slot.
pub type Slots = [Option<PigmentId>; SLOTS];

/// The paint in one cell, in quanta: the paint of each pigment and transparent vehicle
/// (oil, medium). Their sum is the cell's volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cell {
    /// Amount of each pigment's paint in quanta, by slot.
    pub pigments: [u32; SLOTS],
    /// Amount of vehicle in quanta.
    pub vehicle: u32,
}

impl Cell {
    /// Sum of all amounts, which is the height of the column in quanta.
    #[inline(always)]
    #[must_use]
    pub fn volume(&self) -> u32 {
        let mut volume = self.vehicle;
        for amount in self.pigments {
            volume += amount;
        }
        volume
    }

    /// Computes `amount * share / 65536` of each amount, rounded down.
    #[inline(always)]
    #[must_use]
    pub fn share_of_65536(&self, share: u32) -> Self {
        self.with(
            self,
            #[inline(always)]
            |amount, _| share_of_65536(amount, share),
        )
    }

    /// Computes `amount * share / 256` of each amount, rounded down.
    #[inline(always)]
    #[must_use]
    pub fn share_of_256(&self, share: u32) -> Self {
        self.with(
            self,
            #[inline(always)]
            |amount, _| share_of_256(amount, share),
        )
    }

    /// Adds `other`, amount by amount.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        self.with(
            other,
            #[inline(always)]
            |amount, other| amount + other,
        )
    }

    /// Subtracts `part`, none of whose amounts exceeds this cell's.
    #[inline(always)]
    #[must_use]
    pub fn minus(&self, part: &Self) -> Self {
        self.with(
            part,
            #[inline(always)]
            |amount, part| amount - part,
        )
    }

    /// Adds `other` modulo 2^32, for sums whose intermediate results may be negative.
    #[inline(always)]
    #[must_use]
    pub fn wrapping_plus(&self, other: &Self) -> Self {
        self.with(
            other,
            #[inline(always)]
            |amount, other| amount.wrapping_add(other),
        )
    }

    /// Subtracts `part` modulo 2^32.
    #[inline(always)]
    #[must_use]
    pub fn wrapping_minus(&self, part: &Self) -> Self {
        self.with(
            part,
            #[inline(always)]
            |amount, part| amount.wrapping_sub(part),
        )
    }

    /// Applies `act` to each pair of amounts. Written as a loop, since the closures of
    /// `map` and `from_fn` are not always inlined and then are not compiled for the
    /// instruction set that the caller chose.
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

/// Paint over a rectangle of cells: wet or dry on the canvas, or on the head of a brush.
/// 36 bytes a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Amount of each pigment's paint in quanta, by slot.
    pub pigments: Field<[u32; SLOTS]>,
    /// Amount of vehicle in quanta.
    pub vehicle: Field<u32>,
}

impl Layer {
    /// A layer of `width` x `height` cells without paint.
    #[must_use]
    pub fn empty(width: usize, height: usize) -> Self {
        Self {
            pigments: Field::filled(width, height, [0; SLOTS]),
            vehicle: Field::filled(width, height, 0),
        }
    }

    /// Width in cells.
    #[must_use]
    pub fn width(&self) -> usize {
        self.vehicle.width()
    }

    /// Height in cells.
    #[must_use]
    pub fn height(&self) -> usize {
        self.vehicle.height()
    }

    /// The paint in the cell with this index, counted row by row.
    #[inline(always)]
    #[must_use]
    pub fn cell(&self, index: usize) -> Cell {
        Cell { pigments: self.pigments.values()[index], vehicle: self.vehicle.values()[index] }
    }

    /// Replaces the paint in the cell with this index, counted row by row.
    #[inline(always)]
    pub fn set_cell(&mut self, index: usize, cell: Cell) {
        self.pigments.values_mut()[index] = cell.pigments;
        self.vehicle.values_mut()[index] = cell.vehicle;
    }

    /// Copies the paint in `rect`.
    ///
    /// # Panics
    /// If `rect` reaches beyond the layer.
    #[must_use]
    pub fn part(&self, rect: Rect) -> Self {
        Self { pigments: self.pigments.part(rect), vehicle: self.vehicle.part(rect) }
    }

    /// Replaces the cells under `part`, whose upper left cell goes to column `x` of
    /// row `y`.
    ///
    /// # Panics
    /// If `part` reaches beyond the layer.
    pub fn put(&mut self, (x, y): (usize, usize), part: &Self) {
        self.pigments.put((x, y), &part.pigments);
        self.vehicle.put((x, y), &part.vehicle);
    }

    /// Sums each pigment over all cells, in quanta; the last element is vehicle.
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
