//! The line or ellipse that one stroke is led along.

use super::place::{Place, dot, length, moved, way};

/// The line or ellipse that one stroke is led along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Course {
    /// An endless straight line.
    Line {
        /// A place on it.
        at: Place,
        /// Its direction, of length 1.
        along: Place,
    },
    /// An ellipse, turned by any angle.
    Ellipse {
        /// The middle of the ellipse.
        middle: Place,
        /// The two half axes, upright on each other and not without length.
        axes: [Place; 2],
    },
}

impl Course {
    /// The place of the course that belongs to a place: on a line the nearest one, on an ellipse the
    /// one in the direction from its middle, which is the nearest on a circle.
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

/// A place in an ellipse, in shares of its half axes.
pub(super) fn shares(middle: Place, axes: [Place; 2], place: Place) -> Place {
    axes.map(|axis| dot(way(middle, place), axis) / dot(axis, axis))
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
        // 5 mm along the line and 3 mm across it.
        near(line.led([2.0 + 3.0 - 2.4, 1.0 + 4.0 + 1.8]), [5.0, 5.0]);
        near(line.led([2.0, 1.0]), [2.0, 1.0]);
        // Behind the place that the line is given by.
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
}
