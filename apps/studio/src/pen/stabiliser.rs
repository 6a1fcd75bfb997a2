//! Steadies the way of a brush: it follows the places of the pen by a rule that knows no time.
//!
//! - Average: the brush is at the mean of the last length of the pen's way, each part of the way
//!   weighing as much as it is long, so it does not matter how often a device reports. On a
//!   straight way it stays half the length behind.
//! - String: the pen pulls the brush by a string. The brush moves only while the string is taut,
//!   towards the pen.
//!
//! When the pen is lifted, the brush catches up with the last place of the pen.

use std::collections::VecDeque;

use session::brushes::StabiliserMethod;

/// Steps in which a brush catches up with a pen.
const CATCH_UP_STEPS: usize = 8;

/// A place on a surface, in mm.
type Place = (f64, f64);

/// The brush of one stroke behind its pen.
#[derive(Debug, Clone)]
pub(super) struct Stabiliser {
    method: StabiliserMethod,
    length_mm: f64,
    /// Places of the pen, the last first, as far back as the mean reaches.
    way: VecDeque<Place>,
    brush: Option<Place>,
}

impl Stabiliser {
    /// A stroke that has not begun. A length of 0 or less switches the stabiliser off.
    pub(super) fn new(method: StabiliserMethod, length_mm: f64) -> Self {
        let method = if length_mm > 0.0 { method } else { StabiliserMethod::Off };
        Self { method, length_mm, way: VecDeque::new(), brush: None }
    }

    /// Whether the brush is where the pen is.
    pub(super) fn is_off(&self) -> bool {
        self.method == StabiliserMethod::Off
    }

    /// Moves the pen and returns the place of the brush.
    pub(super) fn follow(&mut self, pen: Place) -> Place {
        let brush = match self.method {
            StabiliserMethod::Off => pen,
            StabiliserMethod::Average => {
                if self.way.front() != Some(&pen) {
                    self.way.push_front(pen);
                }
                self.forget();
                mean(&self.way, self.length_mm)
            }
            StabiliserMethod::String => {
                self.way.clear();
                self.way.push_front(pen);
                pulled(self.brush.unwrap_or(pen), pen, self.length_mm)
            }
        };
        self.brush = Some(brush);
        brush
    }

    /// The places by which the brush catches up, the last of which is that of the pen; none if it
    /// is there. From then on the brush is where the pen is.
    pub(super) fn catch_up(&mut self) -> Vec<Place> {
        let method = std::mem::take(&mut self.method);
        let (Some(brush), Some(&pen)) = (self.brush, self.way.front()) else { return Vec::new() };
        if brush == pen {
            return Vec::new();
        }
        let length_mm = self.length_mm.min(length(&self.way));
        let places = (1..=CATCH_UP_STEPS)
            .map(|step: usize| {
                let left = 1.0 - step as f64 / CATCH_UP_STEPS as f64;
                match method {
                    StabiliserMethod::Average if left > 0.0 => mean(&self.way, length_mm * left),
                    _ => (pen.0 + (brush.0 - pen.0) * left, pen.1 + (brush.1 - pen.1) * left),
                }
            })
            .collect();
        self.brush = Some(pen);
        places
    }

    /// Drops places further back than the mean reaches.
    fn forget(&mut self) {
        let mut reached = 0.0;
        let mut kept = 1;
        while kept < self.way.len() && reached < self.length_mm {
            reached += distance(self.way[kept - 1], self.way[kept]);
            kept += 1;
        }
        self.way.truncate(kept);
    }
}

/// Distance of two places, in mm.
pub(super) fn distance(from: Place, to: Place) -> f64 {
    (to.0 - from.0).hypot(to.1 - from.1)
}

/// A brush on a string of this length whose other end is pulled to `pen`.
fn pulled(brush: Place, pen: Place, length_mm: f64) -> Place {
    let slack = length_mm / distance(brush, pen);
    // A brush at the pen has an infinite slack.
    if slack < 1.0 {
        (pen.0 + (brush.0 - pen.0) * slack, pen.1 + (brush.1 - pen.1) * slack)
    } else {
        brush
    }
}

/// Mean of the last `length_mm` of a way, whose last place comes first; of all of it if it is
/// shorter.
fn mean(way: &VecDeque<Place>, length_mm: f64) -> Place {
    let Some(&pen) = way.front() else { return (0.0, 0.0) };
    let mut sum = (0.0, 0.0);
    let mut reached = 0.0;
    for (&to, &from) in way.iter().zip(way.iter().skip(1)) {
        let whole = distance(from, to);
        let part = whole.min(length_mm - reached);
        if part <= 0.0 {
            break;
        }
        let share = 0.5 * part / whole;
        let middle = (to.0 + (from.0 - to.0) * share, to.1 + (from.1 - to.1) * share);
        // Relative to the pen, so that a resting pen has no rounding error.
        sum.0 += (middle.0 - pen.0) * part;
        sum.1 += (middle.1 - pen.1) * part;
        reached += part;
    }
    if reached > 0.0 { (pen.0 + sum.0 / reached, pen.1 + sum.1 / reached) } else { pen }
}

/// Length of a way, in mm.
fn length(way: &VecDeque<Place>) -> f64 {
    way.iter().zip(way.iter().skip(1)).map(|(&to, &from)| distance(from, to)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const METHODS: [StabiliserMethod; 2] = [StabiliserMethod::Average, StabiliserMethod::String];

    /// A line to the right with a jitter of 0.5 mm across.
    fn shaky() -> Vec<Place> {
        let jitter = |at: u32| if at.is_multiple_of(2) { 0.5 } else { -0.5 };
        (0..200).map(|at| (0.3 * f64::from(at), jitter(at))).collect()
    }

    fn near(a: Place, b: Place) -> bool {
        distance(a, b) < 1e-9
    }

    #[test]
    fn the_brush_is_at_the_pen_when_the_stabiliser_is_off() {
        for mut off in [
            Stabiliser::new(StabiliserMethod::Off, 4.0),
            Stabiliser::new(StabiliserMethod::String, 0.0),
        ] {
            for place in shaky() {
                assert_eq!(off.follow(place), place);
            }
            assert!(off.catch_up().is_empty(), "{off:?}");
        }
    }

    #[test]
    fn the_brush_starts_at_the_pen_and_ends_at_its_last_place() {
        for method in METHODS {
            let mut brush = Stabiliser::new(method, 6.0);
            let way = shaky();
            assert_eq!(brush.follow(way[0]), way[0], "{method:?}");
            let places: Vec<Place> = way.iter().map(|&place| brush.follow(place)).collect();
            assert!(distance(places[199], way[199]) > 0.5, "{method:?}: it stays behind");
            let end = brush.catch_up();
            assert_eq!(end.last(), Some(&way[199]), "{method:?}");
            assert!(end.iter().map(|place| place.0).is_sorted(), "{method:?}: {end:?}");
            assert!(brush.catch_up().is_empty() && brush.follow((9.0, 9.0)) == (9.0, 9.0));
        }
    }

    #[test]
    fn a_shaky_line_becomes_steady() {
        for method in METHODS {
            let mut brush = Stabiliser::new(method, 6.0);
            let places: Vec<Place> = shaky().into_iter().map(|place| brush.follow(place)).collect();
            let worst = places[60..].iter().map(|place| place.1.abs()).fold(0.0, f64::max);
            assert!(worst < 0.1, "{method:?}: {worst} of 0.5 mm");
        }
    }

    #[test]
    fn a_string_pulls_only_while_it_is_taut() {
        let mut brush = Stabiliser::new(StabiliserMethod::String, 5.0);
        brush.follow((0.0, 0.0));
        assert_eq!(brush.follow((3.0, 4.0)), (0.0, 0.0));
        assert!(near(brush.follow((6.0, 8.0)), (3.0, 4.0)), "{brush:?}");
        assert!(near(brush.follow((4.0, 4.0)), (3.0, 4.0)), "the pen goes back");
        assert!(near(brush.follow((3.0, 14.0)), (3.0, 9.0)), "{brush:?}");
    }

    #[test]
    fn the_mean_does_not_depend_on_how_often_the_pen_reports() {
        let brush = |steps: u32| {
            let mut brush = Stabiliser::new(StabiliserMethod::Average, 4.0);
            (0..=steps)
                .map(|at| brush.follow((10.0 * f64::from(at) / f64::from(steps), 0.0)))
                .last()
        };
        for steps in [5, 17, 400] {
            assert!(near(brush(steps).unwrap(), (8.0, 0.0)), "{steps}: {:?}", brush(steps));
        }
        let mut resting = Stabiliser::new(StabiliserMethod::Average, 4.0);
        (0..50).for_each(|_| assert_eq!(resting.follow((0.1, 0.7)), (0.1, 0.7)));
    }
}
