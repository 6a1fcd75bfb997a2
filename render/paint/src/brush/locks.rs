//! Locks of hair: how far the hair of each column stands back, and how much paint it leaves and
//! takes.
//!
//! Bristles cling together in locks of 0.3 to 1.2 mm. A lock that stands back leaves more paint,
//! because paint fills the room below it. While you move the head, its locks change slowly, so that
//! furrows wander instead of repeating.

use graphics::noise::{Hills, random};
use rand::RngExt;

use super::Proportions;
use super::spines::{Grip, sink_mm};
use crate::amount::{QUANTA_PER_CELL, quanta_from_mm};
use crate::contact::{ExchangeRates, Wicking};

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
            self.sub_steps = 0;
            self.change();
            return (0.0, 0.0);
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

/// Pressure at which a blade scrapes down to the ground.
const SCRAPES: f64 = 0.85;

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

/// Rates of a head at `pressure` (0 to 1) in a sub-step of one cell of `cell_mm` mm.
/// `paint_cell_area` is the area of a cell of the head in cells of the canvas.
pub(super) fn rates(
    of: &Proportions,
    pressure: f32,
    cell_mm: f64,
    paint_cell_area: f64,
) -> ExchangeRates {
    let uptake = uptake(of);
    let coat = (uptake.coat.0 + uptake.coat.1 * f64::from(pressure)) / paint_cell_area;
    let sink_mm = if of.rigid { 0.0 } else { f64::from(sink_mm(pressure)) };
    // A blade bends under pressure, which narrows its gap.
    let film_mm = uptake.film_mm * (1.0 - f64::from(pressure) / SCRAPES).max(0.0).powi(3);
    ExchangeRates {
        release: (coat.min(1.0) * 65536.0) as u32,
        film: quanta_from_mm(film_mm, cell_mm),
        deposit: share(cell_mm, uptake.deposit_mm),
        pick_up: share(cell_mm, uptake.pick_up_mm),
        mixing: share(cell_mm, uptake.mixing_mm),
        sink: quanta_from_mm(sink_mm, cell_mm),
        drag: (256.0 * uptake.drag) as u32,
        bearing: (65536.0 * uptake.bearing * (1.0 - f64::from(pressure))) as u32,
        shear: share(cell_mm, uptake.shear_mm),
        padding: [0; 3],
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
        Locks::new(seed, 60, 0.1, (0.05, 0.6), 0.1)
    }

    /// Locks after the head moved by 50 cells from `x`.
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
            let releases: Vec<u32> = locks.iter().map(|lock| lock.release >> 9).collect();
            let low = *releases.iter().min().unwrap();
            let high = *releases.iter().max().unwrap();
            assert!(low < 32 && high > 32 && high < 128, "{low} to {high}");
        }
    }
}
