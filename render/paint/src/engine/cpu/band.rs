//! The part of a sub-step that one thread does: some rows of the contact's reach.

use std::ops::Range;

use super::columns::{Row, Rows};
use super::head_paint::HeadPaint;
use super::penetration::PenetrationMap;
use crate::contact::{Contact, Touch};
use crate::layer::{Cell, SLOTS};
use crate::motion::MotionConstants;
use crate::motion::advect::{mobile_share, outflow};
use crate::motion::press::{NO_CONTACT, coat, dragged, velocity};
use crate::motion::transfer::{Exchange, exchange, leaving};
use graphics::tile::Rect;

/// Inputs of a sub-step that all bands share.
#[derive(Debug, Clone, Copy)]
pub(super) struct SubStep<'a> {
    pub(super) motion: &'a MotionConstants,
    pub(super) contact: &'a Contact,
    pub(super) bounds: Rect,
    /// The contact's rectangle grown by two cells.
    pub(super) reach: Rect,
    pub(super) penetration: &'a PenetrationMap,
    /// Paint on the head at the start of the sub-step.
    pub(super) head: &'a HeadPaint,
}

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
    touches: Vec<Touch>,
    /// Flows over the left sides of the cells of one row and over the right side of its last.
    in_x: Vec<i32>,
    /// Flows over the upper and the lower sides of the cells of one row.
    in_y: [Vec<i32>; 2],
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
        let moving = step.contact.rect.grown(1, step.bounds);
        let first = self.rows.start.max(moving.y);
        let end = self.rows.end.min(moving.y + moving.height);
        let Self { in_x, in_y: [above, below], .. } = self;
        in_x.resize(moving.width + 1, 0);
        above.resize(moving.width, 0);
        below.resize(moving.width, 0);
        if first < end {
            step.penetration.flows_in_y(step.motion, (moving.x, first), above);
        }
        for y in first..end {
            self.gather_touches(step.contact, moving, y);
            let [_, below] = &mut self.in_y;
            step.penetration.flows_in_x(step.motion, (moving.x, y), &mut self.in_x);
            step.penetration.flows_in_y(step.motion, (moving.x, y + 1), below);
            self.scatter(step, rows.row(y, moving.x, moving.width), (moving.x, y));
            self.in_y.swap(0, 1);
        }
    }

    /// Copies the touches of row `y`; cells beyond the contact get [`Touch::NONE`].
    #[inline(always)]
    fn gather_touches(&mut self, contact: &Contact, moving: Rect, y: usize) {
        let rect = contact.rect;
        self.touches.clear();
        if (rect.y..rect.y + rect.height).contains(&y) {
            self.touches.resize(rect.x - moving.x, Touch::NONE);
            let start = (y - rect.y) * rect.width;
            self.touches.extend_from_slice(&contact.touches[start..][..rect.width]);
        }
        self.touches.resize(moving.width, Touch::NONE);
    }

    /// Moves the columns of `row`, whose first cell is at `(x, y)`, by their velocities.
    #[inline(always)]
    fn scatter(&mut self, step: &SubStep<'_>, mut row: Row<'_>, (x, y): (usize, usize)) {
        let stride = step.reach.width;
        let inflow_row = y + 1 - self.rows.start;
        let here = inflow_row * stride + x - step.reach.x;
        let depths = step.penetration.row(y, x, row.volume.len());
        let mut flows = false;
        for (i, &depth) in depths.iter().enumerate() {
            let (left, right) = (self.in_x[i], self.in_x[i + 1]);
            let (above, below) = (self.in_y[0][i], self.in_y[1][i]);
            if (depth <= 0) & (left | right | above | below == 0) {
                continue;
            }
            let mobile = mobile_share(step.motion, row.volume[i]);
            if mobile == 0 {
                continue;
            }
            let head = dragged(&step.contact.rates, self.touches[i], depth, row.volume[i]);
            let speed = (
                velocity(head.0, row.volume[i], left, right),
                velocity(head.1, row.volume[i], above, below),
            );
            let speed = on_canvas(speed, (x + i, y), step.bounds);
            let (x_speed, y_speed) = step.penetration.avoid_crowded((x + i, y), speed);
            if x_speed | y_speed == 0 {
                continue;
            }
            flows = true;
            let cell = row.cell(i);
            let out = outflow(&cell, mobile, (x_speed.unsigned_abs(), y_speed.unsigned_abs()));
            row.put(i, cell.minus(&out.in_x).minus(&out.in_y).minus(&out.diagonal));
            let to_y = match y_speed.signum() {
                0 => here + i,
                1 => here + i + stride,
                _ => here + i - stride,
            };
            let in_x = |at: usize| at.wrapping_add_signed(x_speed.signum() as isize);
            for (at, part) in
                [(in_x(here + i), out.in_x), (to_y, out.in_y), (in_x(to_y), out.diagonal)]
            {
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
        let SubStep { reach, contact, .. } = *step;
        let rect = contact.rect;
        for y in self.rows.clone() {
            let inflow_row = y + 1 - self.rows.start;
            if self.row_flows[inflow_row] {
                let mut row = rows.row(y, reach.x, reach.width);
                let inflow = &mut self.inflow[inflow_row * reach.width..][..reach.width];
                for (i, inflow) in inflow.iter_mut().enumerate() {
                    let cell = row.cell(i).plus(inflow);
                    *inflow = EMPTY;
                    row.put(i, cell);
                    row.volume[i] = cell.volume();
                }
            }
            if (rect.y..rect.y + rect.height).contains(&y) {
                self.transfer(step, rows.row(y, rect.x, rect.width), y);
            }
        }
    }

    #[inline(always)]
    fn transfer(&mut self, step: &SubStep<'_>, mut row: Row<'_>, y: usize) {
        let rect = step.contact.rect;
        let touches = &step.contact.touches[(y - rect.y) * rect.width..][..rect.width];
        let penetrations = step.penetration.row(y, rect.x, rect.width);
        for (i, (&touch, &penetration)) in touches.iter().zip(penetrations).enumerate() {
            if penetration == NO_CONTACT {
                continue;
            }
            let at = touch.brush_cell as usize;
            let (canvas_volume, brush_volume) = (row.volume[i], step.head.cells.volume()[at]);
            if canvas_volume | brush_volume == 0 {
                continue;
            }
            let Exchange { down, up } = exchange(
                &step.contact.rates,
                touch,
                penetration,
                coat(&step.contact.rates, touch, step.head.means[at]),
                canvas_volume,
                brush_volume,
                leaving(touch, (rect.x + i, y), step.bounds),
            );
            if down | up == 0 {
                continue;
            }
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

/// `velocity` without the components that would carry paint off the canvas.
#[inline(always)]
fn on_canvas((right, down): (i32, i32), (x, y): (usize, usize), bounds: Rect) -> (i32, i32) {
    let right = if x == 0 { right.max(0) } else { right };
    let right = if x + 1 == bounds.width { right.min(0) } else { right };
    let down = if y == 0 { down.max(0) } else { down };
    let down = if y + 1 == bounds.height { down.min(0) } else { down };
    (right, down)
}
