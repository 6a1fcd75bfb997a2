//! A script as actions in time.

use super::action::{Action, Dry, Lift, NewVolume, PathPoint, Place, Pour, Push, Quantity, Split};
use super::file::Script;
use super::rows::{Ball, Row};
use crate::toml_text::KeyPath;
use crate::world::STEPS_PER_SECOND;

/// An action, and when it happens.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// The action begins before this step. Steps count from 0.
    pub start: u32,
    /// The action ends before this step. It is above `start`, so actions of a moment last one
    /// step.
    pub end: u32,
    /// The action.
    pub action: Action,
    /// Path of its table in the script. Faults show this.
    pub table: KeyPath,
}

/// Number of steps nearest to a time of at least 0 s.
#[must_use]
pub fn steps_of(seconds: f64) -> u32 {
    (seconds * f64::from(STEPS_PER_SECOND)).round() as u32
}

/// Time of a step in seconds.
#[must_use]
pub fn seconds_of(steps: u32) -> f64 {
    f64::from(steps) / f64::from(STEPS_PER_SECOND)
}

impl Script {
    /// All actions. We sort them by the step in which they begin, then in the order of [`Action`],
    /// then as in the script. First [`Script::check`] the script.
    #[must_use]
    pub fn events(&self) -> Vec<Event> {
        let mut events = Vec::new();
        let mut add = |name: &str, index: usize, [from, duration]: [f64; 2], action: Action| {
            let start = steps_of(from);
            let end = start + steps_of(duration).max(1);
            events.push(Event { start, end, action, table: KeyPath::of(name).index(index) });
        };
        for (index, table) in self.volumes.iter().enumerate() {
            let volume = NewVolume {
                center: table.center.0,
                radius: table.radius,
                detail: table.detail,
                recipe: table.recipe.clone(),
                region: self.region_index(table.region.as_deref()).unwrap_or(0),
            };
            add("volume", index, [table.from_s, 0.0], Action::Volume(volume));
        }
        for (index, table) in self.pours.iter().enumerate() {
            let pour = Pour {
                place: place(table.at, table.picked, &table.path),
                quantity: quantity(table.amount_mm3, table.rate_mm3_s),
                recipe: table.recipe.clone(),
                region: self.region_index(table.region.as_deref()).unwrap_or(0),
            };
            add("pour", index, [table.from_s, table.for_s], Action::Pour(pour));
        }
        for (index, table) in self.pushes.iter().enumerate() {
            let at = table.at.0;
            let towards = table.towards.0;
            let push = Push { at, towards, radius: table.radius, strength: table.strength };
            add("push", index, [table.from_s, table.for_s], Action::Push(push));
        }
        for (index, table) in self.lifts.iter().enumerate() {
            let lift = Lift {
                place: place(table.at, table.picked, &table.path),
                radius: table.radius,
                rate: table.rate,
            };
            add("lift", index, [table.from_s, table.for_s], Action::Lift(lift));
        }
        for (index, table) in self.splits.iter().enumerate() {
            let volume = table.volume.map(|number| number.saturating_sub(1) as usize);
            add("split", index, [table.at_s, 0.0], Action::Split(Split { volume }));
        }
        for (index, table) in self.dries.iter().enumerate() {
            let ball = table.at.zip(table.radius);
            let ball = ball.map(|(Row(center), radius)| Ball { center, radius });
            add("dry", index, [table.at_s, 0.0], Action::Dry(Dry { ball }));
        }
        events.sort_by_key(|event| (event.start, event.action.rank()));
        events
    }
}

fn place(at: Option<Row<3>>, picked: Option<Row<2>>, path: &[Row<4>]) -> Place {
    if !path.is_empty() {
        return Place::Path(
            path.iter()
                .map(|&Row([seconds, x, y, z]): &Row<4>| PathPoint { seconds, at: [x, y, z] })
                .collect(),
        );
    }
    match picked {
        Some(Row(picked)) => Place::Picked(picked),
        None => Place::At(at.map(|Row(at)| at).unwrap_or_default()),
    }
}

fn quantity(amount: Option<f64>, rate: Option<f64>) -> Quantity {
    match rate {
        Some(rate) => Quantity::Rate(rate),
        None => Quantity::Amount(amount.unwrap_or(0.0)),
    }
}
