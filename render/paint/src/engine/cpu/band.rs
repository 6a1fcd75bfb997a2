//! The part of a sub-step that one thread does: some rows of the contact's reach.

use std::ops::Range;

use super::cells::Cells;
use super::columns::{Row, Rows};
use super::exchanges::Exchanges;
use super::head_paint::HeadPaint;
use super::inflow::Inflow;
use super::step::SubStep;
use super::velocities::Velocities;
use crate::layer::Cell;
use crate::motion::transfer::Exchange;
use graphics::tile::Rect;

/// Rows of the canvas and the buffers of the thread that works on them. Buffers are
/// all zero between sub-steps and are reused, so that no sub-step allocates.
#[derive(Debug, Default)]
pub(super) struct Band {
    /// Rows of the canvas.
    pub(super) rows: Range<usize>,
    /// Paint that flows into these rows and into one row above and below.
    inflow: Inflow,
    /// Paint that each cell of the head gains from this band, modulo 2^32.
    gains: Cells,
    /// Indices of the head's cells that may gain or lose paint, possibly repeated or beyond the
    /// head.
    changed: Vec<u32>,
    velocities: Velocities,
    exchanges: Exchanges,
}

impl Band {
    /// Assigns `rows` of `reach` to this band and makes its buffers large enough.
    pub(super) fn begin(&mut self, rows: Range<usize>, reach: Rect, brush_cells: usize) {
        self.inflow.begin(reach.width, rows.len() + 2);
        self.rows = rows;
        self.gains.grow(brush_cells);
    }

    /// Steps 2 and 3 of the specification. Paint that flows in is added later, by
    /// [`Band::add_inflow_and_transfer`].
    #[inline(always)]
    pub(super) fn advect(&mut self, step: &SubStep<'_>, rows: &mut Rows<'_>) {
        self.velocities.begin(step, self.rows.start);
        for y in self.rows.clone() {
            let columns = step.penetration.moving(y);
            let mut row = rows.row(y, columns.start, columns.len());
            self.velocities.of_row(step, row.volume, y);
            if !columns.is_empty() {
                let place = (columns.start - step.reach.x, y + 1 - self.rows.start);
                self.inflow.scatter(&self.velocities, &mut row, place);
            }
        }
    }

    /// Moves the inflow that this band and the band `below` computed for each other's
    /// border rows to the band that owns the row.
    pub(super) fn exchange_border_rows(&mut self, below: &mut Self) {
        self.inflow.exchange_border_rows(&mut below.inflow);
    }

    /// The rest of step 3, and step 4 for the canvas. The head's cells are changed
    /// later, by [`Band::add_brush_gains`].
    #[inline(always)]
    pub(super) fn add_inflow_and_transfer(&mut self, step: &SubStep<'_>, rows: &mut Rows<'_>) {
        for y in self.rows.clone() {
            let inflow_row = y + 1 - self.rows.start;
            let changing = step.penetration.changing(y);
            if self.inflow.has_flow(inflow_row) && !changing.is_empty() {
                let row = rows.row(y, changing.start, changing.len());
                let from = changing.start - step.reach.x;
                self.inflow.pour(from..from + changing.len(), inflow_row, row);
            }
            let columns = step.penetration.in_contact(y);
            if !columns.is_empty() {
                self.transfer(step, rows.row(y, columns.start, columns.len()), y);
            }
        }
    }

    #[inline(always)]
    fn transfer(&mut self, step: &SubStep<'_>, row: Row<'_>, y: usize) {
        self.exchanges.of_row(step, row.volume, y);
        let head = step.head.cells.layer();
        let cells = head.vehicle.values().len();
        // Slices of one length, so that one check of an index is enough.
        let above = (&head.pigments.values()[..cells], &head.vehicle.values()[..cells]);
        let gains = (&mut self.gains.pigments[..cells], &mut self.gains.vehicle[..cells]);
        let touches = step.touches(y);
        self.changed.extend(touches.iter().map(|touch| touch.brush_cell));
        let paint = row.pigments.iter_mut().zip(row.vehicle).zip(row.volume);
        let exchanges = touches.iter().zip(&self.exchanges.found);
        for (((pigments, vehicle), volume), (touch, &Exchange { down, up })) in paint.zip(exchanges)
        {
            if down | up == 0 {
                continue;
            }
            let at = touch.brush_cell as usize;
            let laid = Cell { pigments: above.0[at], vehicle: above.1[at] }.share_of_65536(down);
            let canvas = Cell { pigments: *pigments, vehicle: *vehicle };
            let taken = canvas.share_of_65536(up);
            let canvas = canvas.minus(&taken).plus(&laid);
            (*pigments, *vehicle, *volume) = (canvas.pigments, canvas.vehicle, canvas.volume());
            let gained = Cell { pigments: gains.0[at], vehicle: gains.1[at] };
            let gained = gained.wrapping_plus(&taken).wrapping_minus(&laid);
            (gains.0[at], gains.1[at]) = (gained.pigments, gained.vehicle);
        }
    }

    /// Adds the gains of this band to the head's paint and clears them.
    #[inline(always)]
    pub(super) fn add_brush_gains(&mut self, head: &mut HeadPaint) {
        for at in self.changed.drain(..) {
            let at = at as usize;
            if let Some(gain) = self.gains.take(at) {
                head.cells.set_cell(at, head.cells.cell(at).wrapping_plus(&gain));
            }
        }
    }
}
