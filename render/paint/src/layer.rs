//! A layer of paint: the amounts of eight pigments and of vehicle in every cell.

use crate::amount::{share_of_256, share_of_65536};
use crate::pigment_amounts;
use graphics::field::Field;
use graphics::tile::Rect;
use pigment::PigmentId;

/// Number of pigments that a layer can hold, each in a slot of its own.
pub const SLOTS: usize = pigment_amounts::COUNT;

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
        self.vehicle + pigment_amounts::total(&self.pigments)
    }

    /// Computes `amount * share / 65536` of each amount, rounded down.
    #[inline(always)]
    #[must_use]
    pub fn share_of_65536(&self, share: u32) -> Self {
        let vehicle = share_of_65536(self.vehicle, share);
        Self { pigments: pigment_amounts::share(&self.pigments, share), vehicle }
    }

    /// Computes `amount * share / 256` of each amount, rounded down.
    #[inline(always)]
    #[must_use]
    pub fn share_of_256(&self, share: u32) -> Self {
        let pigments = self.pigments.map(|amount| share_of_256(amount, share));
        Self { pigments, vehicle: share_of_256(self.vehicle, share) }
    }

    /// Adds `other`, amount by amount.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let pigments = pigment_amounts::sum(&self.pigments, &other.pigments);
        Self { pigments, vehicle: self.vehicle + other.vehicle }
    }

    /// Subtracts `part`, none of whose amounts exceeds this cell's.
    #[inline(always)]
    #[must_use]
    pub fn minus(&self, part: &Self) -> Self {
        let pigments = pigment_amounts::difference(&self.pigments, &part.pigments);
        Self { pigments, vehicle: self.vehicle - part.vehicle }
    }

    /// Adds `other` modulo 2^32, for sums whose intermediate results may be negative.
    #[inline(always)]
    #[must_use]
    pub fn wrapping_plus(&self, other: &Self) -> Self {
        let pigments = pigment_amounts::wrapping_sum(&self.pigments, &other.pigments);
        Self { pigments, vehicle: self.vehicle.wrapping_add(other.vehicle) }
    }

    /// Subtracts `part` modulo 2^32.
    #[inline(always)]
    #[must_use]
    pub fn wrapping_minus(&self, part: &Self) -> Self {
        let pigments = pigment_amounts::wrapping_difference(&self.pigments, &part.pigments);
        Self { pigments, vehicle: self.vehicle.wrapping_sub(part.vehicle) }
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
