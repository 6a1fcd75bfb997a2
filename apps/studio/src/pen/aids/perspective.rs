//! Perspective with one, two or three vanishing points.

use serde::{Deserialize, Serialize};

use super::course::Course;
use super::place::{Place, across, dot, unit, way};

/// Most vanishing points.
const MOST: usize = 3;

/// A vanishing point in homogeneous coordinates: right and down in mm, and 1; or a direction and 0
/// for one at infinity, towards which all lines are parallel.
type Vanishing = [f64; 3];

/// A perspective guide. Positions are in mm from the upper left corner of the canvas, and may lie
/// beyond it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Perspective {
    /// Number of vanishing points in use, 1 to 3; other numbers count as the nearest of these.
    pub count: usize,
    /// The vanishing points; the first two are on the horizon.
    pub points: [[f64; 2]; MOST],
}

impl Default for Perspective {
    fn default() -> Self {
        Self { count: 2, points: [[0.0; 2]; MOST] }
    }
}

impl Perspective {
    /// Vanishing points at their usual places around a canvas of this width and height.
    pub(super) fn in_middle_of([width, height]: Place, count: usize) -> Self {
        let horizon = 0.4 * height;
        let points = match count.clamp(1, MOST) {
            1 => [[0.5 * width, horizon]; MOST],
            _ => [[0.05 * width, horizon], [0.95 * width, horizon], [0.5 * width, 0.95 * height]],
        };
        Self { count, points }
    }

    /// The vanishing points in use.
    #[must_use]
    pub fn in_use(&self) -> &[[f64; 2]] {
        &self.points[..self.count.clamp(1, MOST)]
    }

    /// Direction of the horizon, of length 1.
    pub(super) fn horizon(&self) -> Place {
        let along = match self.in_use() {
            [left, right, ..] => unit(way(*left, *right)),
            _ => None,
        };
        along.unwrap_or([1.0, 0.0])
    }

    /// All points that lines run to. With fewer than three vanishing points, lines also stay upright
    /// on the horizon, and with one also along it.
    fn vanishing(&self) -> Vec<Vanishing> {
        let mut all: Vec<Vanishing> = self.in_use().iter().map(|&[x, y]| [x, y, 1.0]).collect();
        let horizon = self.horizon();
        let endless = [across(horizon), horizon].map(|[x, y]| [x, y, 0.0]);
        all.extend(endless.into_iter().take(MOST - all.len()));
        all
    }

    /// The line of a stroke that starts at `start` and goes to `to` first: that to the vanishing
    /// point whose direction, forth or back, is nearest. `None` for a stroke without length.
    pub(super) fn course(&self, start: Place, to: Place) -> Option<Course> {
        let heading = unit(way(start, to))?;
        let lines = self.vanishing().into_iter().filter_map(|point| towards(point, start));
        let nearest =
            lines.max_by(|a, b| dot(*a, heading).abs().total_cmp(&dot(*b, heading).abs()));
        Some(Course::Line { at: start, along: nearest? })
    }
}

/// Direction from a place to a vanishing point; `None` at the point itself.
fn towards([x, y, near]: Vanishing, from: Place) -> Option<Place> {
    unit([x - near * from[0], y - near * from[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn perspective(count: usize) -> Perspective {
        Perspective { count, points: [[10.0, 40.0], [190.0, 40.0], [100.0, 300.0]] }
    }

    /// The direction of the line of a stroke.
    fn along(guide: &Perspective, start: Place, to: Place) -> Place {
        let Some(Course::Line { at, along }) = guide.course(start, to) else { panic!("a line") };
        assert_eq!(at, start);
        along
    }

    fn near(found: Place, wanted: Place) {
        // Forth or back is the same line.
        let [x, y] = wanted;
        assert!((found[0] * y - found[1] * x).abs() < 1e-9, "{found:?}, not {wanted:?}");
    }

    #[test]
    fn a_stroke_is_led_to_the_vanishing_point_of_the_nearest_direction() {
        let two = perspective(2);
        // Roughly to the left point, away from it, and to the right one.
        near(along(&two, [100.0, 130.0], [98.0, 129.0]), [-1.0, -1.0]);
        near(along(&two, [100.0, 130.0], [102.0, 131.0]), [-1.0, -1.0]);
        near(along(&two, [100.0, 130.0], [103.0, 127.5]), [1.0, -1.0]);
        let three = perspective(3);
        near(along(&three, [150.0, 100.0], [148.0, 107.0]), [-50.0, 200.0]);
    }

    #[test]
    fn lines_to_points_at_infinity_are_parallel() {
        for start in [[100.0, 130.0], [20.0, 60.0]] {
            let up = [start[0] + 0.3, start[1] - 4.0];
            near(along(&perspective(2), start, up), [0.0, 1.0]);
            near(along(&perspective(1), start, up), [0.0, 1.0]);
            near(along(&perspective(1), start, [start[0] + 4.0, start[1] + 0.1]), [1.0, 0.0]);
        }
        // A horizon that leans: upright on it.
        let points = [[0.0, 0.0], [40.0, 30.0], [0.0, 0.0]];
        let leaning = Perspective { count: 2, points };
        near(along(&leaning, [50.0, 0.0], [47.0, 4.2]), [-0.6, 0.8]);
        // A point very far away is nearly at infinity.
        let far = Perspective { count: 1, points: [[1e9, 1e9], [0.0; 2], [0.0; 2]] };
        let [x, y] = along(&far, [3.0, 4.0], [4.0, 5.2]);
        assert!((x - y).abs() < 1e-6, "{x} {y}");
    }

    #[test]
    fn a_stroke_that_starts_at_a_vanishing_point_is_led_to_another() {
        near(along(&perspective(2), [10.0, 40.0], [14.0, 41.0]), [1.0, 0.0]);
        assert_eq!(perspective(2).course([5.0, 5.0], [5.0, 5.0]), None, "without length");
        for count in [0, 9] {
            let guide = Perspective { count, ..perspective(2) };
            assert_eq!(guide.in_use().len(), count.clamp(1, 3));
        }
    }
}
