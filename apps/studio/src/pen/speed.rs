//! Pressure for devices that measure none, derived from the speed of the pointer.
//!
//! A slow movement presses more: the pressure is
//! `FAST + (SLOW - FAST) / (1 + speed / MEDIUM)`, that is 0.70 at rest, 0.475 at 500 points
//! per second and 0.25 at very high speed. (A point is 1/96 inch, so 500 points are 132
//! mm.) The speed is smoothed over 0.2 s and starts at 500, so that every stroke begins at a
//! moderate pressure; the pressure that follows from it changes by at most the full pressure a
//! second, because even a steady hand moves unevenly. At the start of a stroke the pressure
//! rises from a fifth to the full value over 10 points of path or 60 ms, whichever comes first;
//! at the end it falls to 0. All constants were chosen by eye.

use eframe::egui::Pos2;

/// Pressure at speed 0.
pub(super) const SLOW: f64 = 0.70;
/// Limit of the pressure at high speed.
pub(super) const FAST: f64 = 0.25;
/// Speed at which the pressure is midway between `SLOW` and `FAST`, in points per second.
pub(super) const MEDIUM: f64 = 500.0;
/// Time constant of the smoothed speed, in seconds.
const SMOOTHING_SECONDS: f64 = 0.2;
/// Largest change of the pressure that follows from the speed, in full pressures per second.
const FASTEST_CHANGE: f64 = 1.0;
/// Fraction of the full pressure with which a stroke starts.
const START_SHARE: f64 = 0.2;
/// Path length over which the pressure rises to its full value, in points.
const START_POINTS: f64 = 10.0;
/// Time over which the pressure rises to its full value, in seconds.
const START_SECONDS: f64 = 0.06;
/// Longest time step from which the speed is computed, in seconds. Without it, the first
/// movement after a pause would count as slow and press too hard.
const LONGEST_STEP_SECONDS: f64 = 0.05;
/// Shortest time step from which the speed is computed, in seconds; shorter steps are added
/// to the next one.
const SHORTEST_STEP_SECONDS: f64 = 5e-4;

/// Pressure of one stroke, updated with each movement.
#[derive(Debug, Clone)]
pub(super) struct SpeedPressure {
    /// Smoothed speed in points per second.
    speed: f64,
    /// Pressure that follows from the speed, without the rise at the start.
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

    /// Skips the initial rise: the stroke is at its full pressure.
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

    /// Pressure at a time without further movement, 0 to 1.
    #[must_use]
    pub(super) fn pressure(&self, seconds: f64) -> f64 {
        let done = (self.path / START_POINTS).max((seconds - self.began) / START_SECONDS);
        let done = done.clamp(0.0, 1.0);
        let eased = done * done * (3.0 - 2.0 * done);
        self.full * (START_SHARE + (1.0 - START_SHARE) * eased)
    }

    /// Pressures, 0 to 1, of the samples that end the stroke at its last position; the last
    /// is 0. A click with almost no movement begins with the full pressure, which it has
    /// not reached yet.
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
    use eframe::egui::pos2;

    use super::*;

    /// Pressure after one second of even movement at `speed` points per second, reported
    /// `rate` times a second.
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
        // Steps in points of a hand that means to go evenly, every 8 ms: whole points, late and
        // early reports, as a mouse sends them.
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
        // A sudden movement, two events at one time, then a pause of a second.
        let steps = [(1.0, 0.004), (3.0, 0.008), (40.0, 0.012), (9.0, 0.012), (0.5, 1.012)];
        for (step, seconds) in steps {
            x += step;
            let pressure = pressure_model.move_to(pos2(x, 0.0), seconds);
            assert!((pressure - last).abs() < 0.35, "{pressure} after {last}");
            assert!((0.0..=SLOW).contains(&pressure), "{pressure}");
            last = pressure;
        }
        // A pause does not reduce the speed of the step after it.
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
