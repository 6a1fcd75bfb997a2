//! Rulers: a line, lines parallel to it, an ellipse, and ellipses of the same form.

use serde::{Deserialize, Serialize};

use super::course::{Course, shares};
use super::place::{Place, across, length, moved, unit, way};

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
    /// The ellipse of the same middle and form through the start of the stroke.
    Concentric,
}

/// A ruler on the canvas. Positions are in mm from the upper left corner of the canvas.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Ruler {
    /// Shape that strokes keep to.
    pub shape: RulerShape,
    /// Two places on the straight line.
    pub ends: [[f64; 2]; 2],
    /// Middle of the ellipse.
    pub middle: [f64; 2],
    /// End of one of the half axes of the ellipse.
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

    /// Both half axes of the ellipse; `None` if it has no extent.
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

    /// The place of the ellipse at the end of its other half axis.
    pub(super) fn side(&self) -> Place {
        let other = self.axes().map_or([0.0; 2], |[_, other]| other);
        moved(self.middle, other, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let out = |place: Place| length(shares([20.0, 10.0], [[6.0, 0.0], [0.0, 3.0]], place));
        for (shape, start, wanted) in [
            (RulerShape::Ellipse, [29.0, 10.0], 1.0),
            (RulerShape::Concentric, [29.0, 10.0], 1.5),
            (RulerShape::Concentric, [20.0, 8.5], 0.5),
        ] {
            let course = ruler(shape).course(start).unwrap();
            for place in [start, [21.0, 17.0], [12.0, 9.0]] {
                let led = course.led(place);
                assert!((out(led) - wanted).abs() < 1e-9, "{shape:?} {place:?}: {led:?}");
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
}
