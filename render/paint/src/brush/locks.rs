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
use super::spines::{Grip, sink_mm};
use crate::amount::{QUANTA_PER_CELL, quanta_from_mm};
use crate::contact::{ExchangeRates, Wicking};

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

/// Difference in mm between the places where the first and the last lock land: at most, and relative to
/// the width of the head (chosen by eye).
const LANDING_MM: f32 = 5.0;
const LANDING: f32 = 0.5;

/// Pressure, relative to the highest of the stroke, below which the shortest lock has left the canvas
/// (chosen by eye).
const LEAVING: f32 = 0.8;

/// Length of the hair that full pressure lays down, relative to the hair that gives way. Of this, the share
/// that the shortest lock lacks, and the least length in mm (chosen by the measured ends of strokes).
const LYING: f32 = 0.6;
const FRONT: f32 = 0.4;
const LEAST_LYING_MM: f32 = 2.2;

/// Way in mm, and change of pressure, over which a lock lands or leaves.
const LANDS_MM: f32 = 0.3;
const LEAVES: f32 = 0.05;

/// Way in mm that counts as far as full pressure from none.
const PRESSING_MM: f32 = 20.0;

/// Height in mm of a lock that has not landed.
const RAISED_MM: f32 = 1.5;

/// Distance in mm between the middles of two tufts of a fan, and along a stroke over which they move
/// (chosen by eye).
const TUFT_MM: f32 = 0.9;
const TUFTS_MOVE_MM: f32 = 40.0;

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
    tufts: bool,
    /// Distance in mm over which the locks land, and whether they lie, land and leave each by its own length in
    /// this stroke.
    landing_mm: f32,
    one_by_one: bool,
    stroke: Start,
    /// Height of the noise at each column.
    heights: Vec<f32>,
    /// Number of rows of paint cells, their length in mm, and the length in mm of the hair that full
    /// pressure lays down.
    rows: f32,
    row_mm: f32,
    lying_mm: f32,
    /// Distance along the pattern, in units of [`CHANGE_MM`].
    along: f32,
    before: Option<((i64, i64), (f32, f32))>,
    sub_steps: u32,
    pub(super) columns: Vec<Lock>,
}

impl Locks {
    /// Locks of a head `of` these proportions, `size_mm` wide, with `count` columns of paint cells, each
    /// `column_mm` wide. Heads with different seeds have different locks.
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
            stroke: Start::default(),
            heights: vec![0.0; count],
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
            self.stroke = Start {
                way_mm: 0.0,
                pressure: grip.pressure,
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
        let near = Near::of(&self.heights, (NEAR_LOCKS / self.column) as usize);
        for (column, lock) in self.columns.iter_mut().enumerate() {
            let across = column as f32 * self.column + slant;
            let height = (HIGHER * (self.heights[column] - near.mean(column))).clamp(-1.0, 1.0);
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
                    hills.at(across + 77.7, along * (CHANGE_MM / TUFTS_MOVE_MM) + 0.2 * across);
                recess += (-5.0 * tuft).clamp(0.0, 1.0) * RAISED_MM * quanta_a_mm;
            }
            lock.recess = recess as i32;
            let release = 32.0 * (1.0 + self.variation * height);
            lock.release = (release.clamp(1.0, 127.0) as u32) << 9;
        }
    }
}

/// Means over the columns near each column around a head.
struct Near {
    /// Sums of the heights before each column, from `reach` columns before the first.
    sums: Vec<f32>,
    reach: usize,
}

impl Near {
    /// Means over `reach` columns on both sides, at most half of the head.
    fn of(heights: &[f32], reach: usize) -> Self {
        let reach = reach.min(heights.len().saturating_sub(1) / 2);
        let around = heights.iter().cycle().skip(heights.len() - reach);
        let mut sum = 0.0;
        let mut sums = vec![0.0];
        sums.extend(around.take(heights.len() + 2 * reach).map(|height| {
            sum += height;
            sum
        }));
        Self { sums, reach }
    }

    fn mean(&self, column: usize) -> f32 {
        let whole = 2 * self.reach + 1;
        (self.sums[column + whole] - self.sums[column]) / whole as f32
    }
}

/// How a stroke began and how far it has gone.
#[derive(Debug, Clone, Copy, Default)]
struct Start {
    way_mm: f32,
    /// Pressure at the start, now, and the highest so far.
    pressure: f32,
    now: f32,
    highest: f32,
}

impl Start {
    /// Follows the hand over `way_mm` mm to this pressure. Returns whether locks land or leave meanwhile.
    fn follow(&mut self, way_mm: f32, pressure: f32, landing_mm: f32) -> bool {
        let before = self.moving(landing_mm);
        self.way_mm += way_mm;
        self.now = pressure;
        self.highest = self.highest.max(pressure);
        before || self.moving(landing_mm)
    }

    fn moving(&self, landing_mm: f32) -> bool {
        self.landed_mm() < landing_mm + LANDS_MM || self.now < LEAVING * self.highest
    }

    /// How far the head has landed, in mm. Pressing it down counts as well: it spreads the head.
    fn landed_mm(&self) -> f32 {
        self.way_mm + (self.highest - self.pressure) * PRESSING_MM
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

/// Coat of a head, and the distances in mm over which it exchanges paint with the canvas.
struct Uptake {
    /// Thickness of the coat relative to the paint on the head: at pressure 0, and how much full
    /// pressure adds.
    coat: (f64, f64),
    /// Thickness in mm, at pressure 0, of the part of the coat that does not depend on the paint
    /// on the head.
    film_mm: f64,
    /// Velocity of the paint relative to the head's.
    drag: f64,
    /// Share of the wet paint from before the stroke that bears the head at pressure 0.
    bearing: f64,
    /// Distance over which the lack of a film thinner than the coat falls to 1/e.
    deposit_mm: f64,
    /// Distance over which the surplus of a film thicker than the coat falls to 1/e.
    pick_up_mm: f64,
    /// Distance over which the difference between the colours of head and canvas falls to 1/e.
    mixing_mm: f64,
    /// Distance over which the hair stirs 1 - 1/e of a skin into the body that it reaches.
    shear_mm: f64,
    /// Distance over which the differences of paint along a hair fall to 1/e.
    wicking_mm: f64,
    /// Distance between two flows of paint over the head.
    wicking_every_mm: f64,
    /// Number of flows until all hairs have had their turn. If all hairs filled at once, a stroke
    /// would show beads.
    turns: u32,
    /// Width of the groups of hairs that level together. 0 if each hair levels alone.
    spread_mm: f64,
}

/// We chose these by the measured thickness of films. For example, a flat at middle pressure leaves
/// a film of 0.2 times its load.
const HAIR: Uptake = Uptake {
    coat: (0.1, 0.56),
    film_mm: 0.0,
    drag: 0.375,
    bearing: 1.0,
    deposit_mm: 0.5,
    pick_up_mm: 5.0,
    mixing_mm: 9.0,
    shear_mm: 600.0,
    wicking_mm: 1.5,
    wicking_every_mm: 0.4,
    turns: 4,
    spread_mm: 0.0,
};

/// A blade scrapes off the paint higher than its edge, carries it as a bank that rolls along the
/// edge, and lays a film from it. We chose these by the measured evenness of films.
const BLADE: Uptake = Uptake {
    coat: (0.02, -0.02),
    film_mm: 0.12,
    drag: 0.375,
    bearing: 0.0,
    deposit_mm: 0.2,
    pick_up_mm: 0.2,
    mixing_mm: 0.7,
    shear_mm: 20.0,
    wicking_mm: 0.1,
    wicking_every_mm: 0.2,
    turns: 1,
    spread_mm: 1.5,
};

/// Pressure from which a loaded blade cuts into wet paint. Held more lightly by this much, it rides on it
/// (chosen by eye).
const CUTS: f64 = 0.45;
const CUTS_OVER: f64 = 0.15;

/// Height of the wet paint on which a loaded blade rides, relative to the bank that it came with, and how much
/// its film is thicker then (chosen by the measured lightness of white on wet red).
const CARRIED: f64 = 0.5;
const BANK_FILM: f64 = 0.08;

/// Pressure at which a blade scrapes down to the ground.
const SCRAPES: f64 = 0.85;

/// Thickness in mm of the paint that hair keeps: a lock with less lays nothing. Locks keep 0.4 to 1.6
/// times as much (chosen by eye).
const HELD_MM: f64 = 0.01;

/// Speed in mm/s above which a hand leaves less paint, and the increase of speed that doubles what the
/// hair keeps and halves how deep it sinks between threads (chosen by eye: a fast brush skips).
const SLOW: f64 = 100.0;
const FASTER: f64 = 300.0;

/// Length in mm of the part of a blade, from its edge, that carries paint.
const BANK_MM: f64 = 3.0;

fn uptake(of: &Proportions) -> &'static Uptake {
    if of.rigid { &BLADE } else { &HAIR }
}

/// Share of a difference that is gone after `distance_mm` if it falls to 1/e over `fall_mm`, in
/// parts of 65536.
pub(super) fn share(distance_mm: f64, fall_mm: f64) -> u32 {
    ((1.0 - libm::exp(-distance_mm / fall_mm)) * 65536.0) as u32
}

/// Rates of a head at `pressure` (0 to 1) and speed in a sub-step of one cell of `cell_mm` mm. A blade came with
/// a bank of `bank_mm` mm.
/// `paint_cell_area` is the area of a cell of the head in cells of the canvas.
pub(super) fn rates(
    of: &Proportions,
    (pressure, speed_mm_s): (f32, f64),
    bank_mm: f64,
    cell_mm: f64,
    paint_cell_area: f64,
) -> ExchangeRates {
    let uptake = uptake(of);
    let coat = (uptake.coat.0 + uptake.coat.1 * f64::from(pressure)) / paint_cell_area;
    let fast = 1.0 + (speed_mm_s - SLOW).max(0.0) / FASTER;
    let sink_mm = if of.rigid { 0.0 } else { f64::from(sink_mm(pressure)) / fast };
    // A blade bends under pressure, which narrows its gap.
    let held_mm = if of.rigid { 0.0 } else { HELD_MM * fast / paint_cell_area };
    let film_mm = uptake.film_mm * (1.0 - f64::from(pressure) / SCRAPES).max(0.0).powi(3);
    let pressed = f64::from(pressure);
    let light = ((CUTS - pressed) / CUTS_OVER).clamp(0.0, 1.0);
    let (bearing, carried_mm, film_mm) = if of.rigid && bank_mm > 0.0 {
        (light, CARRIED * bank_mm, film_mm + light * BANK_FILM * bank_mm)
    } else {
        (uptake.bearing * (1.0 - pressed), 0.0, film_mm)
    };
    ExchangeRates {
        release: (coat.min(1.0) * 65536.0) as u32,
        film: quanta_from_mm(film_mm, cell_mm),
        deposit: share(cell_mm, uptake.deposit_mm),
        pick_up: share(cell_mm, uptake.pick_up_mm),
        mixing: share(cell_mm, uptake.mixing_mm),
        sink: quanta_from_mm(sink_mm, cell_mm),
        drag: (256.0 * uptake.drag) as u32,
        bearing: (65536.0 * bearing) as u32,
        carried: quanta_from_mm(carried_mm, cell_mm),
        shear: share(cell_mm, uptake.shear_mm),
        held: quanta_from_mm(held_mm, cell_mm),
        padding: 0,
    }
}

/// Length of hair in mm above which paint flows along it less often, in inverse proportion to its
/// length. A stroke takes paint from the tip, which changes the mean of long hair less, and the
/// coat follows this mean.
const LONG_HAIR_MM: f64 = 20.0;

/// Number of rows of paint cells, from the tip, that hold the paint of a head: all `rows` for hair,
/// only the bank at the edge for a blade. A row is `row_mm` long.
pub(super) fn rows_with_paint(of: &Proportions, rows: usize, row_mm: f64) -> usize {
    if of.rigid { ((BANK_MM / row_mm).ceil() as usize).clamp(1, rows) } else { rows }
}

/// Flow of paint over a head before the sub-step number `sub_step` of a stroke. In most sub-steps
/// there is none. The head has `rows` rows of paint cells. `cell_mm` is the width of its cells and
/// of the cells of the canvas.
pub(super) fn wicking(of: &Proportions, sub_step: u32, rows: usize, cell_mm: f64) -> Wicking {
    let uptake = uptake(of);
    let with_paint = rows_with_paint(of, rows, cell_mm);
    let longer = (with_paint as f64 * cell_mm / LONG_HAIR_MM).max(1.0);
    let between = ((uptake.wicking_every_mm * longer / cell_mm).round() as u32).max(1);
    if !sub_step.is_multiple_of(between) {
        return Wicking::default();
    }
    // Sums over a group must fit into 32 bits.
    let most = 2048.0 / with_paint as f64;
    let hairs = (uptake.spread_mm / cell_mm).min(most).max(1.0) as u32;
    let flow = sub_step / between;
    let odd = flow % 2 == 1;
    // All hairs take part in the first flow.
    let turns = if flow == 0 { 1 } else { uptake.turns };
    Wicking {
        share: share(cell_mm * f64::from(between * uptake.turns), uptake.wicking_mm),
        first_row: (rows - with_paint) as u32,
        hairs,
        shift: if odd { hairs / 2 } else { 0 },
        turns,
        turn: flow % turns,
    }
}

#[cfg(test)]
mod tests {
    use super::super::HeadShape;
    use super::*;
    use crate::pose::Pose;

    fn locks(seed: u64) -> Locks {
        Locks::new(seed, (60, 60), 0.1, HeadShape::Flat.proportions(), (3.0, 0.1))
    }

    /// Locks after the head moved by 50 cells from `x`.
    fn after_a_stroke(mut locks: Locks, x: f64) -> Vec<Lock> {
        locks.lift();
        for step in 0..50 {
            let x = x + f64::from(step);
            let pressure = 0.5;
            let pose = Pose {
                x,
                y: 70.4,
                pressure,
                tilt_x_deg: 0.0,
                tilt_y_deg: 0.0,
                twist_deg: 0.0,
                speed_mm_s: 0.0,
            };
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
        locks.lift();
        for (step, &pressure) in pressures.iter().enumerate() {
            let pose = Pose {
                x: 90.3 + step as f64,
                y: 70.4,
                pressure,
                tilt_x_deg: 0.0,
                tilt_y_deg: 0.0,
                twist_deg: 0.0,
                speed_mm_s: 0.0,
            };
            locks.follow(&Grip::new(&pose, HeadShape::Flat.proportions()).unwrap());
        }
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
    fn a_fast_hand_and_dry_hair_leave_less() {
        let of = HeadShape::Flat.proportions();
        let [slow, fast] = [60.0, 1000.0].map(|speed| rates(of, (0.5, speed), 0.0, 0.1, 1.0));
        assert_eq!(slow, rates(of, (0.5, 0.0), 0.0, 0.1, 1.0), "no hand is slower than slow");
        assert!(fast.held.abs_diff(4 * slow.held) < 4 && fast.sink < slow.sink, "{fast:?}");
    }

    /// Bearing of a blade, and height up to which it is borne.
    fn borne(pressure: f32, bank_mm: f64) -> (u32, u32) {
        let of = HeadShape::Knife.proportions();
        let found = rates(of, (pressure, 0.0), bank_mm, 0.1, 1.0);
        (found.bearing, found.carried)
    }

    #[test]
    fn a_loaded_blade_held_lightly_is_borne_by_wet_paint() {
        assert_eq!(borne(0.3, 0.0), (0, 0), "a clean blade");
        assert_eq!(borne(0.5, 2.0).0, 0, "pressed down");
        assert!(borne(0.3, 2.0).0 > 65_000, "held lightly");
        assert_eq!(borne(0.3, 2.0).1, quanta_from_mm(1.0, 0.1));
    }

    #[test]
    fn waves_longer_than_the_reach_are_taken_out_around_the_head() {
        let heights: Vec<f32> = (0..40).map(|column| f32::from(u8::from(column < 20))).collect();
        let near = Near::of(&heights, 3);
        let means: Vec<f32> = [0, 10, 18, 21, 30, 39].map(|column| near.mean(column)).into();
        let sevenths = [4.0, 7.0, 5.0, 2.0, 0.0, 3.0];
        for (mean, wanted) in means.into_iter().zip(sevenths) {
            assert!((7.0 * mean - wanted).abs() < 1e-5, "{mean}, not {wanted}/7");
        }
    }
}
