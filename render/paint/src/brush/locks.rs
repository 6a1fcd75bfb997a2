//! Locks of hair: how far the hair of each column stands back, and how much paint it leaves.
//!
//! Bristles cling together in locks of 0.3 to 1.2 mm. A lock that stands back leaves more paint,
//! as paint fills the room below it. While the head moves, locks change slowly, so that furrows
//! wander instead of repeating.

use rand::RngExt;

use super::grip::Grip;
use crate::amount::QUANTA_PER_CELL;
use graphics::noise::{Hills, random};

/// Width of a lock in mm (chosen by eye).
const LOCK_MM: f32 = 0.5;

/// Distance in mm along a stroke over which the locks change.
const CHANGE_MM: f32 = 6.0;

/// Number of sub-steps between two changes of the locks.
const SUB_STEPS: u32 = 4;

/// The hair of one column of paint cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Lock {
    /// Distance in quanta that the hair stands back from the surface of the head.
    pub(super) recess: i32,
    /// Coat relative to the mean, in parts of 32, shifted to its bits in the weights of a
    /// [`Touch`](crate::contact::Touch).
    pub(super) release: u32,
}

/// The locks of one head.
#[derive(Debug, Clone)]
pub(super) struct Locks {
    hills: Hills,
    /// Width of a column of paint cells, in locks.
    column: f32,
    cell_mm: f32,
    /// Largest recess in quanta.
    most: f32,
    /// Variation of the coat between locks, relative to its mean.
    variation: f32,
    /// Distance along the pattern, in units of [`CHANGE_MM`].
    along: f32,
    before: Option<((i64, i64), (f32, f32))>,
    sub_steps: u32,
    pub(super) columns: Vec<Lock>,
}

impl Locks {
    /// Locks of a head with `count` columns of paint cells, each `column_mm` wide. The hair
    /// stands back up to `recess_mm`, and its coat varies by the share `variation`. Heads with
    /// different seeds have different locks.
    pub(super) fn new(
        seed: u64,
        count: usize,
        column_mm: f64,
        (recess_mm, variation): (f32, f32),
        cell_mm: f64,
    ) -> Self {
        let cell_mm = cell_mm as f32;
        let mut locks = Self {
            hills: Hills::new(&mut random(seed, 0)),
            column: column_mm as f32 / LOCK_MM,
            cell_mm,
            most: recess_mm / cell_mm * QUANTA_PER_CELL as f32,
            variation,
            along: 0.0,
            before: None,
            sub_steps: 0,
            columns: vec![Lock { recess: 0, release: 32 << 9 }; count],
        };
        locks.change();
        locks
    }

    /// Locks of the same width grown from another seed.
    pub(super) fn seeded(mut self, seed: u64) -> Self {
        self.hills = Hills::new(&mut random(seed, 0));
        self.change();
        self
    }

    /// Ends a stroke: the next one has other locks.
    pub(super) fn lift(&mut self) {
        self.before = None;
    }

    /// Lets the locks change as the head moves to `grip`, and returns its motion in cells. Where
    /// a stroke begins decides its first locks, so that a stroke painted again is the same.
    pub(super) fn follow(&mut self, grip: &Grip) -> (f32, f32) {
        let Some((origin, tip)) = self.before.replace((grip.origin, grip.tip)) else {
            let (x, y) = grip.origin;
            let fraction = u64::from(grip.tip.0.to_bits()) << 32 | u64::from(grip.tip.1.to_bits());
            let place = (x as u64).rotate_left(20) ^ (y as u64).rotate_left(40) ^ fraction;
            self.along = random(place, 1).random_range(0.0..1000.0);
            self.sub_steps = 0;
            self.change();
            return (0.0, 0.0);
        };
        let moved = |to: i64, from: i64, to_part: f32, from_part: f32| {
            (to - from) as f32 + to_part - from_part
        };
        let x = moved(grip.origin.0, origin.0, grip.tip.0, tip.0);
        let y = moved(grip.origin.1, origin.1, grip.tip.1, tip.1);
        self.along += (x * x + y * y).sqrt() * self.cell_mm / CHANGE_MM;
        self.sub_steps += 1;
        if self.sub_steps.is_multiple_of(SUB_STEPS) {
            self.change();
        }
        (x, y)
    }

    fn change(&mut self) {
        let hills = &self.hills;
        let along = self.along;
        let most = self.most;
        for (column, lock) in self.columns.iter_mut().enumerate() {
            // A slow slant keeps lattice lines of the noise from being furrows.
            let across = column as f32 * self.column + 0.37 * along;
            let height = hills.at(across, along + 0.11 * across).clamp(-1.0, 1.0);
            let back = 0.5 + 0.5 * height;
            lock.recess = (most * back * back) as i32;
            let release = 32.0 * (1.0 + self.variation * height);
            lock.release = (release.clamp(1.0, 127.0) as u32) << 9;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::HeadShape;
    use super::*;
    use crate::pose::Pose;

    fn locks(seed: u64) -> Locks {
        Locks::new(seed, 60, 0.1, (0.05, 0.6), 0.1)
    }

    /// Locks after a way of 50 cells from `x`.
    fn after_a_stroke(mut locks: Locks, x: f64) -> Vec<Lock> {
        locks.lift();
        for step in 0..50 {
            let x = x + f64::from(step);
            let pressure = 0.5;
            let pose =
                Pose { x, y: 70.4, pressure, tilt_x_deg: 0.0, tilt_y_deg: 0.0, twist_deg: 0.0 };
            locks.follow(&Grip::new(&pose, HeadShape::Flat.proportions()).unwrap());
        }
        locks.columns
    }

    #[test]
    fn a_stroke_painted_again_has_its_locks_and_every_other_stroke_and_head_its_own() {
        let first = after_a_stroke(locks(1), 90.3);
        let mut used = locks(1);
        used.columns = after_a_stroke(used.clone(), 20.0);
        used.along = 17.0;
        assert_eq!(after_a_stroke(used, 90.3), first);
        assert_ne!(after_a_stroke(locks(1), 90.4), first);
        assert_ne!(after_a_stroke(locks(2), 90.3), first);
        assert_eq!(after_a_stroke(locks(1).seeded(2), 90.3), after_a_stroke(locks(2), 90.3));
    }

    #[test]
    fn locks_change_along_a_stroke_and_differ_across_it() {
        let near = after_a_stroke(locks(1), 90.3);
        let far = locks(1).columns;
        assert_ne!(near, far);
        for locks in [near, far] {
            let releases = || locks.iter().map(|lock| lock.release >> 9);
            let low = releases().min().unwrap();
            let high = releases().max().unwrap();
            assert!(low < 32 && high > 32 && high < 128, "{low} to {high}");
        }
    }
}
