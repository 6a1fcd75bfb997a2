//! Shares of pigments, and whole quanta of each pigment in an amount of paint with these shares.
//! Also tracks, which say where a moving source is at each time.

use glam::Vec3;
use paint::amount::MAX_COLUMN;
use paint::layer::{Cell, SLOTS};

use super::settings::WorldError;
use crate::saved::{Reader, Stored, stored};

/// Shares of the paints of eight slots and of vehicle. They sum to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recipe {
    shares: [f64; SLOTS + 1],
}

impl Recipe {
    /// The recipe with these parts. You give the parts of the pigments by slot, and then of
    /// vehicle. For example, two equal parts give half of each.
    ///
    /// # Errors
    /// If a part is below 0 or not finite, or none is above 0.
    pub fn of_parts(parts: [f64; SLOTS + 1]) -> Result<Self, WorldError> {
        let sum: f64 = parts.iter().sum();
        let valid = parts.iter().all(|part| *part >= 0.0) && sum.is_finite() && sum > 0.0;
        if !valid {
            return Err(WorldError::Recipe(parts.to_vec()));
        }
        Ok(Self { shares: parts.map(|part| part / sum) })
    }

    /// The paint of one slot alone.
    ///
    /// # Panics
    /// If `slot` is 8 or more.
    #[must_use]
    pub fn of_slot(slot: usize) -> Self {
        assert!(slot < SLOTS, "a layer has {SLOTS} slots");
        let mut shares = [0.0; SLOTS + 1];
        shares[slot] = 1.0;
        Self { shares }
    }

    pub(super) fn measured(&self, amount: u32) -> Cell {
        let mut measured = Measured::default();
        as_cell(measured.up_to(self, f64::from(amount), true))
    }
}

/// Amounts of a recipe that we have measured out so far, in quanta.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Measured {
    given: [u64; SLOTS + 1],
}

impl Measured {
    /// Amounts to add so that `amount` quanta have been given in all. We round each paint's share
    /// down and carry the rest. At the `end` the rest goes to the greatest share.
    pub(super) fn up_to(&mut self, recipe: &Recipe, amount: f64, end: bool) -> [u64; SLOTS + 1] {
        let mut due = recipe.shares.map(|share| (share * amount) as u64);
        if end {
            let rest = (amount.round() as u64).saturating_sub(due.iter().sum());
            due[(0..=SLOTS).fold(0, |most, i| {
                if recipe.shares[i] > recipe.shares[most] { i } else { most }
            })] += rest;
        }
        let mut added = [0; SLOTS + 1];
        for ((added, due), given) in added.iter_mut().zip(due).zip(&mut self.given) {
            *added = due.saturating_sub(*given);
            *given += *added;
        }
        added
    }
}

stored!(Recipe { shares });
stored!(Measured { given });

/// These amounts as a cell. It holds no more than a column of paint.
pub(super) fn as_cell(amounts: [u64; SLOTS + 1]) -> Cell {
    fn amount(value: u64) -> u32 {
        value.min(u64::from(MAX_COLUMN)) as u32
    }
    let mut cell = Cell { vehicle: amount(amounts[SLOTS]), ..Cell::default() };
    for (own, value) in cell.pigments.iter_mut().zip(amounts) {
        *own = amount(value);
    }
    cell
}

pub(super) fn amounts_of(cell: &Cell) -> [u64; SLOTS + 1] {
    std::array::from_fn(|i| u64::from(cell.pigments.get(i).copied().unwrap_or(cell.vehicle)))
}

/// The part of `amounts` that fits into `room` quanta. Each is in proportion and rounded down.
pub(super) fn fitting(amounts: [u64; SLOTS + 1], room: u32) -> [u64; SLOTS + 1] {
    let sum: u64 = amounts.iter().sum();
    let room = u64::from(room);
    if sum <= room {
        return amounts;
    }
    amounts.map(|amount| (u128::from(amount) * u128::from(room) / u128::from(sum)) as u64)
}

/// A place, or places at times with straight lines between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    knots: Vec<(f64, Vec3)>,
}

impl Track {
    /// A place that stays, in the unit of the scene.
    #[must_use]
    pub fn at(place: Vec3) -> Self {
        Self { knots: vec![(0.0, place)] }
    }

    /// Places (in the unit of the scene) at rising times in seconds. Before the first and after
    /// the last time, the place stays.
    ///
    /// # Errors
    /// If there is no place, a number is not finite, or the times do not rise.
    pub fn along(knots: Vec<(f64, Vec3)>) -> Result<Self, WorldError> {
        fn number(key: &'static str, found: f64) -> Result<Track, WorldError> {
            Err(WorldError::Number { key, range: "finite and rising", found })
        }
        let mut last = f64::NEG_INFINITY;
        for (seconds, place) in &knots {
            if !(seconds.is_finite() && *seconds > last) {
                return number("a time of the path", *seconds);
            }
            if !place.is_finite() {
                return number("a place of the path", f64::from(place.element_sum()));
            }
            last = *seconds;
        }
        if knots.is_empty() {
            return number("a path without places", f64::NAN);
        }
        Ok(Self { knots })
    }

    /// The place after `seconds`.
    #[must_use]
    pub fn after(&self, seconds: f64) -> Vec3 {
        let next = self.knots.partition_point(|(time, _)| *time <= seconds);
        match (next.checked_sub(1).map(|last| self.knots[last]), self.knots.get(next)) {
            (Some((from, a)), Some((to, b))) => {
                a + (*b - a) * ((seconds - from) / (to - from)) as f32
            }
            (Some((_, place)), None) => place,
            (None, first) => first.map_or(Vec3::ZERO, |(_, place)| *place),
        }
    }

    /// The places at which it turns.
    pub fn places(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.knots.iter().map(|(_, place)| *place)
    }
}

impl Stored for Track {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.knots.store(bytes);
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Self::along(Stored::read(from)?).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_measured_out_in_parts_adds_up() {
        let recipe = Recipe::of_parts([1.0, 2.0, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0, 0.7]).unwrap();
        let mut measured = Measured::default();
        let mut sums = [0; SLOTS + 1];
        for step in 1..=1000 {
            let amount = 12_345.678 * f64::from(step);
            for (sum, added) in sums.iter_mut().zip(measured.up_to(&recipe, amount, step == 1000)) {
                *sum += added;
            }
            let behind = amount - sums.iter().sum::<u64>() as f64;
            assert!((-0.5..4.0).contains(&behind), "{behind} at {step}");
        }
        assert_eq!(sums.iter().sum::<u64>(), 12_345_678);
        assert!(sums[1].abs_diff(2 * 12_345_678 / 4) <= 4);
        assert_eq!(recipe.measured(1_000_003).volume(), 1_000_003);
    }

    #[test]
    fn recipes_without_paint_are_refused() {
        for parts in [[0.0; 9], [-1.0; 9], [f64::NAN; 9], [f64::INFINITY; 9]] {
            assert!(matches!(Recipe::of_parts(parts), Err(WorldError::Recipe(..))));
        }
    }

    #[test]
    fn what_does_not_fit_is_cut_in_proportion() {
        let amounts = [10, 20, 30, 0, 0, 0, 0, 0, 40];
        assert_eq!(fitting(amounts, 100), amounts);
        assert_eq!(fitting(amounts, 50), [5, 10, 15, 0, 0, 0, 0, 0, 20]);
        assert_eq!(fitting(amounts, 0), [0; 9]);
        assert_eq!(amounts_of(&as_cell(amounts)), amounts);
    }

    #[test]
    fn a_track_stays_before_and_after_its_times() {
        let track = Track::along(vec![(1.0, Vec3::X), (3.0, Vec3::Y)]).unwrap();
        for (seconds, place) in [(0.0, Vec3::X), (2.0, (Vec3::X + Vec3::Y) / 2.0), (9.0, Vec3::Y)] {
            assert_eq!(track.after(seconds), place);
        }
        for times in [vec![], vec![1.0, 1.0], vec![f64::NAN]] {
            let knots = times.into_iter().map(|time| (time, Vec3::ZERO)).collect();
            assert!(Track::along(knots).is_err());
        }
    }
}
