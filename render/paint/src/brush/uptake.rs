//! How a head gives and takes paint, in mm.

use super::hair::sink_mm;
use super::shape::Proportions;
use crate::amount::quanta_from_mm;
use crate::contact::ExchangeRates;

/// Distance in mm that a head moves between two flows of paint along its hair.
const WICKING_EVERY_MM: f64 = 1.6;

/// Coat of a head, and the distances in mm that it moves while differences between head and canvas
/// fall to 1/e.
struct Uptake {
    /// Thickness of the coat relative to that of the paint on the head: at pressure 0, and how
    /// much full pressure adds.
    coat: (f64, f64),
    /// Thickness in mm, at pressure 0, of the film that the head leaves whatever it holds.
    film_mm: f64,
    /// Velocity of the paint relative to that of the head.
    drag: f64,
    /// For a film thinner than the coat.
    deposit_mm: f64,
    /// For a film thicker than the coat.
    pick_up_mm: f64,
    /// For the colours of both sides.
    mixing_mm: f64,
    /// For the paint along a hair.
    wicking_mm: f64,
}

/// Chosen by the measured thickness of films (0.2 of the load of a flat at middle pressure).
const HAIR: Uptake = Uptake {
    coat: (0.1, 0.56),
    film_mm: 0.0,
    drag: 0.375,
    deposit_mm: 0.5,
    pick_up_mm: 5.0,
    mixing_mm: 6.0,
    wicking_mm: 1.5,
};

/// A blade rides on the paint unless it is pressed, and takes up what it does not leave.
const BLADE: Uptake = Uptake {
    coat: (0.1, 0.1),
    film_mm: 0.35,
    drag: 0.375,
    deposit_mm: 0.5,
    pick_up_mm: 0.5,
    mixing_mm: 0.7,
    wicking_mm: 300.0,
};

/// Pressure at which a blade scrapes down to the ground.
const SCRAPES: f64 = 0.85;

fn uptake(of: &Proportions) -> &'static Uptake {
    if of.rigid { &BLADE } else { &HAIR }
}

/// Share of a difference that is gone after `distance_mm` if it falls to 1/e over `fall_mm`, in
/// parts of 65536.
fn share(distance_mm: f64, fall_mm: f64) -> u32 {
    ((1.0 - (-distance_mm / fall_mm).exp()) * 65536.0) as u32
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
    let film_mm = uptake.film_mm * (1.0 - f64::from(pressure) / SCRAPES).max(0.0);
    ExchangeRates {
        release: (coat.min(1.0) * 65536.0) as u32,
        film: quanta_from_mm(film_mm, cell_mm),
        deposit: share(cell_mm, uptake.deposit_mm),
        pick_up: share(cell_mm, uptake.pick_up_mm),
        mixing: share(cell_mm, uptake.mixing_mm),
        sink: quanta_from_mm(sink_mm, cell_mm),
        drag: (256.0 * uptake.drag) as u32,
        padding: 0,
    }
}

/// Share of the differences along the hair that flows off before the sub-step number `sub_step`
/// of a stroke, in parts of 65536; 0 in most sub-steps.
pub(super) fn wicking(of: &Proportions, sub_step: u32, cell_mm: f64) -> u32 {
    let between = ((WICKING_EVERY_MM / cell_mm).round() as u32).max(1);
    if sub_step.is_multiple_of(between) {
        share(cell_mm * f64::from(between), uptake(of).wicking_mm)
    } else {
        0
    }
}
