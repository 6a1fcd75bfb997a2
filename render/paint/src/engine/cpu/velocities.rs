//! Velocities of the paint of one row: step 2 of the specification in [`crate::motion`]. Its loops
//! have no branches, so that they are compiled to vector instructions.

use std::ops::Range;

use super::step::SubStep;
use crate::contact::{Contact, Touch};
use crate::motion::advect::{mobile_share, outflow};
use crate::motion::press::{dragged, velocity};
use graphics::tile::Rect;

/// Velocities of one row after another. Holds its buffers, so that no sub-step allocates.
#[derive(Debug, Default)]
pub(super) struct Velocities {
    /// Along x and y in 1/16384 cell a sub-step.
    x: Vec<i32>,
    y: Vec<i32>,
    /// Share of each column that may move, in parts of 65536.
    mobile: Vec<u32>,
    /// Shares of each column that leave it along x, along y and diagonally; see [`outflow`].
    pub(super) outflow: [Vec<u32>; 3],
    /// Signs of the velocities along x and y: to which neighbours paint moves.
    pub(super) beside: Vec<i32>,
    pub(super) below: Vec<i32>,
    touches: Vec<Touch>,
    /// All bits set for each cell that, or a neighbour of which, is in contact; else 0.
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

    /// Computes those of the cells of row `y` that may move, whose columns are `volumes` quanta
    /// high. The row before it was the one above.
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
        // Copies, which the loop need not load again after each store.
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

    /// Computes the shares that leave the columns, and to which neighbours.
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

    /// Copies the touches of `columns` of row `y`; cells beyond the contact get [`Touch::NONE`].
    #[inline(always)]
    fn gather_touches(&mut self, contact: &Contact, columns: &Range<usize>, y: usize) {
        let rect = contact.rect;
        self.touches.clear();
        if (rect.y..rect.y + rect.height).contains(&y) {
            let within = |x: usize| x.clamp(rect.x, rect.x + rect.width) - rect.x;
            let from = within(columns.start);
            let to = within(columns.end);
            self.touches.resize(rect.x.saturating_sub(columns.start), Touch::NONE);
            let row = &contact.touches[(y - rect.y) * rect.width..];
            self.touches.extend_from_slice(&row[from..to]);
        }
        self.touches.resize(columns.len(), Touch::NONE);
    }

    /// Removes the components that would carry paint off the canvas.
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
