//! Exchange of paint between a head and the canvas: rates by pressure and speed, and the flow of paint over the
//! head.

use super::Proportions;
use super::spines::sink_mm;
use crate::amount::quanta_from_mm;
use crate::contact::{ExchangeRates, Wicking};

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

/// Pressure from which a loaded blade cuts through wet paint down to the ground (chosen by eye).
const CUTS: f64 = 0.45;

/// Pressure up to which a loaded blade rides on wet paint. Between the two it sinks in (chosen by eye).
const RIDES: f64 = 0.3;

/// Height of the wet paint on which a loaded blade rides, relative to the mean of its own paint when the stroke
/// began (chosen by the measured lightness of white on wet red).
const CARRIED: f64 = 0.5;

/// Thickness that the film of a riding blade gains, relative to the same mean (chosen by the same).
const BANK_FILM: f64 = 0.08;

/// Pressure at which a blade scrapes down to the ground.
const SCRAPES: f64 = 0.85;

/// Thickness in mm of the paint that hair keeps: a lock with less lays nothing. Locks keep 0.4 to 1.6
/// times as much (chosen by eye).
const HELD_MM: f64 = 0.01;

/// Speed in mm/s up to which it does not matter how fast the hand is (chosen by eye).
const SLOW: f64 = 100.0;

/// Speed in mm/s above [`SLOW`] at which hair keeps twice as much paint and sinks half as deep between threads
/// (chosen by eye: a fast brush skips).
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

/// Rates of a head at `pressure` (0 to 1) and speed in a sub-step of one cell of `cell_mm` mm. `bank_mm` is the
/// mean height of the paint with which a blade began the stroke. `paint_cell_area` is the area of a cell of the
/// head in cells of the canvas.
pub(super) fn rates(
    of: &Proportions,
    (pressure, speed_mm_s): (f32, f64),
    bank_mm: f64,
    cell_mm: f64,
    paint_cell_area: f64,
) -> ExchangeRates {
    let uptake = uptake(of);
    let fast = 1.0 + (speed_mm_s - SLOW).max(0.0) / FASTER;
    let sink_mm = if of.rigid { 0.0 } else { f64::from(sink_mm(pressure)) / fast };
    let held_mm = if of.rigid { 0.0 } else { HELD_MM * fast / paint_cell_area };
    let pressure = f64::from(pressure);
    let coat = (uptake.coat.0 + uptake.coat.1 * pressure) / paint_cell_area;
    // A blade bends under pressure, which narrows its gap.
    let mut film_mm = uptake.film_mm * (1.0 - pressure / SCRAPES).max(0.0).powi(3);
    let mut bearing = uptake.bearing * (1.0 - pressure);
    let mut carried_mm = 0.0;
    if of.rigid && bank_mm > 0.0 {
        bearing = ((CUTS - pressure) / (CUTS - RIDES)).clamp(0.0, 1.0);
        carried_mm = CARRIED * bank_mm;
        film_mm += bearing * BANK_FILM * bank_mm;
    }
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
}
