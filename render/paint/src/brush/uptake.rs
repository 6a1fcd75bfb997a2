//! How a head gives and takes paint, in mm.

use super::hair::sink_mm;
use super::shape::Proportions;
use crate::amount::quanta_from_mm;
use crate::contact::{ExchangeRates, Wicking};

/// Coat of a head, and the distances in mm that it moves while differences between head and canvas
/// fall to 1/e.
struct Uptake {
    /// Thickness of the coat relative to that of the paint on the head: at pressure 0, and how
    /// much full pressure adds.
    coat: (f64, f64),
    /// Thickness in mm, at pressure 0, of the part of the coat that does not depend on the paint
    /// on the head.
    film_mm: f64,
    /// Velocity of the paint relative to that of the head.
    drag: f64,
    /// Share of the wet paint from before the stroke that bears the head at pressure 0.
    bearing: f64,
    /// For a film thinner than the coat.
    deposit_mm: f64,
    /// For a film thicker than the coat.
    pick_up_mm: f64,
    /// For the colours of both sides.
    mixing_mm: f64,
    /// For the paint along a hair.
    wicking_mm: f64,
    /// Distance between two flows of paint over the head.
    wicking_every_mm: f64,
    /// Number of flows in which all hairs have their turn, so that they do not fill in step, which
    /// would leave beads along a stroke.
    turns: u32,
    /// Width of the groups of hairs that level together; 0 if each hair levels alone.
    spread_mm: f64,
}

/// Chosen by the measured thickness of films (0.2 of the load of a flat at middle pressure).
const HAIR: Uptake = Uptake {
    coat: (0.1, 0.56),
    film_mm: 0.0,
    drag: 0.375,
    bearing: 1.0,
    deposit_mm: 0.5,
    pick_up_mm: 5.0,
    mixing_mm: 9.0,
    wicking_mm: 1.5,
    wicking_every_mm: 0.4,
    turns: 4,
    spread_mm: 0.0,
};

/// A blade scrapes off what lies higher than its edge, carries it as a bank that rolls along the
/// edge, and lays a film from it. Chosen by the measured evenness of films.
const BLADE: Uptake = Uptake {
    coat: (0.02, -0.02),
    film_mm: 0.12,
    drag: 0.375,
    bearing: 0.0,
    deposit_mm: 0.2,
    pick_up_mm: 0.2,
    mixing_mm: 0.7,
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
    }
}

/// Length of hair in mm beyond which paint flows along it less often, in proportion: on long hair,
/// the paint that a stroke takes from the tip changes the mean that the coat follows less.
const LONG_HAIR_MM: f64 = 20.0;

/// Number of rows of paint cells, from the tip, that hold the paint of a head: all `rows` of hair,
/// the bank at the edge of a blade. A row is `row_mm` long.
pub(super) fn rows_with_paint(of: &Proportions, rows: usize, row_mm: f64) -> usize {
    if of.rigid { ((BANK_MM / row_mm).ceil() as usize).clamp(1, rows) } else { rows }
}

/// Flow of paint over a head before the sub-step number `sub_step` of a stroke; none in most
/// sub-steps. The head has `rows` rows of paint cells; `cell_mm` is the width of its cells and of
/// those of the canvas.
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
    // The first flow is that of all hairs.
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
