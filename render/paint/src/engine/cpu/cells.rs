//! Paint by cell, as threads gather it.

use crate::layer::{Cell, SLOTS};

/// Amounts in quanta by cell, modulo 2^32. Pigments and vehicle lie apart, as in a layer, so that
/// those of a cell take one vector and one number.
#[derive(Debug, Default)]
pub(super) struct Cells {
    pub(super) pigments: Vec<[u32; SLOTS]>,
    pub(super) vehicle: Vec<u32>,
}

impl Cells {
    /// Makes room for `count` cells; those added have no paint.
    pub(super) fn grow(&mut self, count: usize) {
        let count = count.max(self.vehicle.len());
        self.pigments.resize(count, [0; SLOTS]);
        self.vehicle.resize(count, 0);
    }

    /// Removes the paint of a cell; `None` if there is no such cell.
    #[inline(always)]
    pub(super) fn take(&mut self, at: usize) -> Option<Cell> {
        let pigments = self.pigments.get_mut(at)?;
        let vehicle = self.vehicle.get_mut(at)?;
        Some(Cell { pigments: std::mem::take(pigments), vehicle: std::mem::take(vehicle) })
    }
}
