//! The part of a sub-step that one thread does: some rows of the contact's reach.

use std::ops::Range;

use super::columns::{Row, Rows};
use super::exchanges::Exchanges;
use super::head_paint::HeadPaint;
use super::step::SubStep;
use super::velocities::Velocities;
use crate::layer::{Cell, SLOTS};
use crate::motion::advect::outflow;
use crate::motion::transfer::Exchange;
use graphics::tile::Rect;

/// Rows of the canvas and the buffers of the thread that works on them. Buffers are
/// all zero between sub-steps and are reused, so that no sub-step allocates.
#[derive(Debug, Default)]
pub(super) struct Band {
    /// Rows of the canvas.
    pub(super) rows: Range<usize>,
    /// Paint that flows into each cell of these rows and of one row above and below.
    inflow: Vec<Cell>,
    /// Whether paint flows into or out of each row of `inflow`.
    row_flows: Vec<bool>,
    /// Paint that each cell of the head gains from this band, modulo 2^32.
    gains: Vec<Cell>,
    /// Indices of the head's cells that gain or lose paint, possibly repeated.
    changed: Vec<u32>,
    velocities: Velocities,
    exchanges: Exchanges,
}

const EMPTY: Cell = Cell { pigments: [0; SLOTS], vehicle: 0 };

impl Band {
    /// Assigns `rows` of `reach` to this band and makes its buffers large enough.
    pub(super) fn begin(&mut self, rows: Range<usize>, reach: Rect, brush_cells: usize) {
        let inflow_rows = rows.len() + 2;
        self.rows = rows;
        self.row_flows.clear();
        self.row_flows.resize(inflow_rows, false);
        self.inflow.resize(self.inflow.len().max(inflow_rows * reach.width), EMPTY);
        self.gains.resize(self.gains.len().max(brush_cells), EMPTY);
    }

    /// Steps 2 and 3 of the specification. Paint that flows in is added later, by
    /// [`Band::add_inflow_and_transfer`].
    #[inline(always)]
    pub(super) fn advect(&mut self, step: &SubStep<'_>, rows: &mut Rows<'_>) {
        self.velocities.begin(step, self.rows.start);
        for y in self.rows.clone() {
            let columns = step.penetration.moving(y);
            let row = rows.row(y, columns.start, columns.len());
            self.velocities.of_row(step, row.volume, y);
            self.scatter(step, row, (columns.start, y));
        }
    }

    /// Moves the columns of `row`, whose first cell is at `(x, y)`, by their velocities.
    #[inline(always)]
    fn scatter(&mut self, step: &SubStep<'_>, mut row: Row<'_>, (x, y): (usize, usize)) {
        let stride = step.reach.width;
        let inflow_row = y + 1 - self.rows.start;
        let here = (inflow_row * stride + x).saturating_sub(step.reach.x);
        let Velocities { x, y, mobile, .. } = &self.velocities;
        let mut flows = false;
        for (i, ((&x, &y), &mobile)) in x.iter().zip(y).zip(mobile).enumerate() {
            if (x | y == 0) | (mobile == 0) {
                continue;
            }
            flows = true;
            let cell = row.cell(i);
            let out = outflow(mobile, (x.unsigned_abs(), y.unsigned_abs()));
            let in_x = cell.share_of_65536(out.in_x);
            let in_y = cell.share_of_65536(out.in_y);
            let diagonal = cell.share_of_65536(out.diagonal);
            row.put(i, cell.minus(&in_x).minus(&in_y).minus(&diagonal));
            let to_y = match y.signum() {
                0 => here + i,
                1 => here + i + stride,
                _ => here + i - stride,
            };
            let aside = |at: usize| at.wrapping_add_signed(x.signum() as isize);
            for (at, part) in [(aside(here + i), in_x), (to_y, in_y), (aside(to_y), diagonal)] {
                self.inflow[at] = self.inflow[at].plus(&part);
            }
        }
        if flows {
            self.row_flows[inflow_row - 1..=inflow_row + 1].fill(true);
        }
    }

    /// Moves the inflow that this band and the band `below` computed for each other's
    /// border rows to the band that owns the row.
    pub(super) fn exchange_border_rows(&mut self, below: &mut Self, stride: usize) {
        let rows = self.rows.len();
        self.row_flows[rows] |= below.row_flows[0];
        below.row_flows[1] |= self.row_flows[rows + 1];
        for x in 0..stride {
            let (last, beyond) = (rows * stride + x, (rows + 1) * stride + x);
            self.inflow[last] = self.inflow[last].plus(&below.inflow[x]);
            below.inflow[stride + x] = below.inflow[stride + x].plus(&self.inflow[beyond]);
            self.inflow[beyond] = EMPTY;
            below.inflow[x] = EMPTY;
        }
    }

    /// The rest of step 3, and step 4 for the canvas. The head's cells are changed
    /// later, by [`Band::add_brush_gains`].
    #[inline(always)]
    pub(super) fn add_inflow_and_transfer(&mut self, step: &SubStep<'_>, rows: &mut Rows<'_>) {
        let reach = step.reach;
        for y in self.rows.clone() {
            let inflow_row = y + 1 - self.rows.start;
            let changing = step.penetration.changing(y);
            if self.row_flows[inflow_row] && !changing.is_empty() {
                let first = inflow_row * reach.width + changing.start - reach.x;
                let mut row = rows.row(y, changing.start, changing.len());
                let inflow = &mut self.inflow[first..][..changing.len()];
                for (i, inflow) in inflow.iter_mut().enumerate() {
                    let cell = row.cell(i).plus(inflow);
                    *inflow = EMPTY;
                    row.put(i, cell);
                    row.volume[i] = cell.volume();
                }
            }
            let columns = step.penetration.in_contact(y);
            if !columns.is_empty() {
                self.transfer(step, rows.row(y, columns.start, columns.len()), y);
            }
        }
    }

    #[inline(always)]
    fn transfer(&mut self, step: &SubStep<'_>, mut row: Row<'_>, y: usize) {
        self.exchanges.of_row(step, row.volume, y);
        let touches = step.touches(y);
        for (i, (touch, &exchange)) in touches.iter().zip(&self.exchanges.found).enumerate() {
            let Exchange { down, up } = exchange;
            if down | up == 0 {
                continue;
            }
            let at = touch.brush_cell as usize;
            let laid = step.head.cells.cell(at).share_of_65536(down);
            let canvas = row.cell(i);
            let taken = canvas.share_of_65536(up);
            let changed = canvas.minus(&taken).plus(&laid);
            row.put(i, changed);
            row.volume[i] = changed.volume();
            let gains = &mut self.gains[at];
            *gains = gains.wrapping_plus(&taken).wrapping_minus(&laid);
            self.changed.push(touch.brush_cell);
        }
    }

    /// Adds the gains of this band to the head's paint and clears them.
    #[inline(always)]
    pub(super) fn add_brush_gains(&mut self, head: &mut HeadPaint) {
        for &at in &self.changed {
            let at = at as usize;
            let gain = std::mem::take(&mut self.gains[at]);
            head.cells.set_cell(at, head.cells.cell(at).wrapping_plus(&gain));
        }
        self.changed.clear();
    }
}
