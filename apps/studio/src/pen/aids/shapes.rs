//! Geometry of the drawing aids: the line or ellipse that leads a stroke, rulers, perspective with
//! one to three vanishing points, and symmetry.

use paint::pose::Sample;
use serde::{Deserialize, Serialize};

/// A place on the canvas, or a movement on it: right and down, in mm.
pub(super) type Place = [f64; 2];

/// A place moved by a multiple of a movement.
pub(super) fn moved([x, y]: Place, [right, down]: Place, by: f64) -> Place {
    [x + right * by, y + down * by]
}

/// The movement from one place to another.
pub(super) fn way([from_x, from_y]: Place, [to_x, to_y]: Place) -> Place {
    [to_x - from_x, to_y - from_y]
}

pub(super) fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// A movement turned clockwise by a quarter.
pub(super) fn across([right, down]: Place) -> Place {
    [-down, right]
}

pub(super) fn length([right, down]: Place) -> f64 {
    right.hypot(down)
}

/// A movement of length 1 in the same direction; `None` for a movement of length 0.
pub(super) fn unit(of: Place) -> Option<Place> {
    let length = length(of);
    (length > 1e-9).then(|| of.map(|part| part / length))
}

/// Sine and cosine of an angle in degrees, exact at quarter turns.
pub(super) fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}

/// The line or ellipse that leads one stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Course {
    /// An endless straight line.
    Line {
        at: Place,
        /// Direction, of length 1.
        along: Place,
    },
    /// An ellipse, turned by any angle.
    Ellipse {
        middle: Place,
        /// The two half axes, at right angles and longer than 0.
        axes: [Place; 2],
    },
}

impl Course {
    /// The place on the line or ellipse for a place of the pen. On a line this is the nearest
    /// place. On an ellipse it lies in the same direction from the middle. On a circle this is the
    /// nearest place too.
    pub(super) fn led(&self, place: Place) -> Place {
        match *self {
            Self::Line { at, along } => moved(at, along, dot(way(at, place), along)),
            Self::Ellipse { middle, axes } => {
                let [x, y] = shares(middle, axes, place);
                let out = length([x, y]);
                let [x, y] = if out > 1e-9 { [x / out, y / out] } else { [1.0, 0.0] };
                moved(moved(middle, axes[0], x), axes[1], y)
            }
        }
    }
}

/// A place relative to the middle of an ellipse, in half axes.
pub(super) fn shares(middle: Place, axes: [Place; 2], place: Place) -> Place {
    axes.map(|axis| dot(way(middle, place), axis) / dot(axis, axis))
}

/// Shape of a ruler.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RulerShape {
    /// The straight line through both ends.
    #[default]
    Line,
    /// The straight line through the start of the stroke, parallel to the ruler.
    Parallel,
    /// The ellipse around its middle.
    Ellipse,
    /// An ellipse of the same middle and form, through the start of the stroke.
    Concentric,
}

/// A ruler on the canvas. Positions are in mm from the upper left corner of the canvas.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Ruler {
    /// Shape that strokes follow.
    pub shape: RulerShape,
    /// Two places on the straight line.
    pub ends: [[f64; 2]; 2],
    /// Middle of the ellipse.
    pub middle: [f64; 2],
    /// End of one half axis of the ellipse.
    pub tip: [f64; 2],
    /// Length of the other half axis, in mm.
    pub half_width_mm: f64,
}

impl Ruler {
    /// A ruler of this shape in the middle of a canvas of this width and height.
    pub(super) fn in_middle_of([width, height]: Place, shape: RulerShape) -> Self {
        let middle = [0.5 * width, 0.5 * height];
        Self {
            shape,
            ends: [[0.25 * width, middle[1]], [0.75 * width, middle[1]]],
            middle,
            tip: [middle[0] + 0.3 * width, middle[1]],
            half_width_mm: 0.3 * height,
        }
    }

    pub(super) fn axes(&self) -> Option<[Place; 2]> {
        let axis = way(self.middle, self.tip);
        let other = across(unit(axis)?).map(|part| part * self.half_width_mm);
        (length(other) > 1e-6).then_some([axis, other])
    }

    /// The line or ellipse of a stroke that starts here; `None` if the ruler has no extent.
    pub(super) fn course(&self, start: Place) -> Option<Course> {
        let line = |at| Some(Course::Line { at, along: unit(way(self.ends[0], self.ends[1]))? });
        match self.shape {
            RulerShape::Line => line(self.ends[0]),
            RulerShape::Parallel => line(start),
            RulerShape::Ellipse => {
                Some(Course::Ellipse { middle: self.middle, axes: self.axes()? })
            }
            RulerShape::Concentric => {
                let axes = self.axes()?;
                let scale = length(shares(self.middle, axes, start));
                let axes = axes.map(|axis| axis.map(|part| part * scale));
                (scale > 1e-6).then_some(Course::Ellipse { middle: self.middle, axes })
            }
        }
    }

    pub(super) fn side(&self) -> Place {
        let other = self.axes().map_or([0.0; 2], |[_, other]| other);
        moved(self.middle, other, 1.0)
    }
}

const MOST: usize = 3;

/// A vanishing point in homogeneous coordinates: its place (right and down in mm) and 1, or for a
/// point at infinity a direction and 0. All lines towards such a point are parallel.
type Vanishing = [f64; 3];

/// A perspective guide. Positions are in mm from the upper left corner of the canvas, and may lie
/// beyond it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Perspective {
    /// Number of vanishing points in use, 1 to 3. Any other number counts as the nearest of these.
    pub count: usize,
    /// The vanishing points. The first two lie on the horizon.
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

    pub(super) fn horizon(&self) -> Place {
        let along = match self.in_use() {
            [left, right, ..] => unit(way(*left, *right)),
            _ => None,
        };
        along.unwrap_or([1.0, 0.0])
    }

    /// All points that lines run to. If you use fewer than three vanishing points, lines can also
    /// be at right angles to the horizon, and with one point also parallel to it.
    fn vanishing(&self) -> Vec<Vanishing> {
        let mut all: Vec<Vanishing> = self.in_use().iter().map(|&[x, y]| [x, y, 1.0]).collect();
        let horizon = self.horizon();
        let endless = [across(horizon), horizon].map(|[x, y]| [x, y, 0.0]);
        all.extend(endless.into_iter().take(MOST - all.len()));
        all
    }

    /// The line of a stroke that starts at `start` and first goes to `to`. It leads to the
    /// vanishing point nearest in direction, forwards or backwards. `None` for a stroke without
    /// length.
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

/// Number of arms of a radial symmetry.
pub(super) const ARMS: std::ops::RangeInclusive<u8> = 2..=12;

/// Kind of a symmetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SymmetryKind {
    /// Mirrors left and right of the axis.
    #[default]
    Vertical,
    /// Mirrors above and below the line across the axis.
    Horizontal,
    /// Mirrors both ways.
    Both,
    /// Turns the stroke about the centre.
    Radial,
}

/// Symmetry of strokes about a centre on the canvas.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Symmetry {
    /// Whether strokes are repeated.
    pub on: bool,
    /// How strokes are repeated.
    pub kind: SymmetryKind,
    /// Centre, in mm from the upper left corner of the canvas.
    pub centre: [f64; 2],
    /// Angle of the axis, in degrees clockwise from upright.
    pub angle_deg: f64,
    /// Number of arms of a radial symmetry, 2 to 12. Any other number counts as the nearest of
    /// these.
    pub arms: u8,
}

impl Default for Symmetry {
    fn default() -> Self {
        let kind = SymmetryKind::default();
        Self { on: false, kind, centre: [0.0; 2], angle_deg: 0.0, arms: 6 }
    }
}

impl Symmetry {
    /// The twins of a stroke, which are painted together with it.
    #[must_use]
    pub fn twins(&self) -> Vec<Twin> {
        let (sin, cos) = sin_cos(2.0 * self.angle_deg);
        let sides = [[-cos, -sin], [-sin, cos]];
        let ends = sides.map(|row| row.map(|number| -number));
        let matrices = match self.kind {
            SymmetryKind::Vertical => vec![sides],
            SymmetryKind::Horizontal => vec![ends],
            SymmetryKind::Both => vec![sides, ends, [[-1.0, 0.0], [0.0, -1.0]]],
            SymmetryKind::Radial => {
                let arms = self.arms.clamp(*ARMS.start(), *ARMS.end());
                (1..arms)
                    .map(|arm: u8| {
                        let (sin, cos) = sin_cos(360.0 * f64::from(arm) / f64::from(arms));
                        [[cos, -sin], [sin, cos]]
                    })
                    .collect()
            }
        };
        matrices.into_iter().map(|matrix| Twin { centre: self.centre, matrix }).collect()
    }

    /// Directions of the axes from the centre, of length 1: the arms, or both sides of each mirror.
    pub(super) fn rays(&self) -> Vec<Place> {
        let arms = self.arms.clamp(*ARMS.start(), *ARMS.end());
        let turns: Vec<f64> = match self.kind {
            SymmetryKind::Vertical => vec![0.0, 180.0],
            SymmetryKind::Horizontal => vec![90.0, 270.0],
            SymmetryKind::Both => vec![0.0, 90.0, 180.0, 270.0],
            SymmetryKind::Radial => {
                (0..arms).map(|arm| 360.0 * f64::from(arm) / f64::from(arms)).collect()
            }
        };
        turns.into_iter().map(|turn| upright_turned(self.angle_deg + turn)).collect()
    }
}

/// The upward direction, turned clockwise.
pub(super) fn upright_turned(degrees: f64) -> Place {
    let (sin, cos) = sin_cos(degrees);
    [sin, -cos]
}

/// Maps a stroke to its twin: mirrored at a line through the centre, or turned about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twin {
    centre: Place,
    /// Rows of an orthogonal matrix.
    matrix: [Place; 2],
}

impl Twin {
    /// The place in mm of the twin.
    #[must_use]
    pub fn place(&self, place: [f64; 2]) -> [f64; 2] {
        moved(self.centre, self.way(way(self.centre, place)), 1.0)
    }

    /// The sample of the twin: its place, and tilt and twist of the brush.
    #[must_use]
    pub fn sample(&self, sample: &Sample) -> Sample {
        let [x_mm, y_mm] = self.place([sample.x_mm, sample.y_mm]);
        let slopes = [sample.tilt_x_deg, sample.tilt_y_deg]
            .map(|degrees| degrees.clamp(-89.0, 89.0).to_radians().tan());
        let tilt = self.way(slopes);
        let [tilt_x_deg, tilt_y_deg] = tilt.map(|slope| slope.atan().to_degrees());
        let (sin, cos) = sin_cos(sample.twist_deg);
        let [right, down] = self.way([cos, sin]);
        let twist_deg = down.atan2(right).to_degrees();
        Sample { x_mm, y_mm, tilt_x_deg, tilt_y_deg, twist_deg, ..*sample }
    }

    fn way(&self, [right, down]: Place) -> Place {
        self.matrix.map(|[a, b]| a * right + b * down)
    }
}

#[cfg(test)]
mod perspective_tests {
    use super::*;

    fn perspective(count: usize) -> Perspective {
        Perspective { count, points: [[10.0, 40.0], [190.0, 40.0], [100.0, 300.0]] }
    }

    fn along(guide: &Perspective, start: Place, to: Place) -> Place {
        let Some(Course::Line { at, along }) = guide.course(start, to) else { panic!("a line") };
        assert_eq!(at, start);
        along
    }

    fn near(found: Place, wanted: Place) {
        // Both directions give the same line.
        let [x, y] = wanted;
        assert!((found[0] * y - found[1] * x).abs() < 1e-9, "{found:?}, not {wanted:?}");
    }

    #[test]
    fn a_stroke_is_led_to_the_vanishing_point_of_the_nearest_direction() {
        let two = perspective(2);
        // These go roughly to the left point, away from it, and to the right one.
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
        // The horizon leans. This line is at right angles to it.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: Place, wanted: Place) {
        assert!(length(way(found, wanted)) < 1e-9, "{found:?}, not {wanted:?}");
    }

    #[test]
    fn a_place_is_led_to_the_foot_of_its_perpendicular() {
        let line = Course::Line { at: [2.0, 1.0], along: [0.6, 0.8] };
        // The place is 5 mm along the line and 3 mm beside it.
        near(line.led([2.0 + 3.0 - 2.4, 1.0 + 4.0 + 1.8]), [5.0, 5.0]);
        near(line.led([2.0, 1.0]), [2.0, 1.0]);
        // This lies behind the first end of the line.
        near(line.led([2.0 - 6.0, 1.0 - 8.0]), [-4.0, -7.0]);
    }

    #[test]
    fn a_place_is_led_to_an_ellipse_in_its_direction() {
        let circle = Course::Ellipse { middle: [10.0, 10.0], axes: [[5.0, 0.0], [0.0, 5.0]] };
        near(circle.led([16.0, 18.0]), [13.0, 14.0]);
        near(circle.led([10.3, 10.4]), [13.0, 14.0]);
        let middle = circle.led([10.0, 10.0]);
        assert!((length(way([10.0, 10.0], middle)) - 5.0).abs() < 1e-9, "{middle:?}");
        let turned = Course::Ellipse { middle: [1.0, 2.0], axes: [[3.0, 3.0], [-1.0, 1.0]] };
        for place in [[9.0, 2.0], [1.0, -4.0], [0.0, 1.9]] {
            let [x, y] = shares([1.0, 2.0], [[3.0, 3.0], [-1.0, 1.0]], turned.led(place));
            assert!((x.hypot(y) - 1.0).abs() < 1e-9, "{x} {y}");
        }
    }

    fn ruler(shape: RulerShape) -> Ruler {
        Ruler {
            shape,
            ends: [[2.0, 3.0], [10.0, 9.0]],
            middle: [20.0, 10.0],
            tip: [26.0, 10.0],
            half_width_mm: 3.0,
        }
    }

    #[test]
    fn strokes_keep_to_the_ruler_or_to_a_line_of_their_own_parallel_to_it() {
        let start = [7.0, 2.0];
        let along = |shape| {
            let course = ruler(shape).course(start).unwrap();
            [[7.0, 2.0], [9.0, 6.0], [30.0, 1.0]].map(|place| course.led(place))
        };
        let slope = |from: Place, to: Place| (to[1] - from[1]) / (to[0] - from[0]);
        for place in along(RulerShape::Line) {
            assert!((slope([2.0, 3.0], place) - 0.75).abs() < 1e-9, "{place:?}");
        }
        let [first, others @ ..] = along(RulerShape::Parallel);
        assert_eq!(first, start);
        for place in others {
            assert!((slope(start, place) - 0.75).abs() < 1e-9, "{place:?}");
        }
    }

    #[test]
    fn strokes_keep_to_the_ellipse_or_to_one_of_their_own() {
        for (shape, start, wanted) in [
            (RulerShape::Ellipse, [29.0, 10.0], 1.0),
            (RulerShape::Concentric, [29.0, 10.0], 1.5),
            (RulerShape::Concentric, [20.0, 8.5], 0.5),
        ] {
            let course = ruler(shape).course(start).unwrap();
            for place in [start, [21.0, 17.0], [12.0, 9.0]] {
                let led = course.led(place);
                assert!(
                    (length(shares([20.0, 10.0], [[6.0, 0.0], [0.0, 3.0]], led)) - wanted).abs()
                        < 1e-9,
                    "{shape:?} {place:?}: {led:?}"
                );
            }
        }
    }

    #[test]
    fn a_ruler_without_extent_leads_nothing() {
        for shape in [RulerShape::Line, RulerShape::Parallel] {
            let ruler = Ruler { ends: [[1.0, 1.0]; 2], ..ruler(shape) };
            assert_eq!(ruler.course([5.0, 5.0]), None);
        }
        for flat in [
            Ruler { tip: [20.0, 10.0], ..ruler(RulerShape::Ellipse) },
            Ruler { half_width_mm: 0.0, ..ruler(RulerShape::Ellipse) },
        ] {
            assert_eq!(flat.course([5.0, 5.0]), None);
        }
        assert_eq!(ruler(RulerShape::Concentric).course([20.0, 10.0]), None, "at the middle");
    }

    const SAMPLE: Sample = Sample {
        seconds: 0.5,
        x_mm: 13.0,
        y_mm: 4.0,
        pressure: 0.7,
        tilt_x_deg: 30.0,
        tilt_y_deg: -10.0,
        twist_deg: 20.0,
    };

    fn twins(kind: SymmetryKind, angle_deg: f64, arms: u8) -> Vec<Sample> {
        let symmetry = Symmetry { on: true, kind, centre: [10.0, 6.0], angle_deg, arms };
        symmetry.twins().iter().map(|twin| twin.sample(&SAMPLE)).collect()
    }

    fn assert_near(found: &Sample, wanted: [f64; 5]) {
        let Sample { x_mm, y_mm, tilt_x_deg, tilt_y_deg, twist_deg, .. } = *found;
        for (found, wanted) in
            [x_mm, y_mm, tilt_x_deg, tilt_y_deg, twist_deg].into_iter().zip(wanted)
        {
            assert!((found - wanted).abs() < 1e-9, "{found}, not {wanted}");
        }
        assert_eq!((found.seconds, found.pressure), (SAMPLE.seconds, SAMPLE.pressure));
    }

    #[test]
    fn mirrors_turn_place_tilt_and_twist_over() {
        let upright = [7.0, 4.0, -30.0, -10.0, 160.0];
        let level = [13.0, 8.0, 30.0, 10.0, -20.0];
        let [one] = &twins(SymmetryKind::Vertical, 0.0, 6)[..] else { panic!("one twin") };
        assert_near(one, upright);
        let [one] = &twins(SymmetryKind::Horizontal, 0.0, 6)[..] else { panic!("one twin") };
        assert_near(one, level);
        let [first, second, third] = &twins(SymmetryKind::Both, 0.0, 6)[..] else {
            panic!("three twins")
        };
        assert_near(first, upright);
        assert_near(second, level);
        assert_near(third, [7.0, 8.0, -30.0, 10.0, -160.0]);
        // The mirror goes from the lower left to the upper right, so right becomes up.
        let [one] = &twins(SymmetryKind::Vertical, 45.0, 6)[..] else { panic!("one twin") };
        assert_near(one, [12.0, 3.0, 10.0, -30.0, -110.0]);
    }

    #[test]
    fn a_mirrored_twin_of_a_twin_is_the_stroke() {
        let symmetry = Symmetry { centre: [3.0, 8.0], angle_deg: 33.0, ..Symmetry::default() };
        let [twin] = symmetry.twins()[..] else { panic!("one twin") };
        let Sample { x_mm, y_mm, tilt_x_deg, tilt_y_deg, twist_deg, .. } = SAMPLE;
        let again = twin.sample(&twin.sample(&SAMPLE));
        assert_near(&again, [x_mm, y_mm, tilt_x_deg, tilt_y_deg, twist_deg]);
    }

    #[test]
    fn arms_turn_the_stroke_about_the_centre() {
        let [first, second, third] = &twins(SymmetryKind::Radial, 15.0, 4)[..] else {
            panic!("three twins")
        };
        assert_near(first, [12.0, 9.0, 10.0, 30.0, 110.0]);
        assert_near(second, [7.0, 8.0, -30.0, 10.0, -160.0]);
        assert_near(third, [8.0, 3.0, -10.0, -30.0, -70.0]);
        for (arms, count) in [(0, 1), (2, 1), (12, 11), (200, 11)] {
            assert_eq!(twins(SymmetryKind::Radial, 0.0, arms).len(), count, "{arms} arms");
        }
    }
}
