//! Locks of hair: how far the hair of each column stands back, and how much paint it leaves and
//! takes.
//!
//! Bristles cling together in locks of 0.3 to 1.2 mm. A lock that stands back leaves more paint,
//! because paint fills the room below it. While you move the head, its locks change slowly, so that
//! furrows wander instead of repeating.
//!
//! Locks are not equally long. When you set the head down, the long ones land first. When you lift it,
//! they leave last. The hair of a fan gathers in tufts with gaps between them.

use graphics::noise::{Hills, random};
use rand::RngExt;

use super::Proportions;
use super::spines::Grip;
use crate::amount::QUANTA_PER_CELL;

/// Width of a lock in mm (chosen by eye).
const LOCK_MM: f32 = 0.5;

/// Number of locks on both sides over which we take the mean out of the noise. Without this some furrows would
/// be several locks wide.
const NEAR_LOCKS: f32 = 1.0;

/// Factor that keeps the furrows as deep after we take long waves across out of the noise.
const HIGHER: f32 = 1.3;

/// Distance in mm along a stroke over which the locks change.
const CHANGE_MM: f32 = 6.0;

/// Number of sub-steps between two changes of the locks.
const SUB_STEPS: u32 = 4;

/// Way in mm from where the longest lock lands to where the shortest does, relative to the width of the head
/// (chosen by eye).
const LANDING: f32 = 0.5;

/// Longest such way in mm.
const LANDING_MM: f32 = 5.0;

/// Way in mm that lands as many locks as pressing the head down from 0 to full pressure.
const PRESSING_MM: f32 = 20.0;

/// Way in mm over which one lock comes down.
const LANDS_MM: f32 = 0.3;

/// Pressure at which the shortest lock leaves the canvas, relative to the highest of the stroke (chosen by
/// eye).
const LEAVING: f32 = 0.8;

/// Change of pressure over which one lock leaves.
const LEAVES: f32 = 0.05;

/// Height in mm of a lock that has not landed.
const RAISED_MM: f32 = 1.5;

/// Hair that lies on the canvas, relative to the hair that gives way (chosen by the measured ends of strokes,
/// as the next two).
const LYING: f32 = 0.6;

/// Share of the lying hair that the shortest lock lacks.
const FRONT: f32 = 0.4;

/// Least length in mm of the lying hair of a lock.
const LEAST_LYING_MM: f32 = 2.2;

/// Distance in mm between the middles of two tufts of a fan (chosen by eye).
const TUFT_MM: f32 = 0.9;

/// Distance in mm along a stroke over which the tufts change (chosen by eye).
const TUFTS_CHANGE_MM: f32 = 40.0;

/// The hair of one column of paint cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Lock {
    /// Distance in quanta that the hair stands back from the surface of the head.
    pub(super) recess: i32,
    /// First row of paint cells that may lie on the canvas. Hair above it bends away.
    pub(super) front: i32,
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
    /// Whether the hair gathers in tufts.
    tufts: bool,
    /// Whether locks land, lie and leave each by its own length in this stroke.
    one_by_one: bool,
    /// Way in mm over which the locks land.
    landing_mm: f32,
    /// Length in mm of the hair that full pressure lays down.
    lying_mm: f32,
    /// Number of rows of paint cells.
    rows: f32,
    /// Length of a row in mm.
    row_mm: f32,
    stroke: Progress,
    /// Height of the noise at each column.
    heights: Vec<f32>,
    nearby: NearbyMeans,
    /// Distance along the pattern, in units of [`CHANGE_MM`].
    along: f32,
    before: Option<((i64, i64), (f32, f32))>,
    sub_steps: u32,
    pub(super) columns: Vec<Lock>,
}

impl Locks {
    /// Locks of a head `of` these proportions, `size_mm` wide, with `count` columns of paint cells, each
    /// `column_mm` wide, and `rows` rows. Heads with different seeds have different locks.
    pub(super) fn new(
        seed: u64,
        (count, rows): (usize, usize),
        column_mm: f64,
        of: &Proportions,
        (size_mm, cell_mm): (f64, f64),
    ) -> Self {
        let cell_mm = cell_mm as f32;
        let recess_mm = 0.1 * of.recess;
        let landing_mm = (LANDING * size_mm as f32).min(LANDING_MM);
        let mut locks = Self {
            hills: Hills::new(&mut random(seed, 0)),
            column: column_mm as f32 / LOCK_MM,
            cell_mm,
            most: recess_mm / cell_mm * QUANTA_PER_CELL as f32,
            variation: of.variation,
            tufts: of.gaps,
            landing_mm,
            one_by_one: false,
            stroke: Progress::default(),
            heights: vec![0.0; count],
            nearby: NearbyMeans::default(),
            rows: rows as f32,
            row_mm: of.length * size_mm as f32 / rows as f32,
            lying_mm: if of.rigid || of.spines == 1 {
                f32::INFINITY
            } else {
                LYING * of.give * of.length * size_mm as f32
            },
            along: 0.0,
            before: None,
            sub_steps: 0,
            columns: vec![Lock { recess: 0, front: 0, release: 32 << 9 }; count],
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

    /// Whether the locks of the next stroke land and leave one by one, or all at once.
    pub(super) fn land_one_by_one(&mut self, one_by_one: bool) {
        self.one_by_one = one_by_one;
    }

    /// Ends a stroke. You get other locks in the next one.
    pub(super) fn lift(&mut self) {
        self.before = None;
    }

    /// Lets the locks change while the head moves to `grip`, and returns its motion in cells. The
    /// start of a stroke decides its first locks, so if you paint a stroke again, you get the same.
    pub(super) fn follow(&mut self, grip: &Grip) -> (f32, f32) {
        let Some((origin, tip)) = self.before.replace((grip.origin, grip.tip)) else {
            let (x, y) = grip.origin;
            let fraction = u64::from(grip.tip.0.to_bits()) << 32 | u64::from(grip.tip.1.to_bits());
            let place = (x as u64).rotate_left(20) ^ (y as u64).rotate_left(40) ^ fraction;
            self.along = random(place, 1).random_range(0.0..1000.0);
            self.stroke = Progress {
                way_mm: 0.0,
                first: grip.pressure,
                now: grip.pressure,
                highest: grip.pressure,
            };
            self.sub_steps = 0;
            self.change();
            return (0.0, 0.0);
        };
        let x = moved(grip.origin.0, origin.0, grip.tip.0, tip.0);
        let y = moved(grip.origin.1, origin.1, grip.tip.1, tip.1);
        let way_mm = (x * x + y * y).sqrt() * self.cell_mm;
        let moving = self.stroke.follow(way_mm, grip.pressure, self.landing_mm) && self.one_by_one;
        self.along += way_mm / CHANGE_MM;
        self.sub_steps += 1;
        if moving || self.sub_steps.is_multiple_of(SUB_STEPS) {
            self.change();
        }
        (x, y)
    }

    /// Pressure relative to the highest so far in the stroke.
    pub(super) fn pressed(&self) -> f32 {
        self.stroke.now / self.stroke.highest
    }

    fn change(&mut self) {
        let hills = &self.hills;
        let along = self.along;
        let most = self.most;
        let quanta_a_mm = QUANTA_PER_CELL as f32 / self.cell_mm;
        let stroke = &self.stroke;
        let moving = self.one_by_one && stroke.moving(self.landing_mm);
        let lying = self.lying_mm * stroke.now / self.row_mm;
        // A slow slant keeps lattice lines of the noise from being furrows.
        let slant = 0.37 * along;
        for (column, height) in self.heights.iter_mut().enumerate() {
            let across = column as f32 * self.column + slant;
            *height = hills.at(across, along + 0.11 * across);
        }
        self.nearby.update(&self.heights, (NEAR_LOCKS / self.column) as usize);
        for (column, lock) in self.columns.iter_mut().enumerate() {
            let across = column as f32 * self.column + slant;
            let height =
                (HIGHER * (self.heights[column] - self.nearby.mean(column))).clamp(-1.0, 1.0);
            // How much shorter the lock is than the longest. Hills are within 0.6 of 0 nearly everywhere.
            let shorter = hills.at(across + 301.5, along - 0.13 * across);
            let shorter = (0.5 + 0.85 * shorter).clamp(0.0, 1.0);
            lock.front = 0;
            if self.one_by_one {
                let lies = lying * (1.0 - FRONT * shorter);
                let lies = lies.max(LEAST_LYING_MM / self.row_mm);
                lock.front = (self.rows - lies).max(0.0) as i32;
            }
            let back = 0.5 + 0.5 * height;
            let mut recess = most * back * back;
            if moving {
                recess += stroke.raised(shorter, self.landing_mm) * RAISED_MM * quanta_a_mm;
            }
            if self.tufts {
                let across = across * (LOCK_MM / TUFT_MM);
                let tuft =
                    hills.at(across + 77.7, along * (CHANGE_MM / TUFTS_CHANGE_MM) + 0.2 * across);
                recess += (-5.0 * tuft).clamp(0.0, 1.0) * RAISED_MM * quanta_a_mm;
            }
            lock.recess = recess as i32;
            let release = 32.0 * (1.0 + self.variation * height);
            lock.release = (release.clamp(1.0, 127.0) as u32) << 9;
        }
    }
}

/// Means of heights over the columns near each column around a head.
#[derive(Debug, Clone, Default)]
struct NearbyMeans {
    /// Sums of the heights before each column, from `reach` columns before the first.
    sums: Vec<f32>,
    reach: usize,
}

impl NearbyMeans {
    /// Takes means over `reach` columns on both sides, at most half of the head.
    fn update(&mut self, heights: &[f32], reach: usize) {
        self.reach = reach.min(heights.len().saturating_sub(1) / 2);
        let around = heights.iter().cycle().skip(heights.len() - self.reach);
        let mut sum = 0.0;
        self.sums.clear();
        self.sums.push(0.0);
        self.sums.extend(around.take(heights.len() + 2 * self.reach).map(|height| {
            sum += height;
            sum
        }));
    }

    fn mean(&self, column: usize) -> f32 {
        let count = 2 * self.reach + 1;
        (self.sums[column + count] - self.sums[column]) / count as f32
    }
}

/// How far a stroke has gone.
#[derive(Debug, Clone, Copy, Default)]
struct Progress {
    way_mm: f32,
    /// Pressure at its start.
    first: f32,
    /// Pressure at this moment.
    now: f32,
    /// Highest pressure so far.
    highest: f32,
}

impl Progress {
    /// Follows the hand over `way_mm` mm to this pressure. Returns whether locks land or leave meanwhile.
    fn follow(&mut self, way_mm: f32, pressure: f32, landing_mm: f32) -> bool {
        let before = self.moving(landing_mm);
        self.way_mm += way_mm;
        self.now = pressure;
        self.highest = self.highest.max(pressure);
        before || self.moving(landing_mm)
    }

    /// Whether a lock lands or leaves now.
    fn moving(&self, landing_mm: f32) -> bool {
        self.landed_mm() < landing_mm + LANDS_MM || self.now < LEAVING * self.highest
    }

    /// How far the head has landed, in mm. Pressing it down counts as well: it spreads the head.
    fn landed_mm(&self) -> f32 {
        self.way_mm + (self.highest - self.first) * PRESSING_MM
    }

    /// How far a lock is raised from the canvas, 0 to 1. `shorter` is 0 for the longest lock and 1 for the
    /// shortest.
    fn raised(&self, shorter: f32, landing_mm: f32) -> f32 {
        let lands = (shorter * landing_mm - self.landed_mm()) / LANDS_MM;
        let leaves = (shorter * LEAVING * self.highest - self.now) / LEAVES;
        lands.max(leaves).clamp(0.0, 1.0)
    }
}

#[inline(always)]
fn moved(to: i64, from: i64, to_part: f32, from_part: f32) -> f32 {
    (to - from) as f32 + to_part - from_part
}

#[cfg(test)]
mod tests {
    use super::super::HeadShape;
    use super::*;
    use crate::pose::Pose;

    fn locks(seed: u64) -> Locks {
        Locks::new(seed, (60, 60), 0.1, HeadShape::Flat.proportions(), (3.0, 0.1))
    }

    /// Moves the head from `x` on by a cell for each pressure.
    fn drag(locks: &mut Locks, x: f64, pressures: &[f64]) {
        locks.lift();
        for (step, &pressure) in pressures.iter().enumerate() {
            let pose = Pose {
                x: x + step as f64,
                y: 70.4,
                pressure,
                tilt_x_deg: 0.0,
                tilt_y_deg: 0.0,
                twist_deg: 0.0,
                speed_mm_s: 0.0,
            };
            locks.follow(&Grip::new(&pose, HeadShape::Flat.proportions()).unwrap());
        }
    }

    /// Locks after the head moved by 50 cells from `x`.
    fn after_a_stroke(mut locks: Locks, x: f64) -> Vec<Lock> {
        drag(&mut locks, x, &[0.5; 50]);
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
            let releases: Vec<u32> = locks.iter().map(|lock| lock.release >> 9).collect();
            let low = *releases.iter().min().unwrap();
            let high = *releases.iter().max().unwrap();
            assert!(low < 32 && high > 32 && high < 128, "{low} to {high}");
        }
    }

    /// Number of columns that are raised after the head moved at these pressures, a cell at a time.
    fn raised(one_by_one: bool, pressures: &[f64]) -> usize {
        let mut locks = locks(1);
        locks.land_one_by_one(one_by_one);
        drag(&mut locks, 90.3, pressures);
        let high = (0.2 / 0.1 * f64::from(QUANTA_PER_CELL)) as i32;
        locks.columns.iter().filter(|lock| lock.recess > high).count()
    }

    #[test]
    fn locks_land_and_leave_one_by_one_in_strokes_only() {
        let down = [0.5; 60];
        let lifted: Vec<f64> = down.into_iter().chain([0.2]).collect();
        assert_eq!(raised(false, &[0.5, 0.5]), 0, "set down for a tool");
        let first = raised(true, &[0.5, 0.5]);
        let later = raised(true, &[0.5; 8]);
        assert!(first > 40 && later < first && later > 5, "{first}, then {later}");
        assert_eq!(raised(true, &down), 0, "on its way");
        let left = raised(true, &lifted);
        assert!((5..55).contains(&left), "{left} have left");
    }

    #[test]
    fn waves_longer_than_the_reach_are_taken_out_around_the_head() {
        let heights: Vec<f32> = (0..40).map(|column| f32::from(u8::from(column < 20))).collect();
        let mut near = NearbyMeans::default();
        near.update(&heights, 3);
        let means: Vec<f32> = [0, 10, 18, 21, 30, 39].map(|column| near.mean(column)).into();
        let sevenths = [4.0, 7.0, 5.0, 2.0, 0.0, 3.0];
        for (mean, wanted) in means.into_iter().zip(sevenths) {
            assert!((7.0 * mean - wanted).abs() < 1e-5, "{mean}, not {wanted}/7");
        }
    }
}
