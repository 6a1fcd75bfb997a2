//! Smooths the path of a brush. The brush follows the places of the pen by a rule that ignores
//! time:
//!
//! - Average: the brush is at the mean of the last piece of the pen's path, which has a set length.
//!   Each part weighs as much as it is long, so it does not matter how often a device reports. On a
//!   straight path the brush stays half the length behind.
//! - String: the pen pulls the brush by a string. The brush moves only while the string is taut,
//!   towards the pen.
//!
//! When you lift the pen, the brush catches up with its last place.
//!
//! This also derives a pressure from the speed, for devices that measure none. A slow movement
//! presses more: the pressure is `FAST + (SLOW - FAST) / (1 + speed / MEDIUM)`, for example 0.70 at
//! rest, 0.475 at 500 points per second and 0.25 at very high speed. (A point is 1/96 inch, so 500
//! points are 132 mm.) We smooth the speed over 0.2 s and start at 500, so that every stroke begins
//! at a moderate pressure. This pressure changes by at most the full pressure a second, because
//! even a steady hand moves unevenly. At the start of a stroke the pressure rises from a fifth to
//! the full value over 10 points of path or 60 ms, whichever comes first. At the end it falls to 0.
//! We chose all constants by eye.

use std::collections::VecDeque;

use eframe::egui::Pos2;
use session::brushes::StabiliserMethod;

/// Number of steps in which a brush catches up with its pen.
const CATCH_UP_STEPS: usize = 8;

type Place = (f64, f64);

/// The brush of one stroke, which stays behind its pen.
#[derive(Debug, Clone)]
pub(super) struct Stabiliser {
    method: StabiliserMethod,
    length_mm: f64,
    /// Places of the pen, the last first, as far back as we need them for the mean.
    way: VecDeque<Place>,
    brush: Option<Place>,
}

impl Stabiliser {
    /// A stabiliser for a new stroke. A length of 0 or less switches it off.
    pub(super) fn new(method: StabiliserMethod, length_mm: f64) -> Self {
        let method = if length_mm > 0.0 { method } else { StabiliserMethod::Off };
        Self { method, length_mm, way: VecDeque::new(), brush: None }
    }

    /// Whether the stabiliser is off, so that the brush is always at the pen.
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

    /// Returns the places through which the brush catches up with the pen. The last is the place of
    /// the pen. If the brush is there already, there are none. After this call the brush is at the
    /// pen.
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

    /// Drops places that are too far back for the mean.
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

pub(super) fn distance(from: Place, to: Place) -> f64 {
    (to.0 - from.0).hypot(to.1 - from.1)
}

/// Place of a brush after the pen at `pen` has pulled it by a string of this length.
fn pulled(brush: Place, pen: Place, length_mm: f64) -> Place {
    let slack = length_mm / distance(brush, pen);
    // A brush at the pen has an infinite slack.
    if slack < 1.0 {
        (pen.0 + (brush.0 - pen.0) * slack, pen.1 + (brush.1 - pen.1) * slack)
    } else {
        brush
    }
}

/// Mean of the last `length_mm` of a path, or of all of it if it is shorter. In `way`, the last
/// place comes first.
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
        // We sum relative to the pen, so that a resting pen has no rounding error.
        sum.0 += (middle.0 - pen.0) * part;
        sum.1 += (middle.1 - pen.1) * part;
        reached += part;
    }
    if reached > 0.0 { (pen.0 + sum.0 / reached, pen.1 + sum.1 / reached) } else { pen }
}

fn length(way: &VecDeque<Place>) -> f64 {
    way.iter().zip(way.iter().skip(1)).map(|(&to, &from)| distance(from, to)).sum()
}

/// Pressure at speed 0.
pub(super) const SLOW: f64 = 0.70;
/// Limit of the pressure at high speed.
pub(super) const FAST: f64 = 0.25;
/// Speed at which the pressure is midway between `SLOW` and `FAST`, in points per second.
pub(super) const MEDIUM: f64 = 500.0;
/// Time constant of the smoothed speed, in seconds.
const SMOOTHING_SECONDS: f64 = 0.2;
/// The pressure by speed changes at most this fast, in full pressures per second.
const FASTEST_CHANGE: f64 = 1.0;
/// Fraction of the full pressure with which a stroke starts.
const START_SHARE: f64 = 0.2;
/// The pressure rises to its full value over this length of path, in points.
const START_POINTS: f64 = 10.0;
/// The pressure rises to its full value over this time, in seconds.
const START_SECONDS: f64 = 0.06;
/// Longest time step for the speed, in seconds. Without this limit, the first movement after a
/// pause would count as slow and press too hard.
const LONGEST_STEP_SECONDS: f64 = 0.05;
/// Shortest time step for the speed, in seconds. We add a shorter one to the next step.
const SHORTEST_STEP_SECONDS: f64 = 5e-4;

/// Pressure of one stroke, updated with each movement.
#[derive(Debug, Clone)]
pub(super) struct SpeedPressure {
    /// Smoothed speed in points per second.
    speed: f64,
    /// Pressure by speed, without the rise at the start.
    full: f64,
    /// Path length since the start of the stroke, in points.
    path: f64,
    /// Path length since `measured`, in points.
    step: f64,
    last: Pos2,
    began: f64,
    /// Time in seconds at which the speed was last updated.
    measured: f64,
}

impl SpeedPressure {
    /// A stroke that starts at a point of the window, at a time in seconds.
    #[must_use]
    pub(super) fn new(at: Pos2, seconds: f64) -> Self {
        let speed = MEDIUM;
        let full = by_speed(MEDIUM);
        Self { speed, full, path: 0.0, step: 0.0, last: at, began: seconds, measured: seconds }
    }

    /// Skips the rise at the start, e.g. after a straight line.
    #[must_use]
    pub(super) fn at_full_pressure(mut self) -> Self {
        self.path = START_POINTS;
        self
    }

    /// Moves to a point and returns the pressure there, 0 to 1.
    pub(super) fn move_to(&mut self, at: Pos2, seconds: f64) -> f64 {
        let step = f64::from((at - self.last).length());
        self.last = at;
        self.path += step;
        self.step += step;
        let passed = seconds - self.measured;
        if passed >= SHORTEST_STEP_SECONDS {
            let passed = passed.min(LONGEST_STEP_SECONDS);
            let share = 1.0 - (-passed / SMOOTHING_SECONDS).exp();
            self.speed += (self.step / passed - self.speed) * share;
            let most = FASTEST_CHANGE * passed;
            self.full += (by_speed(self.speed) - self.full).clamp(-most, most);
            self.step = 0.0;
            self.measured = seconds;
        }
        self.pressure(seconds)
    }

    #[must_use]
    pub(super) fn pressure(&self, seconds: f64) -> f64 {
        let done = (self.path / START_POINTS).max((seconds - self.began) / START_SECONDS);
        let done = done.clamp(0.0, 1.0);
        let eased = done * done * (3.0 - 2.0 * done);
        self.full * (START_SHARE + (1.0 - START_SHARE) * eased)
    }

    /// Pressures, 0 to 1, of the samples that end the stroke at its last position. The last is 0.
    /// If a click hardly moves, this begins with the full pressure, which it has not reached yet.
    #[must_use]
    pub(super) fn end_pressures(&self, seconds: f64) -> Vec<f64> {
        let mut lifted = Vec::new();
        let now = self.pressure(seconds);
        let full = self.pressure(f64::INFINITY);
        if self.path < 0.3 * START_POINTS && now < full {
            lifted.push(full);
        }
        let from = lifted.last().copied().unwrap_or(now);
        lifted.extend([0.5 * from, 0.0]);
        lifted
    }
}

/// Pressure of an even movement at `speed` points per second.
fn by_speed(speed: f64) -> f64 {
    FAST + (SLOW - FAST) / (1.0 + speed / MEDIUM)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    const METHODS: [StabiliserMethod; 2] = [StabiliserMethod::Average, StabiliserMethod::String];

    /// A line to the right with a jitter of 0.5 mm across.
    fn shaky() -> Vec<Place> {
        (0_u32..200)
            .map(|at| (0.3 * f64::from(at), if at.is_multiple_of(2) { 0.5 } else { -0.5 }))
            .collect()
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
        fn brush(steps: u32) -> Option<Place> {
            let mut brush = Stabiliser::new(StabiliserMethod::Average, 4.0);
            (0..=steps)
                .map(|at| brush.follow((10.0 * f64::from(at) / f64::from(steps), 0.0)))
                .last()
        }
        for steps in [5, 17, 400] {
            assert!(near(brush(steps).unwrap(), (8.0, 0.0)), "{steps}: {:?}", brush(steps));
        }
        let mut resting = Stabiliser::new(StabiliserMethod::Average, 4.0);
        (0..50).for_each(|_| assert_eq!(resting.follow((0.1, 0.7)), (0.1, 0.7)));
    }

    /// Pressure after one second of even movement at `speed` points per second, with `rate` reports
    /// a second.
    fn steady(speed: f32, rate: u16) -> f64 {
        let mut pressure_model = SpeedPressure::new(Pos2::ZERO, 0.0);
        let mut pressure = 0.0;
        for step in 1..=rate {
            let share = f32::from(step) / f32::from(rate);
            pressure = pressure_model.move_to(pos2(speed * share, 0.0), f64::from(share));
        }
        pressure
    }

    #[test]
    fn slower_presses_more_within_bounds() {
        let pressures: Vec<f64> =
            [1.0, 50.0, 200.0, 500.0, 1000.0, 4000.0, 100_000.0].map(|v| steady(v, 125)).to_vec();
        assert!(pressures.is_sorted_by(|a, b| a > b), "{pressures:?}");
        assert!(pressures.iter().all(|p| (FAST..=SLOW).contains(p)), "{pressures:?}");
        assert!((pressures[3] - 0.475).abs() < 1e-3, "{pressures:?}");
    }

    #[test]
    fn the_report_rate_of_a_mouse_does_not_matter() {
        for speed in [80.0, 900.0] {
            let seldom = steady(speed, 60);
            let often = steady(speed, 1000);
            assert!((seldom - often).abs() < 0.005, "{speed}: {seldom} {often}");
        }
    }

    #[test]
    fn an_even_hand_presses_evenly_although_its_reports_are_noisy() {
        // Steps in points of a hand that tries to move evenly, every 8 ms. A mouse sends whole
        // points, and reports come late or early.
        let steps =
            [3.0, 5.0, 0.0, 8.0, 4.0, 3.0, 6.0, 1.0, 7.0, 4.0, 2.0, 5.0, 9.0, 0.0, 4.0, 3.0];
        let mut pressure_model = SpeedPressure::new(Pos2::ZERO, 0.0);
        let mut x = 0.0;
        let mut seconds = 0.0;
        let mut pressures = Vec::new();
        for step in steps.iter().cycle().take(240) {
            x += step;
            seconds += 0.008;
            pressures.push(pressure_model.move_to(pos2(x, 0.0), seconds));
        }
        let even = &pressures[30..];
        let steps = even.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        assert!(steps.fold(0.0, f64::max) < 0.008, "{even:?}");
        let mean = even.iter().sum::<f64>() / even.len() as f64;
        let spread = even.iter().map(|p| (p - mean) * (p - mean)).sum::<f64>();
        let roughness = (spread / even.len() as f64).sqrt();
        assert!(roughness < 0.006, "{roughness}");
    }

    #[test]
    fn a_sudden_movement_changes_the_pressure_by_no_more_than_its_whole_a_second() {
        let mut pressure_model = SpeedPressure::new(Pos2::ZERO, 0.0).at_full_pressure();
        let mut last = pressure_model.pressure(0.0);
        for (x, seconds) in [(900.0, 0.01), (2000.0, 0.03), (2000.0, 0.05), (9000.0, 0.1)] {
            let pressure = pressure_model.move_to(pos2(x, 0.0), seconds);
            assert!(last - pressure <= 0.0501, "{pressure} after {last}");
            last = pressure;
        }
        assert!(last < 0.41, "{last}");
    }

    #[test]
    fn pressure_rises_by_path_or_by_time() {
        let mut pressure_model = SpeedPressure::new(Pos2::ZERO, 3.0);
        let first = pressure_model.pressure(3.0);
        assert!((first - 0.2 * 0.475).abs() < 1e-9, "{first}");
        assert!(
            (pressure_model.pressure(3.06) - 0.475).abs() < 1e-9,
            "{}",
            pressure_model.pressure(3.06)
        );
        let on = pressure_model.move_to(pos2(10.0, 0.0), 3.02);
        assert!((on - 0.475).abs() < 1e-9, "{on}");
        let far = SpeedPressure::new(Pos2::ZERO, 0.0).at_full_pressure().pressure(0.0);
        assert!((far - 0.475).abs() < 1e-9, "{far}");
    }

    #[test]
    fn pressure_never_jumps() {
        let mut pressure_model = SpeedPressure::new(Pos2::ZERO, 0.0);
        let mut last = pressure_model.pressure(0.0);
        let mut x = 0.0;
        // This is a sudden movement, two events at one time, then a pause of a second.
        let steps = [(1.0, 0.004), (3.0, 0.008), (40.0, 0.012), (9.0, 0.012), (0.5, 1.012)];
        for (step, seconds) in steps {
            x += step;
            let pressure = pressure_model.move_to(pos2(x, 0.0), seconds);
            assert!((pressure - last).abs() < 0.35, "{pressure} after {last}");
            assert!((0.0..=SLOW).contains(&pressure), "{pressure}");
            last = pressure;
        }
        // After a pause, the speed of the next step is not reduced.
        let mut pressure_model = SpeedPressure::new(Pos2::ZERO, 0.0).at_full_pressure();
        let after = pressure_model.move_to(pos2(25.0, 0.0), 1.0);
        assert!((after - 0.475).abs() < 1e-9, "{after}");
    }

    #[test]
    fn pressure_ends_at_zero_and_a_click_presses_fully() {
        let pressure_model = SpeedPressure::new(Pos2::ZERO, 0.0);
        assert_eq!(pressure_model.end_pressures(0.01).len(), 3);
        assert!(
            (pressure_model.end_pressures(0.01)[0] - 0.475).abs() < 1e-9,
            "{:?}",
            pressure_model.end_pressures(0.01)
        );
        let mut pressure_model = pressure_model;
        let pressure = pressure_model.move_to(pos2(30.0, 0.0), 0.1);
        assert_eq!(pressure_model.end_pressures(0.1), [0.5 * pressure, 0.0]);
    }
}
