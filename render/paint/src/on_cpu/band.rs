//! One thread's share of a sub-step: some rows of the contact's reach.

use std::ops::Range;

use super::columns::{Columns, Row, Rows};
use super::pressed::Pressed;
use crate::contact::{Contact, Touch};
use crate::layer::{Cell, SLOTS};
use crate::motion::Motion;
use crate::motion::advect::{mobile_share, outflow};
use crate::motion::transfer::{Giver, exchange, handed_over};
use graphics::tile::Rect;

/// What all bands of a sub-step share.
#[derive(Debug, Clone, Copy)]
pub(super) struct SubStep<'a> {
    pub(super) motion: &'a Motion,
    pub(super) contact: &'a Contact,
    pub(super) bounds: Rect,
    /// The contact's rectangle grown by two.
    pub(super) reach: Rect,
    pub(super) pressed: &'a Pressed,
    /// The head's paint at the start.
    pub(super) brush: &'a Columns,
}

/// What one thread needs; empty between sub-steps, kept so that none allocates.
#[derive(Debug, Default)]
pub(super) struct Band {
    /// Its rows of the canvas.
    pub(super) rows: Range<usize>,
    /// What flows into its rows, and into one row above and one below.
    inflow: Vec<Cell>,
    /// Whether anything flows into or out of each of these rows.
    stirred: Vec<bool>,
    /// What the head gains from this band, by cell, modulo 2^32.
    gains: Vec<Cell>,
    /// The cells of the head that gain or lose, some more than once.
    changed: Vec<u32>,
    touches: Vec<Touch>,
    velocities: Vec<(i32, i32)>,
}

const NOTHING: Cell = Cell { pigments: [0; SLOTS], vehicle: 0 };

impl Band {
    pub(super) fn begin(&mut self, rows: Range<usize>, reach: Rect, brush_cells: usize) {
        let inflow_rows = rows.len() + 2;
        self.rows = rows;
        self.stirred.clear();
        self.stirred.resize(inflow_rows, false);
        self.inflow.resize(self.inflow.len().max(inflow_rows * reach.width), NOTHING);
        self.gains.resize(self.gains.len().max(brush_cells), NOTHING);
    }

    /// Steps 2 and 3; what comes in is kept until [`Band::settle`].
    #[inline(always)]
    pub(super) fn advect(&mut self, step: &SubStep<'_>, rows: &mut Rows<'_>) {
        let moving = step.contact.rect.grown(1, step.bounds);
        let first = self.rows.start.max(moving.y);
        let end = self.rows.end.min(moving.y + moving.height);
        for y in first..end {
            self.gather_touches(step.contact, moving, y);
            step.pressed.velocities(
                step.motion,
                (moving.x, y),
                &self.touches,
                &mut self.velocities,
            );
            let velocities = &mut self.velocities[..moving.width];
            if y == 0 {
                velocities.iter_mut().for_each(|v| v.1 = v.1.max(0));
            }
            if y + 1 == step.bounds.height {
                velocities.iter_mut().for_each(|v| v.1 = v.1.min(0));
            }
            if moving.x == 0 {
                velocities[0].0 = velocities[0].0.max(0);
            }
            if moving.x + moving.width == step.bounds.width {
                let last = &mut velocities[moving.width - 1];
                last.0 = last.0.min(0);
            }
            step.pressed.yields((moving.x, y), velocities);
            let row = rows.row(y, moving.x, moving.width);
            self.scatter(step, row, y, moving.x - step.reach.x);
        }
    }

    /// The touches of row `y`, none beyond the contact.
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

    /// Moves the columns of `row` by their velocities; it begins `left` cells
    /// right of the reach.
    #[inline(always)]
    fn scatter(&mut self, step: &SubStep<'_>, mut row: Row<'_>, y: usize, left: usize) {
        let stride = step.reach.width;
        let inflow_row = y + 1 - self.rows.start;
        let here = inflow_row * stride + left;
        let mut stirred = false;
        for (i, &(x_speed, y_speed)) in self.velocities[..row.volume.len()].iter().enumerate() {
            if x_speed | y_speed == 0 {
                continue;
            }
            let mobile = mobile_share(step.motion, row.volume[i]);
            if mobile == 0 {
                continue;
            }
            stirred = true;
            let cell = row.cell(i);
            let out = outflow(&cell, mobile, (x_speed.unsigned_abs(), y_speed.unsigned_abs()));
            row.put(i, cell.minus(&out.beside).minus(&out.along).minus(&out.corner));
            let along = match y_speed.signum() {
                0 => here + i,
                1 => here + i + stride,
                _ => here + i - stride,
            };
            let aside = |at: usize| at.wrapping_add_signed(x_speed.signum() as isize);
            for (at, part) in
                [(aside(here + i), out.beside), (along, out.along), (aside(along), out.corner)]
            {
                self.inflow[at] = self.inflow[at].plus(&part);
            }
        }
        if stirred {
            self.stirred[inflow_row - 1..=inflow_row + 1].fill(true);
        }
    }

    /// Gives the rows that this band and the one `below` share to their owners.
    pub(super) fn join(&mut self, below: &mut Self, stride: usize) {
        let rows = self.rows.len();
        self.stirred[rows] |= below.stirred[0];
        below.stirred[1] |= self.stirred[rows + 1];
        for x in 0..stride {
            let (last, beyond) = (rows * stride + x, (rows + 1) * stride + x);
            self.inflow[last] = self.inflow[last].plus(&below.inflow[x]);
            below.inflow[stride + x] = below.inflow[stride + x].plus(&self.inflow[beyond]);
            self.inflow[beyond] = NOTHING;
            below.inflow[x] = NOTHING;
        }
    }

    /// The rest of step 3, and step 4 but for the head's cells, see
    /// [`Band::pay_out`].
    #[inline(always)]
    pub(super) fn settle(&mut self, step: &SubStep<'_>, rows: &mut Rows<'_>) {
        let SubStep { reach, contact, .. } = *step;
        let rect = contact.rect;
        for y in self.rows.clone() {
            let inflow_row = y + 1 - self.rows.start;
            if self.stirred[inflow_row] {
                let mut row = rows.row(y, reach.x, reach.width);
                let inflow = &mut self.inflow[inflow_row * reach.width..][..reach.width];
                for (i, inflow) in inflow.iter_mut().enumerate() {
                    let cell = row.cell(i).plus(inflow);
                    *inflow = NOTHING;
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
        let pressed = step.pressed.row(y, rect.x, rect.width);
        for (i, (&touch, &penetration)) in touches.iter().zip(pressed).enumerate() {
            if penetration < 0 || touch.speed() == 0 {
                continue;
            }
            let at = touch.brush_cell as usize;
            let (giver, share) = exchange(
                step.motion,
                touch,
                penetration as u32,
                row.volume[i],
                step.brush.volume()[at],
            );
            if share == 0 {
                continue;
            }
            let (canvas, gains) = (row.cell(i), &mut self.gains[at]);
            let (left, gained) = match giver {
                Giver::Brush => {
                    let part = handed_over(&step.brush.cell(at), share);
                    (canvas.plus(&part), gains.wrapping_minus(&part))
                }
                Giver::Canvas => {
                    let part = handed_over(&canvas, share);
                    (canvas.minus(&part), gains.wrapping_plus(&part))
                }
            };
            row.put(i, left);
            row.volume[i] = left.volume();
            *gains = gained;
            self.changed.push(touch.brush_cell);
        }
    }

    /// Gives the head what it gained.
    #[inline(always)]
    pub(super) fn pay_out(&mut self, brush: &mut Columns) {
        for &at in &self.changed {
            let at = at as usize;
            let gained = std::mem::take(&mut self.gains[at]);
            brush.set_cell(at, brush.cell(at).wrapping_plus(&gained));
        }
        self.changed.clear();
    }
}
