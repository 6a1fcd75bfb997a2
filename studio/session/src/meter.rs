//! How the worker keeps up.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use super::state::Performance;

/// What the figures look back on.
const SPAN: Duration = Duration::from_secs(1);

/// The sub-steps of one slice are as many as take about this long, so that the
/// picture can follow and commands are heard.
const SLICE: Duration = Duration::from_millis(8);

/// Counts sub-steps and the way of samples to the screen.
#[derive(Debug)]
pub(super) struct Meter {
    /// Slices: when they ended, how many sub-steps, and what they took.
    played: VecDeque<(Instant, usize, Duration)>,
    /// Samples: when the window was told, and after how many ms.
    shown: VecDeque<(Instant, f64)>,
    /// Sub-steps a second while playing, as last measured.
    speed: f64,
}

impl Default for Meter {
    fn default() -> Self {
        // A guess that the first slices put right.
        Self { played: VecDeque::new(), shown: VecDeque::new(), speed: 2000.0 }
    }
}

impl Meter {
    /// How many sub-steps the next slice may have.
    pub(super) fn slice(&self) -> usize {
        ((self.speed * SLICE.as_secs_f64()) as usize).clamp(8, 4096)
    }

    /// A slice of `substeps` took `time`.
    pub(super) fn played(&mut self, now: Instant, substeps: usize, time: Duration) {
        if substeps == 0 {
            return;
        }
        self.played.push_back((now, substeps, time));
        let measured = substeps as f64 / time.as_secs_f64().max(1e-6);
        // Contacts differ: follow within a few slices, without a jump.
        self.speed += 0.3 * (measured - self.speed);
    }

    /// A sample that arrived then can be seen now.
    pub(super) fn shown(&mut self, now: Instant, arrived: Instant) {
        let ms = now.saturating_duration_since(arrived).as_secs_f64() * 1000.0;
        self.shown.push_back((now, ms));
    }

    /// Whether there is nothing to tell of.
    pub(super) fn is_idle(&self) -> bool {
        self.played.is_empty() && self.shown.is_empty()
    }

    /// The figures of the last second, with `behind` sub-steps that wait.
    pub(super) fn figures(&mut self, now: Instant, behind: usize) -> Performance {
        let old = |at: Instant| now.saturating_duration_since(at) > SPAN;
        while self.played.front().is_some_and(|(at, ..)| old(*at)) {
            self.played.pop_front();
        }
        while self.shown.front().is_some_and(|(at, _)| old(*at)) {
            self.shown.pop_front();
        }
        let substeps: usize = self.played.iter().map(|(_, substeps, _)| substeps).sum();
        let total_ms: f64 = self.shown.iter().map(|(_, ms)| ms).sum();
        Performance {
            substeps_per_second: substeps as f64 / SPAN.as_secs_f64(),
            waiting_substeps: behind,
            mean_latency_ms: total_ms / self.shown.len().max(1) as f64,
            max_latency_ms: self.shown.iter().map(|(_, ms)| *ms).fold(0.0, f64::max),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_of_the_last_second() {
        let mut meter = Meter::default();
        let start = Instant::now();
        let at = |ms: u64| start + Duration::from_millis(ms);
        meter.played(at(0), 500, Duration::from_millis(100));
        meter.played(at(900), 300, Duration::from_millis(100));
        meter.shown(at(0), start);
        meter.shown(at(900), at(880));
        meter.shown(at(900), at(890));
        meter.shown(at(950), at(890));
        let figures = meter.figures(at(1100), 7);
        assert_eq!((figures.substeps_per_second, figures.waiting_substeps), (300.0, 7));
        assert_eq!((figures.mean_latency_ms, figures.max_latency_ms), (30.0, 60.0));
        let later = meter.figures(at(5000), 0);
        assert_eq!(later, Performance::default(), "nothing happened for a second");
    }

    #[test]
    fn slices_take_about_as_long_as_they_should() {
        let mut meter = Meter::default();
        for _ in 0..40 {
            let substeps = meter.slice();
            // A machine that plays 40,000 sub-steps a second.
            let time = Duration::from_secs_f64(substeps as f64 / 40_000.0);
            meter.played(Instant::now(), substeps, time);
        }
        assert!((300..=340).contains(&meter.slice()), "8 ms, found {} sub-steps", meter.slice());
        meter.played(Instant::now(), 1, Duration::from_secs(1));
        assert!(meter.slice() >= 8, "a slow slice does not stop the next");
    }
}
