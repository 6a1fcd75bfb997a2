//! Gestures of the hand as actions of the script.
//!
//! A script tells how long an action lasts before it begins, a hand does not. So a gesture is a
//! row of short actions of fixed length, one after the other while the pen is down: what is shown
//! while the hand works is what the script plays, to the bit. The last of them ends at most
//! [`PORTION`] steps after the pen was lifted.

use glam::DVec3;
use volumes::script::{Action, Ball, Dry, Lift, Place, Pour, Push, Quantity, Recipe};

use super::tool::{Grip, SceneTool};

/// Steps that each action of a gesture lasts: a twentieth of a second.
pub(super) const PORTION: u32 = 6;

/// Least rate of a pour in mm3 a second: a pen that hardly presses pours nothing.
const LEAST_RATE: f64 = 0.01;

/// Acceleration of the air at full strength, in cells a square second.
const WIND: f64 = 200.0;

/// Share of the paint that a sponge takes up in a second at full strength.
const SOAKS: f64 = 24.0;

/// Shortest way that the air is drawn, by the radius of its ball: below, it has no direction.
const LEAST_WAY: f64 = 0.01;

/// An action with the steps at which it begins and ends.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Timed {
    /// The first step.
    pub(super) start: u32,
    /// Step before which it ends.
    pub(super) end: u32,
    /// The action, with the digits of a file.
    pub(super) action: Action,
}

/// Way after which a dryer dries again, by its radius.
const DRYING_WAY: f64 = 0.25;

/// A tool that is held down.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Hand {
    grip: Grip,
    /// Paint of the tube in hand.
    recipe: Recipe,
    /// Length of a unit of the scene in mm.
    unit_mm: f64,
    place: DVec3,
    pressure: f64,
    /// Place of the last action; none before the first.
    last: Option<DVec3>,
    /// Step at which the next action begins.
    next: u32,
}

impl Hand {
    /// A tool set down on the surface before step `step`.
    pub(super) fn down(
        grip: Grip,
        recipe: Recipe,
        unit_mm: f64,
        (place, pressure): (DVec3, f64),
        step: u32,
    ) -> Self {
        Self { grip, recipe, unit_mm, place, pressure, last: None, next: step }
    }

    /// Moves it on the surface.
    pub(super) fn move_to(&mut self, place: DVec3, pressure: f64) {
        (self.place, self.pressure) = (place, pressure);
    }

    /// The action that begins before step `step`, if one does. To be called before each step.
    pub(super) fn next_action(&mut self, step: u32) -> Option<Timed> {
        if step < self.next {
            return None;
        }
        let action = self.action()?.rounded();
        self.last = Some(self.place);
        let length = if matches!(action, Action::Dry(_)) { 1 } else { PORTION };
        self.next = step + length;
        Some(Timed { start: step, end: step + length, action })
    }

    fn action(&self) -> Option<Action> {
        let at = self.place.to_array();
        let radius = self.grip.radius_mm / self.unit_mm;
        match self.grip.tool {
            SceneTool::Pour => {
                let rate = self.grip.rate_mm3_s * self.pressure;
                let place = Place::At(at);
                let quantity = Quantity::Rate(rate);
                let pour = Pour { place, quantity, recipe: self.recipe.clone(), region: 0 };
                (rate >= LEAST_RATE).then_some(Action::Pour(pour))
            }
            SceneTool::Push => {
                let way = self.place - self.last.unwrap_or(self.place);
                let strength = WIND * self.grip.strength * self.pressure;
                let towards = way.normalize_or_zero().to_array();
                let push = Push { at, towards, radius, strength };
                (way.length() > LEAST_WAY * radius).then_some(Action::Push(push))
            }
            SceneTool::Lift => {
                let rate = (SOAKS * self.grip.strength * self.pressure).clamp(0.0, 120.0);
                let lift = Lift { place: Place::At(at), radius, rate };
                (rate > 0.0).then_some(Action::Lift(lift))
            }
            SceneTool::Dry => {
                let ball = Some(Ball { center: at, radius });
                self.last
                    .is_none_or(|last: DVec3| self.place.distance(last) >= DRYING_WAY * radius)
                    .then_some(Action::Dry(Dry { ball }))
            }
        }
    }

    /// Notes where the air begins to be drawn, so that its first way has a direction.
    pub(super) fn rest(&mut self) {
        if self.grip.tool == SceneTool::Push {
            self.last.get_or_insert(self.place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hand(tool: SceneTool) -> Hand {
        let grip = Grip { tool, ..Grip::default() };
        let recipe = Recipe::from([("B".to_owned(), 1.0)]);
        Hand::down(grip, recipe, 50.0, (DVec3::new(0.123_456_78, 1.0, 2.0), 0.5), 10)
    }

    #[test]
    fn a_pour_is_a_row_of_portions_without_gaps() {
        let mut hand = hand(SceneTool::Pour);
        let mut portions = Vec::new();
        for step in 10..30 {
            if step == 17 {
                hand.move_to(DVec3::new(3.0, 1.0, 2.0), 1.0);
            }
            portions.extend(hand.next_action(step));
        }
        let times: Vec<[u32; 2]> =
            portions.iter().map(|portion| [portion.start, portion.end]).collect();
        assert_eq!(times, [[10, 16], [16, 22], [22, 28], [28, 34]]);
        let pours: Vec<(Place, Quantity)> = portions
            .into_iter()
            .map(|portion| match portion.action {
                Action::Pour(pour) => (pour.place, pour.quantity),
                other => panic!("{other:?}"),
            })
            .collect();
        let first = (Place::At([0.123_457, 1.0, 2.0]), Quantity::Rate(20.0));
        assert_eq!(pours[..2], [first.clone(), first], "in the digits of a file");
        assert_eq!(pours[2], (Place::At([3.0, 1.0, 2.0]), Quantity::Rate(40.0)));
        hand.move_to(DVec3::ZERO, 0.0);
        assert_eq!(hand.next_action(90), None, "a pen that does not press");
    }

    #[test]
    fn air_blows_along_the_way_and_only_while_the_pen_moves() {
        let mut hand = hand(SceneTool::Push);
        assert_eq!(hand.next_action(10), None, "it has not moved");
        hand.rest();
        hand.move_to(DVec3::new(0.123_456_78, 3.0, 2.0), 1.0);
        let Some(Timed { start: 11, end: 17, action: Action::Push(push) }) = hand.next_action(11)
        else {
            panic!("it moved");
        };
        assert_eq!((push.towards, push.radius, push.strength), ([0.0, 1.0, 0.0], 0.4, 100.0));
        assert_eq!(hand.next_action(17), None, "it rests");
    }

    #[test]
    fn a_dryer_dries_at_once_and_again_where_it_has_moved() {
        let mut hand = hand(SceneTool::Dry);
        let dry = |step, x| {
            let ball = Some(Ball { center: [x, 1.0, 2.0], radius: 0.4 });
            Some(Timed { start: step, end: step + 1, action: Action::Dry(Dry { ball }) })
        };
        assert_eq!(hand.next_action(12), dry(12, 0.123_457));
        assert_eq!(hand.next_action(13), None, "it rests");
        hand.move_to(DVec3::new(0.21, 1.0, 2.0), 1.0);
        assert_eq!(hand.next_action(14), None, "it has hardly moved");
        hand.move_to(DVec3::new(0.23, 1.0, 2.0), 1.0);
        assert_eq!(hand.next_action(15), dry(15, 0.23));
        assert_eq!(hand.next_action(16), None);
    }
}
