//! Velocities of the paint of one row: step 2 of the specification in [`crate::motion`]. Its loops
//! have no branches, so that they are compiled to vector instructions.

use super::step::SubStep;
use crate::contact::{Contact, Touch};
use crate::motion::advect::mobile_share;
use crate::motion::press::{dragged, velocity};
use graphics::tile::Rect;

/// Velocities of one row after another. Holds its buffers, so that no sub-step allocates.
#[derive(Debug, Default)]
pub(super) struct Velocities {
    /// Along x and y in 1/16384 cell a sub-step.
    pub(super) x: Vec<i32>,
    pub(super) y: Vec<i32>,
    /// Share of each column that may move, in parts of 65536.
    pub(super) mobile: Vec<u32>,
    touches: Vec<Touch>,
    /// Flows over the left sides of the cells of the row and over the right side of its last.
    in_x: Vec<i32>,
    /// Flows over the upper and the lower sides of the cells of the row.
    in_y: [Vec<i32>; 2],
}

impl Velocities {
    /// Begins with the row `first` of `step`.
    #[inline(always)]
    pub(super) fn begin(&mut self, step: &SubStep<'_>, first: usize) {
        let moving = step.moving();
        let [above, below] = &mut self.in_y;
        for buffer in [above, below, &mut self.x, &mut self.y] {
            buffer.resize(moving.width, 0);
        }
        self.mobile.resize(moving.width, 0);
        self.in_x.resize(moving.width + 1, 0);
        step.penetration.flows_in_y(step.motion, (moving.x, first), &mut self.in_y[0]);
    }

    /// Computes those of row `y`, whose columns are `volumes` quanta high. The row before it was
    /// the one above.
    #[inline(always)]
    pub(super) fn of_row(&mut self, step: &SubStep<'_>, volumes: &[u32], y: usize) {
        let moving = step.moving();
        self.gather_touches(step.contact, moving, y);
        let Self { x, mobile, touches, in_x, in_y: [above, below], .. } = self;
        step.penetration.flows_in_x(step.motion, (moving.x, y), in_x);
        step.penetration.flows_in_y(step.motion, (moving.x, y + 1), below);
        let depths = step.penetration.row(y, moving.x, moving.width);
        let flows = in_x.iter().zip(&in_x[1..]).zip(above.iter().zip(&*below));
        let columns = touches.iter().zip(depths).zip(volumes).zip(flows);
        let found = x.iter_mut().zip(&mut self.y).zip(mobile);
        for (((x, y), mobile), (((&touch, &depth), &volume), flows)) in found.zip(columns) {
            let ((&left, &right), (&above, &below)) = flows;
            let head = dragged(&step.contact.rates, touch, depth, volume);
            *x = velocity(head.0, volume, left, right);
            *y = velocity(head.1, volume, above, below);
            *mobile = mobile_share(step.motion, volume);
        }
        self.in_y.swap(0, 1);
        self.keep_on_canvas(moving, step.bounds, y);
        if step.penetration.has_crowded() {
            for (column, (x, y_speed)) in self.x.iter_mut().zip(&mut self.y).enumerate() {
                let place = (moving.x + column, y);
                (*x, *y_speed) = step.penetration.avoid_crowded(place, (*x, *y_speed));
            }
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

    /// Removes the components that would carry paint off the canvas.
    #[inline(always)]
    fn keep_on_canvas(&mut self, moving: Rect, bounds: Rect, y: usize) {
        if let Some(first) = self.x.first_mut().filter(|_| moving.x == 0) {
            *first = (*first).max(0);
        }
        let at_right = moving.x + moving.width == bounds.width;
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
