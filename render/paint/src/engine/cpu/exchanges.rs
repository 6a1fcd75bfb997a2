//! Transfers between one row of the canvas and the head above it: step 4 of the specification in
//! [`crate::motion`]. Its loop has no branches, so that it is compiled to vector instructions.

use super::step::SubStep;
use crate::motion::transfer::{Exchange, exchange, leaving};

/// Exchanges of one row after another. Holds its buffers, so that no sub-step allocates.
#[derive(Debug, Default)]
pub(super) struct Exchanges {
    /// One for each cell in contact of a row, and those between them.
    pub(super) found: Vec<Exchange>,
    brush_volumes: Vec<u32>,
    leaving: Vec<u32>,
}

impl Exchanges {
    /// Computes those of the cells in contact of row `y`, whose columns are `volumes` quanta high.
    #[inline(always)]
    pub(super) fn of_row(&mut self, step: &SubStep<'_>, volumes: &[u32], y: usize) {
        let columns = step.penetration.in_contact(y);
        let bounds = step.bounds;
        let touches = step.touches(y);
        let above = step.head.cells.volume();
        self.brush_volumes.resize(columns.len(), 0);
        for (volume, touch) in self.brush_volumes.iter_mut().zip(touches) {
            *volume = above.get(touch.brush_cell as usize).copied().unwrap_or_default();
        }
        self.leaving.clear();
        self.leaving.resize(columns.len(), 0);
        let at_side = columns.start == 0 || columns.end == bounds.width;
        if at_side || y == 0 || y + 1 == bounds.height {
            for (x, (out, &touch)) in columns.clone().zip(self.leaving.iter_mut().zip(touches)) {
                *out = leaving(touch, (x, y), bounds);
            }
        }
        self.found.resize(columns.len(), Exchange { down: 0, up: 0 });
        let penetrations = step.penetration.row(y, columns.start, columns.len());
        let coats = step.penetration.coats(y, columns.start, columns.len());
        // A copy, which the loop need not load again after each store.
        let rates = step.contact.rates;
        let heads = penetrations.iter().zip(coats);
        let volumes = volumes.iter().zip(&self.brush_volumes).zip(&self.leaving);
        let inputs = touches.iter().zip(heads).zip(volumes);
        for (found, ((&touch, (&penetration, &coat)), volumes)) in self.found.iter_mut().zip(inputs)
        {
            let ((&canvas, &brush), &leaving) = volumes;
            *found = exchange(&rates, touch, penetration, coat, canvas, brush, leaving);
        }
    }
}
