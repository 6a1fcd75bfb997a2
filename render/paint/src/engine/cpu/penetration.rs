//! How deep the head is pressed into the paint during one sub-step: steps 1 and 2 of
//! the specification in [`crate::motion`], row by row.

use super::columns::Columns;
use crate::contact::{Contact, Touch};
use crate::motion::MotionConstants;
use crate::motion::press::{
    CROWDED_VOLUME, NO_CONTACT, avoid_crowded_columns, penetration, velocity,
};
use graphics::field::Field;
use graphics::tile::Rect;

/// Penetration in quanta over the reach of a contact. A rim of one cell on every side
/// holds [`NO_CONTACT`], so that slopes need no bounds checks.
#[derive(Debug, Default)]
pub(super) struct PenetrationMap {
    reach: Rect,
    values: Vec<i32>,
    /// Whether each column is crowded, with the same rim; empty if none is, which is
    /// nearly always so.
    crowded: Vec<bool>,
}

impl PenetrationMap {
    /// Step 1: computes the penetration of each cell of `contact`, which lies within
    /// `reach`.
    #[inline(always)]
    pub(super) fn measure(
        &mut self,
        contact: &Contact,
        reach: Rect,
        floor: &Field<i32>,
        wet: &Columns,
    ) {
        let rect = contact.rect;
        self.reach = reach;
        self.find_crowded(wet);
        self.values.clear();
        self.values.resize((reach.width + 2) * (reach.height + 2), NO_CONTACT);
        for (y, touches) in (rect.y..).zip(contact.touches.chunks_exact(rect.width)) {
            let volume = &wet.volume()[y * floor.width() + rect.x..][..rect.width];
            let floor = floor.row(y, rect.x, rect.width);
            let start = self.start(y) + rect.x - reach.x;
            let found = &mut self.values[start..][..rect.width];
            for (((here, &touch), &floor), &volume) in
                found.iter_mut().zip(touches).zip(floor).zip(volume)
            {
                *here = penetration(touch, floor, volume);
            }
        }
    }

    #[inline(always)]
    fn find_crowded(&mut self, wet: &Columns) {
        let reach = self.reach;
        self.crowded.clear();
        let rows = reach.y..reach.y + reach.height;
        let row = |y: usize| &wet.volume()[y * wet.width() + reach.x..][..reach.width];
        let highest = rows.clone().map(|y| highest(row(y))).max().unwrap_or(0);
        if highest > CROWDED_VOLUME {
            self.crowded.resize((reach.width + 2) * (reach.height + 2), false);
            for y in rows {
                let start = self.start(y);
                for (crowded, &volume) in self.crowded[start..].iter_mut().zip(row(y)) {
                    *crowded = volume > CROWDED_VOLUME;
                }
            }
        }
    }

    /// Step 2: applies [`avoid_crowded_columns`] to the cells of row `y` from `x` on.
    #[inline(always)]
    pub(super) fn avoid_crowded(&self, (x, y): (usize, usize), velocities: &mut [(i32, i32)]) {
        if self.crowded.is_empty() {
            return;
        }
        let row = (self.reach.width + 2) as isize;
        let start = self.start(y) + x - self.reach.x;
        for (i, velocity) in velocities.iter_mut().enumerate() {
            *velocity = avoid_crowded_columns(*velocity, |right, down| {
                let step = down as isize * row + right as isize;
                self.crowded[(start + i).wrapping_add_signed(step)]
            });
        }
    }

    /// Index of the reach's first cell in row `y`. The rows just above and below the
    /// reach are allowed too.
    #[inline(always)]
    fn start(&self, y: usize) -> usize {
        (y + 1 - self.reach.y) * (self.reach.width + 2) + 1
    }

    /// Penetration of `width` cells of row `y` from `x` on, in quanta.
    #[inline(always)]
    pub(super) fn row(&self, y: usize, x: usize, width: usize) -> &[i32] {
        &self.values[self.start(y) + x - self.reach.x..][..width]
    }

    /// Step 2: velocities of `touches.len()` cells of row `y` from `x` on, before the
    /// canvas edges and crowded columns are taken into account.
    #[inline(always)]
    pub(super) fn velocities(
        &self,
        motion: &MotionConstants,
        (x, y): (usize, usize),
        touches: &[Touch],
        found: &mut Vec<(i32, i32)>,
    ) {
        let width = touches.len();
        let start = self.start(y) + x - self.reach.x;
        let row = self.reach.width + 2;
        let here = &self.values[start - 1..][..width + 2];
        let above = &self.values[start - row..][..width];
        let below = &self.values[start + row..][..width];
        found.resize(found.len().max(width), (0, 0));
        for (i, (found, &touch)) in found.iter_mut().zip(touches).enumerate() {
            let slopes = (here[i + 2].max(0) - here[i].max(0), below[i].max(0) - above[i].max(0));
            *found = velocity(motion, touch, here[i + 1], slopes);
        }
    }
}

#[inline(always)]
fn highest(volumes: &[u32]) -> u32 {
    let mut highest = 0;
    for &volume in volumes {
        highest = highest.max(volume);
    }
    highest
}
