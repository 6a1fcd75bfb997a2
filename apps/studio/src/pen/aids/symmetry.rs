//! Symmetry: places and attitudes of the brush of a stroke, mirrored or turned.

use paint::pose::Sample;
use serde::{Deserialize, Serialize};

use super::place::{Place, moved, sin_cos, way};

/// Number of arms of a radial symmetry.
pub(super) const ARMS: std::ops::RangeInclusive<u8> = 2..=12;

/// Kind of a symmetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SymmetryKind {
    /// Left and right of the axis are mirrored.
    #[default]
    Vertical,
    /// Above and below the line across the axis are mirrored.
    Horizontal,
    /// Both are mirrored.
    Both,
    /// The stroke is turned about the centre.
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
    /// Its centre, in mm from the upper left corner of the canvas.
    pub centre: [f64; 2],
    /// Angle of the axis, in degrees clockwise from upright.
    pub angle_deg: f64,
    /// Number of arms of a radial symmetry, 2 to 12; other numbers count as the nearest of these.
    pub arms: u8,
}

impl Default for Symmetry {
    fn default() -> Self {
        let kind = SymmetryKind::default();
        Self { on: false, kind, centre: [0.0; 2], angle_deg: 0.0, arms: 6 }
    }
}

impl Symmetry {
    /// The twins of a stroke, which are painted besides it.
    #[must_use]
    pub fn twins(&self) -> Vec<Twin> {
        let twin = |matrix| Twin { centre: self.centre, matrix };
        let (sin, cos) = sin_cos(2.0 * self.angle_deg);
        let sides = [[-cos, -sin], [-sin, cos]];
        let ends = sides.map(|row| row.map(|number| -number));
        match self.kind {
            SymmetryKind::Vertical => vec![twin(sides)],
            SymmetryKind::Horizontal => vec![twin(ends)],
            SymmetryKind::Both => vec![twin(sides), twin(ends), twin([[-1.0, 0.0], [0.0, -1.0]])],
            SymmetryKind::Radial => {
                let arms = self.arms.clamp(*ARMS.start(), *ARMS.end());
                (1..arms)
                    .map(|arm: u8| {
                        let (sin, cos) = sin_cos(360.0 * f64::from(arm) / f64::from(arms));
                        twin([[cos, -sin], [sin, cos]])
                    })
                    .collect()
            }
        }
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

/// The direction upwards, turned clockwise.
pub(super) fn upright_turned(degrees: f64) -> Place {
    let (sin, cos) = sin_cos(degrees);
    [sin, -cos]
}

/// A map of a stroke to one that is painted besides it: mirrored at a line through the centre, or
/// turned about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twin {
    centre: Place,
    /// Rows of an orthogonal matrix.
    matrix: [Place; 2],
}

impl Twin {
    /// The place in mm that belongs to a place in mm.
    #[must_use]
    pub fn place(&self, place: [f64; 2]) -> [f64; 2] {
        moved(self.centre, self.way(way(self.centre, place)), 1.0)
    }

    /// The sample that belongs to a sample: its place, and with it tilt and twist of the brush.
    #[must_use]
    pub fn sample(&self, sample: &Sample) -> Sample {
        let [x_mm, y_mm] = self.place([sample.x_mm, sample.y_mm]);
        let slope = |degrees: f64| degrees.clamp(-89.0, 89.0).to_radians().tan();
        let tilt = self.way([slope(sample.tilt_x_deg), slope(sample.tilt_y_deg)]);
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
mod tests {
    use super::*;

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
        // Mirrored at the line from the lower left to the upper right, right becomes up.
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
