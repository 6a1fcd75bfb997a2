//! Velocities of the paint of one row (step 2 of the specification in [`crate::motion`]) and the
//! paint that flows into the rows of a band (step 3).
//!
//! The loops do not branch, so that the compiler makes vector instructions of them.

use std::ops::Range;

use graphics::tile::Rect;

use super::columns::{HeadPaint, Planes};
use super::penetration::{Bed, PenetrationMap};
use crate::amount::share_of_65536;
use crate::contact::{Contact, Touch};
use crate::layer::{Cell, SLOTS};
use crate::motion::MotionConstants;
use crate::motion::advect::{mobile_share, outflow};
use crate::motion::press::{dragged, velocity};

/// Velocities of one row after another. This holds its buffers, so that sub-steps do not allocate.
#[derive(Debug, Default)]
pub(super) struct Velocities {
    /// Velocities along x and y in 1/16384 cell a sub-step.
    x: Vec<i32>,
    y: Vec<i32>,
    /// Share of each column that may move, in parts of 65536.
    mobile: Vec<u32>,
    /// Shares of each column that leave it along x, along y and diagonally. See [`outflow`].
    pub(super) outflow: [Vec<u32>; 3],
    /// Signs of the velocities along x and y, which tell to which neighbours paint moves.
    pub(super) beside: Vec<i32>,
    pub(super) below: Vec<i32>,
    touches: Vec<Touch>,
    /// All bits are set for each cell that is in contact or has a neighbour in contact, else 0.
    near: Vec<u32>,
    /// Flows over the left sides of the cells of the row and over the right side of its last.
    in_x: Vec<i32>,
    /// Flows over the upper and the lower sides of the cells of the row, from the left end of the
    /// reach on.
    in_y: [Vec<i32>; 2],
}

impl Velocities {
    /// Begins with the row `first` of `step`.
    #[inline(always)]
    pub(super) fn begin(&mut self, step: &SubStep<'_>, first: usize) {
        let [above, below] = &mut self.in_y;
        above.resize(step.reach.width, 0);
        below.resize(step.reach.width, 0);
        self.flow_in_y(step, first, 0);
    }

    /// Computes the velocities of the cells of row `y` that may move. `volumes` holds the heights
    /// of its columns in quanta. You must have called this for the row above just before.
    #[inline(always)]
    pub(super) fn of_row(&mut self, step: &SubStep<'_>, volumes: &[u32], y: usize) {
        let columns = step.penetration.moving(y);
        for buffer in [&mut self.x, &mut self.y, &mut self.beside, &mut self.below] {
            buffer.resize(columns.len(), 0);
        }
        for buffer in self.outflow.iter_mut().chain([&mut self.mobile]) {
            buffer.resize(columns.len(), 0);
        }
        self.in_x.resize(columns.len() + 1, 0);
        self.near.clear();
        self.near.resize(columns.len(), u32::MAX);
        self.flow_in_y(step, y + 1, 1);
        if columns.is_empty() {
            self.in_y.swap(0, 1);
            return;
        }
        self.gather_touches(step.contact, &columns, y);
        if step.motion.everywhere == 0 {
            step.penetration.near_contact((columns.start, y), &mut self.near);
        }
        let Self { x, mobile, near, touches, in_x, in_y: [above, below], .. } = self;
        step.penetration.flows_in_x(step.motion, (columns.start, y), in_x);
        let depths = step.penetration.row(y, columns.start, columns.len());
        // We copy these, so that the loop need not load them again after each store.
        let rates = step.contact.rates;
        let motion = *step.motion;
        let from = columns.start - step.reach.x;
        let in_y = above[from..].iter().zip(&below[from..]);
        let flows = in_x.iter().zip(&in_x[1..]).zip(in_y);
        let inputs = touches.iter().zip(depths).zip(volumes).zip(flows).zip(&*near);
        let found = x.iter_mut().zip(&mut self.y).zip(mobile);
        for (((x, y), mobile), ((((&touch, &depth), &volume), flows), &near)) in found.zip(inputs) {
            let ((&left, &right), (&above, &below)) = flows;
            let head = dragged(&rates, touch, depth, volume);
            *x = velocity(head.0, volume, left, right);
            *y = velocity(head.1, volume, above, below);
            *mobile = mobile_share(&motion, volume) & near;
        }
        self.in_y.swap(0, 1);
        self.keep_on_canvas(&columns, step.bounds, y);
        if step.penetration.has_crowded() {
            for (column, (x, y_speed)) in columns.zip(self.x.iter_mut().zip(&mut self.y)) {
                (*x, *y_speed) = step.penetration.avoid_crowded((column, y), (*x, *y_speed));
            }
        }
        self.find_outflows();
    }

    /// Computes the share of each column that moves to each neighbour.
    #[inline(always)]
    fn find_outflows(&mut self) {
        let Self { x, y, mobile, outflow: [in_x, in_y, diagonal], beside, below, .. } = self;
        let inputs = mobile.iter().zip(&*x).zip(&*y);
        let found = in_x.iter_mut().zip(in_y).zip(diagonal).zip(beside.iter_mut().zip(below));
        for ((((in_x, in_y), diagonal), (beside, below)), ((&mobile, x), y)) in found.zip(inputs) {
            let out = outflow(mobile, (x.unsigned_abs(), y.unsigned_abs()));
            (*in_x, *in_y, *diagonal) = (out.in_x, out.in_y, out.diagonal);
            (*beside, *below) = (x.signum(), y.signum());
        }
    }

    /// Computes the flows over the upper sides of row `y`, and keeps them as the first or second
    /// of [`Velocities::in_y`].
    #[inline(always)]
    fn flow_in_y(&mut self, step: &SubStep<'_>, y: usize, which: usize) {
        let columns = step.penetration.moving_beside(y);
        if !columns.is_empty() {
            let found = &mut self.in_y[which][columns.start - step.reach.x..][..columns.len()];
            step.penetration.flows_in_y(step.motion, (columns.start, y), found);
        }
    }

    /// Copies the touches of `columns` of row `y`. Cells beyond the contact get [`Touch::NONE`].
    #[inline(always)]
    fn gather_touches(&mut self, contact: &Contact, columns: &Range<usize>, y: usize) {
        let rect = contact.rect;
        self.touches.clear();
        if (rect.y..rect.y + rect.height).contains(&y) {
            let from = columns.start.clamp(rect.x, rect.x + rect.width) - rect.x;
            let to = columns.end.clamp(rect.x, rect.x + rect.width) - rect.x;
            self.touches.resize(rect.x.saturating_sub(columns.start), Touch::NONE);
            let row = &contact.touches[(y - rect.y) * rect.width..];
            self.touches.extend_from_slice(&row[from..to]);
        }
        self.touches.resize(columns.len(), Touch::NONE);
    }

    /// Removes the components of velocities that would carry paint off the canvas.
    #[inline(always)]
    fn keep_on_canvas(&mut self, columns: &Range<usize>, bounds: Rect, y: usize) {
        if let Some(first) = self.x.first_mut().filter(|_| columns.start == 0) {
            *first = (*first).max(0);
        }
        let at_right = columns.end == bounds.width;
        if let Some(last) = self.x.last_mut().filter(|_| at_right) {
            *last = (*last).min(0);
        }
        if y == 0 {
            self.y.iter_mut().for_each(|down| *down = (*down).max(0));
        }
        if y + 1 == bounds.height {
            self.y.iter_mut().for_each(|down| *down = (*down).min(0));
        }
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct SubStep<'a> {
    pub(super) motion: &'a MotionConstants,
    pub(super) contact: &'a Contact,
    pub(super) bounds: Rect,
    /// The contact's rectangle grown by two cells.
    pub(super) reach: Rect,
    pub(super) penetration: &'a PenetrationMap,
    /// The surface before the stroke.
    pub(super) bed: &'a Bed,
    /// Paint on the head at the start of the sub-step.
    pub(super) head: &'a HeadPaint,
}

impl SubStep<'_> {
    /// Touches of the cells in contact of row `y`, and of those between them.
    #[inline(always)]
    pub(super) fn touches(&self, y: usize) -> &[Touch] {
        let rect = self.contact.rect;
        let columns = self.penetration.in_contact(y);
        let first = (y - rect.y) * rect.width + columns.start - rect.x;
        &self.contact.touches[first..][..columns.len()]
    }
}

/// Amounts in quanta by cell, modulo 2^32. We keep pigments and vehicle apart, as in a layer, so
/// that the amounts of a cell take one vector and one number.
#[derive(Debug, Default)]
pub(super) struct Cells {
    pub(super) pigments: Vec<[u32; SLOTS]>,
    pub(super) vehicle: Vec<u32>,
}

impl Cells {
    /// Makes room for `count` cells. New cells have no paint.
    pub(super) fn grow(&mut self, count: usize) {
        let count = count.max(self.vehicle.len());
        self.pigments.resize(count, [0; SLOTS]);
        self.vehicle.resize(count, 0);
    }

    /// Removes the paint of a cell. If there is no such cell, you get `None`.
    #[inline(always)]
    pub(super) fn take(&mut self, at: usize) -> Option<Cell> {
        let pigments = self.pigments.get_mut(at)?;
        let vehicle = self.vehicle.get_mut(at)?;
        Some(Cell { pigments: std::mem::take(pigments), vehicle: std::mem::take(vehicle) })
    }
}

/// Paint by cell, row by row. Between sub-steps there is none. This holds its buffers, so that
/// sub-steps do not allocate.
#[derive(Debug, Default)]
pub(super) struct Inflow {
    width: usize,
    cells: Cells,
    /// Whether paint flows into or out of each row.
    flows: Vec<bool>,
    /// Vehicle that leaves each column of a row along x, along y and diagonally.
    leaving: [Vec<u32>; 3],
}

impl Inflow {
    /// Makes room for `rows` rows of `width` cells, into which nothing flows yet.
    pub(super) fn begin(&mut self, width: usize, rows: usize) {
        self.cells.grow(width * rows);
        self.width = width;
        self.flows.clear();
        self.flows.resize(rows, false);
    }

    pub(super) fn has_flow(&self, y: usize) -> bool {
        self.flows.get(y) == Some(&true)
    }

    /// Whether there is room for paint.
    pub(super) fn begun(&self) -> bool {
        !self.flows.is_empty()
    }

    /// Takes the paint that leaves the columns of `row`, which are cells of one film, and adds it to the
    /// cells that it reaches. The first column lies at column `x` of row `y`, which is neither the first
    /// row nor the last.
    #[inline(always)]
    pub(super) fn scatter(
        &mut self,
        velocities: &Velocities,
        row: &mut Planes<'_>,
        (x, y): (usize, usize),
    ) {
        self.take_vehicle(velocities, row.vehicle);
        let Self { cells: Cells { pigments, vehicle }, leaving, .. } = self;
        // Slices of one length, so that one check of an index is enough.
        let count = pigments.len();
        let to_pigments = &mut pigments[..count];
        let to_vehicle = &mut vehicle[..count];
        let first = y * self.width + x;
        let width = self.width as isize;
        let [in_x, in_y, diagonal] = &velocities.outflow;
        let shares = in_x.iter().zip(in_y).zip(diagonal);
        let to = velocities.beside.iter().zip(&velocities.below);
        let [in_x, in_y, diagonal] = &*leaving;
        let vehicle = in_x.iter().zip(in_y).zip(diagonal);
        let columns = row.pigments.iter_mut().zip(shares).zip(to).zip(vehicle).enumerate();
        let mut flows = false;
        for (i, (((pigments, ((&in_x, &in_y), &diagonal)), (&beside, &below)), vehicle)) in columns
        {
            if in_x | in_y | diagonal == 0 {
                continue;
            }
            flows = true;
            let before = Cell { pigments: *pigments, vehicle: 0 };
            let in_x = before.share_of_65536(in_x);
            let in_y = before.share_of_65536(in_y);
            let diagonal = before.share_of_65536(diagonal);
            *pigments = before.minus(&in_x).minus(&in_y).minus(&diagonal).pigments;
            let at_x = (first + i).wrapping_add_signed(beside as isize);
            let at_y = (first + i).wrapping_add_signed(below as isize * width);
            let at_diagonal = at_y.wrapping_add_signed(beside as isize);
            let ((vehicle_x, vehicle_y), vehicle_diagonal) = vehicle;
            to_pigments[at_x] = sum(&to_pigments[at_x], &in_x);
            to_vehicle[at_x] += vehicle_x;
            to_pigments[at_y] = sum(&to_pigments[at_y], &in_y);
            to_vehicle[at_y] += vehicle_y;
            to_pigments[at_diagonal] = sum(&to_pigments[at_diagonal], &diagonal);
            to_vehicle[at_diagonal] += vehicle_diagonal;
        }
        if flows {
            self.flows[y - 1..=y + 1].fill(true);
        }
    }

    /// Subtracts from `vehicle` the part that leaves each column of the row, and stores this part.
    #[inline(always)]
    fn take_vehicle(&mut self, velocities: &Velocities, vehicle: &mut [u32]) {
        for (parts, shares) in self.leaving.iter_mut().zip(&velocities.outflow) {
            parts.resize(vehicle.len(), 0);
            for ((part, &vehicle), &share) in parts.iter_mut().zip(&*vehicle).zip(shares) {
                *part = share_of_65536(vehicle, share);
            }
        }
        let [in_x, in_y, diagonal] = &self.leaving;
        let parts = in_x.iter().zip(in_y).zip(diagonal);
        for (vehicle, ((in_x, in_y), diagonal)) in vehicle.iter_mut().zip(parts) {
            *vehicle -= in_x + in_y + diagonal;
        }
    }

    /// Moves inflow to the band that owns the row. This band has computed paint that flows into the
    /// first row of the band `below`, and that band has computed paint for the last row of this
    /// one.
    pub(super) fn exchange_border_rows(&mut self, below: &mut Self) {
        let last = self.flows.len() - 2;
        let beyond = self.flows.len() - 1;
        self.flows[last] |= below.flows[0];
        below.flows[1] |= self.flows[beyond];
        self.take_row(last, below, 0);
        below.take_row(1, self, beyond);
    }

    fn take_row(&mut self, to: usize, other: &mut Self, from: usize) {
        let width = self.width;
        for x in 0..width {
            let Some(more) = other.cells.take(from * width + x) else { continue };
            let to = to * width + x;
            self.cells.pigments[to] = sum(&self.cells.pigments[to], &more);
            self.cells.vehicle[to] += more.vehicle;
        }
    }

    /// Moves the paint at `columns` of row `y` into a film. `row` holds these cells of the film. Afterwards
    /// its volumes count the paint of this film alone.
    #[inline(always)]
    pub(super) fn pour(&mut self, columns: Range<usize>, y: usize, row: &mut Planes<'_>) {
        let first = y * self.width;
        let cells = first + columns.start..first + columns.end;
        let Cells { pigments, vehicle } = &mut self.cells;
        let vehicle = &mut vehicle[cells.clone()];
        for (amount, more) in row.vehicle.iter_mut().zip(&*vehicle) {
            *amount += more;
        }
        vehicle.fill(0);
        let more = row.pigments.iter_mut().zip(&mut pigments[cells]);
        for ((volume, &vehicle), (pigments, more)) in
            row.volume.iter_mut().zip(&*row.vehicle).zip(more)
        {
            *pigments = sum(pigments, &Cell { pigments: *more, vehicle: 0 });
            *volume = Cell { pigments: *pigments, vehicle }.volume();
            *more = [0; SLOTS];
        }
    }
}

#[inline(always)]
fn sum(pigments: &[u32; SLOTS], more: &Cell) -> [u32; SLOTS] {
    more.plus(&Cell { pigments: *pigments, vehicle: 0 }).pigments
}
