//! Pressure for what cannot tell it: from the speed of the hand.
//!
//! A slow hand presses more: pressure is
//! `FAST + (SLOW - FAST) / (1 + speed / MEDIUM)`, 0.70 at rest, 0.475 at 500
//! points a second, 0.25 at most speed. (A point is 1/96 inch, so 500 are 132
//! mm.) Speed is smoothed over 50 ms and begins at 500, so every stroke begins
//! at a moderate pressure. It lands softly: from a fifth to the whole over 10
//! points of way or 60 ms, whatever is first; and it is lifted where it ends.

use eframe::egui::Pos2;

/// Pressure at rest.
pub(super) const SLOW: f64 = 0.70;
/// Pressure that great speed approaches.
pub(super) const FAST: f64 = 0.25;
/// Speed midway, in points a second.
pub(super) const MEDIUM: f64 = 500.0;
/// Over which speed is smoothed, in seconds.
const SMOOTHING: f64 = 0.05;
/// The share of the pressure at which a stroke lands.
const LANDING: f64 = 0.2;
/// The way over which it lands, in points.
const LANDING_WAY: f64 = 10.0;
/// The seconds over which it lands.
const LANDING_SECONDS: f64 = 0.06;
/// A longer pause counts as this, so that the first step after it does not press
/// as if the hand had rested ever since.
const PAUSE: f64 = 0.05;
/// Steps shorter than this in seconds tell no speed alone.
const INSTANT: f64 = 5e-4;

/// The hand of one stroke.
#[derive(Debug, Clone)]
pub(super) struct SpeedPressure {
    /// Smoothed, in points a second.
    speed: f64,
    /// Points since the stroke began.
    way: f64,
    /// Points since `told`.
    step: f64,
    last: Pos2,
    began: f64,
    /// Seconds when the speed was last told.
    told: f64,
}

impl SpeedPressure {
    /// A stroke that begins at a point of the window, at some second.
    #[must_use]
    pub(super) fn new(at: Pos2, seconds: f64) -> Self {
        Self { speed: MEDIUM, way: 0.0, step: 0.0, last: at, began: seconds, told: seconds }
    }

    /// As one that has landed already.
    #[must_use]
    pub(super) fn landed(mut self) -> Self {
        self.way = LANDING_WAY;
        self
    }

    /// Goes on to a point, and gives the pressure there, 0..1.
    pub(super) fn lead(&mut self, at: Pos2, seconds: f64) -> f64 {
        let step = f64::from((at - self.last).length());
        self.last = at;
        self.way += step;
        self.step += step;
        let passed = seconds - self.told;
        if passed >= INSTANT {
            let passed = passed.min(PAUSE);
            let share = 1.0 - (-passed / SMOOTHING).exp();
            self.speed += (self.step / passed - self.speed) * share;
            self.step = 0.0;
            self.told = seconds;
        }
        self.pressure(seconds)
    }

    /// The pressure at a time at which it has not moved on.
    #[must_use]
    pub(super) fn pressure(&self, seconds: f64) -> f64 {
        let pressed = FAST + (SLOW - FAST) / (1.0 + self.speed / MEDIUM);
        let done = (self.way / LANDING_WAY).max((seconds - self.began) / LANDING_SECONDS);
        let done = done.clamp(0.0, 1.0);
        let eased = done * done * (3.0 - 2.0 * done);
        pressed * (LANDING + (1.0 - LANDING) * eased)
    }

    /// The pressures of lifting, at the place where it ends. What was no more
    /// than a click is pressed down first.
    #[must_use]
    pub(super) fn lift(&self, seconds: f64) -> Vec<f64> {
        let mut lifted = Vec::new();
        let now = self.pressure(seconds);
        let full = self.pressure(f64::INFINITY);
        if self.way < 0.3 * LANDING_WAY && now < full {
            lifted.push(full);
        }
        let from = lifted.last().copied().unwrap_or(now);
        lifted.extend([0.5 * from, 0.0]);
        lifted
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    /// The pressure after a second at an even speed in points a second, told this
    /// many times a second.
    fn steady(speed: f32, rate: u16) -> f64 {
        let mut hand = SpeedPressure::new(Pos2::ZERO, 0.0);
        let mut pressure = 0.0;
        for step in 1..=rate {
            let share = f32::from(step) / f32::from(rate);
            pressure = hand.lead(pos2(speed * share, 0.0), f64::from(share));
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
    fn how_often_a_mouse_tells_does_not_matter() {
        for speed in [80.0, 900.0] {
            let (seldom, often) = (steady(speed, 60), steady(speed, 1000));
            assert!((seldom - often).abs() < 0.005, "{speed}: {seldom} {often}");
        }
    }

    #[test]
    fn it_lands_softly_by_way_or_by_time() {
        let mut hand = SpeedPressure::new(Pos2::ZERO, 3.0);
        let first = hand.pressure(3.0);
        assert!((first - 0.2 * 0.475).abs() < 1e-9, "{first}");
        assert!((hand.pressure(3.06) - 0.475).abs() < 1e-9, "{}", hand.pressure(3.06));
        let on = hand.lead(pos2(10.0, 0.0), 3.02);
        assert!((on - 0.475).abs() < 1e-9, "{on}");
        let far = SpeedPressure::new(Pos2::ZERO, 0.0).landed().pressure(0.0);
        assert!((far - 0.475).abs() < 1e-9, "{far}");
    }

    #[test]
    fn nothing_jumps() {
        let mut hand = SpeedPressure::new(Pos2::ZERO, 0.0);
        let mut last = hand.pressure(0.0);
        let mut x = 0.0;
        // A jerk, two events at once, then a pause of a second.
        let steps = [(1.0, 0.004), (3.0, 0.008), (40.0, 0.012), (9.0, 0.012), (0.5, 1.012)];
        for (step, seconds) in steps {
            x += step;
            let pressure = hand.lead(pos2(x, 0.0), seconds);
            assert!((pressure - last).abs() < 0.35, "{pressure} after {last}");
            assert!((0.0..=SLOW).contains(&pressure), "{pressure}");
            last = pressure;
        }
        // A pause tells nothing of the step after it.
        let mut hand = SpeedPressure::new(Pos2::ZERO, 0.0).landed();
        let after = hand.lead(pos2(25.0, 0.0), 1.0);
        assert!((after - 0.475).abs() < 1e-9, "{after}");
    }

    #[test]
    fn it_is_lifted_and_a_click_is_a_touch() {
        let hand = SpeedPressure::new(Pos2::ZERO, 0.0);
        assert_eq!(hand.lift(0.01).len(), 3);
        assert!((hand.lift(0.01)[0] - 0.475).abs() < 1e-9, "{:?}", hand.lift(0.01));
        let mut hand = hand;
        let pressure = hand.lead(pos2(30.0, 0.0), 0.1);
        assert_eq!(hand.lift(0.1), [0.5 * pressure, 0.0]);
    }
}
