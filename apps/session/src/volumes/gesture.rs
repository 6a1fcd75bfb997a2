//! Turns gestures of the hand into actions of the script.
//!
//! When an action of a script begins, we must know how long it lasts, but nobody knows yet when you
//! will lift the pen. So we record a gesture as a series of short actions of fixed length, one
//! after the other while the pen is down.
//! You see while you work exactly what the script plays. The last action ends at most [`PORTION`]
//! steps after the pen was lifted.

use glam::{DVec3, Vec2, Vec3};
use graphics::camera::Camera;
use graphics::mesh::Mesh;
use rayon::prelude::*;
use volumes::script::{Action, Ball, Dry, Lift, Place, Pour, Push, Quantity, Recipe};

use super::command::{Grip, SceneTool};

/// Steps that each action of a gesture lasts: a twentieth of a second.
pub(super) const PORTION: u32 = 6;

/// A pen that would pour less than this, in mm3 a second, pours nothing.
const LEAST_RATE: f64 = 0.01;

/// Acceleration of the air at full strength, in cells per square second.
const WIND: f64 = 200.0;

/// At full strength, a sponge takes up paint at this rate per second.
const SOAKS: f64 = 24.0;

/// Shortest stretch along which air is blown, relative to the radius of its ball. Below this it
/// would have no direction.
const LEAST_WAY: f64 = 0.01;

/// An action with its first step and the step after its last.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Timed {
    pub(super) start: u32,
    pub(super) end: u32,
    /// The action, rounded to the digits of a file.
    pub(super) action: Action,
}

/// A dryer dries again after it has moved this far, relative to its radius.
const DRYING_WAY: f64 = 0.25;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Hand {
    grip: Grip,
    recipe: Recipe,
    unit_mm: f64,
    place: DVec3,
    pressure: f64,
    /// Place of the last action. There is none before the first.
    last: Option<DVec3>,
    next: u32,
}

impl Hand {
    /// Sets a tool down on the surface before step `step`.
    pub(super) fn down(
        grip: Grip,
        recipe: Recipe,
        unit_mm: f64,
        (place, pressure): (DVec3, f64),
        step: u32,
    ) -> Self {
        Self { grip, recipe, unit_mm, place, pressure, last: None, next: step }
    }

    pub(super) fn move_to(&mut self, place: DVec3, pressure: f64) {
        (self.place, self.pressure) = (place, pressure);
    }

    /// The action that begins before step `step`, if there is one. Call this before each step.
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

    /// Notes where the pen blows first, so that the first stretch has a direction.
    pub(super) fn rest(&mut self) {
        if self.grip.tool == SceneTool::Push {
            self.last.get_or_insert(self.place);
        }
    }
}

/// A thread gets at least this many triangles.
const TRIANGLES: usize = 4096;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    pub(super) place: Vec3,
    /// Unit normal of the triangle, towards the eye.
    pub(super) normal: Vec3,
}

/// The surface that a ray from the eye meets first. `at` is a place of the picture as a share of
/// its width and height from the upper left corner, and `aspect` is width divided by height.
/// Returns `None` where there is no surface.
pub(super) fn surface_at(mesh: &Mesh, camera: &Camera, aspect: f32, at: [f32; 2]) -> Option<Hit> {
    let [right, up, back] = camera.axes();
    let high = (0.5 * camera.field_of_view_deg).to_radians().tan();
    let screen = (Vec2::from(at) * 2.0 - 1.0) * Vec2::new(high * aspect, -high);
    let along = right * screen.x + up * screen.y - back;
    let corners = |index: usize| {
        let corners = mesh.triangles[index].corners;
        corners.map(|corner| Vec3::from(mesh.positions[corner as usize]))
    };
    let nearest = (0..mesh.triangles.len())
        .into_par_iter()
        .with_min_len(TRIANGLES)
        .filter_map(|index| Some((distance(corners(index), camera.eye, along)?, index)))
        // If several are equally near, this takes the first, whatever the number of threads.
        .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let (distance, index) = nearest?;
    let [a, b, c] = corners(index);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let normal = if normal.dot(along) > 0.0 { -normal } else { normal };
    Some(Hit { place: camera.eye + along * distance, normal })
}

/// Where a ray meets a triangle from either side, as a multiple of `along` (Moller, Trumbore 1997).
fn distance([a, b, c]: [Vec3; 3], eye: Vec3, along: Vec3) -> Option<f32> {
    let ab = b - a;
    let ac = c - a;
    let across = along.cross(ac);
    let volume = ab.dot(across);
    if volume == 0.0 {
        return None;
    }
    let from = eye - a;
    let u = from.dot(across) / volume;
    let turned = from.cross(ab);
    let v = along.dot(turned) / volume;
    let distance = ac.dot(turned) / volume;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::camera::Framing;
    use graphics::mesh::SampleModel;
    use graphics::surface::{NO_TRIANGLE, position_at, visible};

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
        fn dry(step: u32, x: f64) -> Option<Timed> {
            let ball = Some(Ball { center: [x, 1.0, 2.0], radius: 0.4 });
            Some(Timed { start: step, end: step + 1, action: Action::Dry(Dry { ball }) })
        }
        assert_eq!(hand.next_action(12), dry(12, 0.123_457));
        assert_eq!(hand.next_action(13), None, "it rests");
        hand.move_to(DVec3::new(0.21, 1.0, 2.0), 1.0);
        assert_eq!(hand.next_action(14), None, "it has hardly moved");
        hand.move_to(DVec3::new(0.23, 1.0, 2.0), 1.0);
        assert_eq!(hand.next_action(15), dry(15, 0.23));
        assert_eq!(hand.next_action(16), None);
    }

    #[test]
    fn a_ray_meets_what_the_pixel_shows() {
        let mesh = SampleModel::StillLife.mesh(4000);
        let width = 64;
        let height = 40;
        let aspect = width as f32 / height as f32;
        let camera = Framing { aspect, ..Framing::default() }.camera(mesh.bounds());
        let seen = visible(&mesh, &camera, width, height);
        let mut hits = 0;
        let mut misses = 0;
        for y in 0..height {
            for x in 0..width {
                let at = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32];
                let hit = surface_at(&mesh, &camera, aspect, at);
                let fragment = seen[(x, y)];
                match (hit, fragment.triangle == NO_TRIANGLE) {
                    (Some(hit), false) => {
                        let apart = hit.place.distance(position_at(&mesh, fragment));
                        let towards = camera.eye - hit.place;
                        assert!(hit.normal.dot(towards) >= 0.0, "it faces the eye");
                        hits += usize::from(apart < 2e-3);
                    }
                    (None, true) => misses += 1,
                    _ => {}
                }
            }
        }
        let share = (hits + misses) as f64 / (width * height) as f64;
        assert!(share > 0.99 && hits > 400 && misses > 100, "{share}: {hits} and {misses}");
    }
}
