//! Measures the frame rate and the latency from pen sample to screen.

use std::collections::VecDeque;
use web_time::{Duration, Instant};

use crate::panels::figures::FrameRate;

/// Time span of the statistics.
const WINDOW: Duration = Duration::from_secs(1);

/// Frame times and sample latencies of the last second.
#[derive(Debug, Clone, Default)]
pub struct Frames {
    starts: VecDeque<Instant>,
    latencies: VecDeque<(Instant, Duration)>,
    began: Option<Instant>,
    newest: Option<Instant>,
}

impl Frames {
    /// Records the start of a frame. `busy` is the processing time of the previous
    /// frame including drawing, if known.
    pub fn begin(&mut self, now: Instant, busy: Option<Duration>) {
        if let (Some(began), Some(newest)) = (self.began, self.newest.take()) {
            let finished = began + busy.unwrap_or_else(|| now - began);
            self.latencies.push_back((finished, finished.saturating_duration_since(newest)));
        }
        self.began = Some(now);
        self.starts.push_back(now);
        self.forget(now);
    }

    /// Records that this frame shows a pen sample that arrived at `arrived`.
    pub fn shows(&mut self, arrived: Instant) {
        self.newest = Some(self.newest.map_or(arrived, |newest| newest.max(arrived)));
    }

    /// Statistics of the last second.
    #[must_use]
    pub fn rate(&self) -> FrameRate {
        let latency_values: Vec<f64> =
            self.latencies.iter().map(|(_, time)| time.as_secs_f64() * 1000.0).collect();
        let latency_ms = latency_values.iter().fold(0.0, |sum, ms| sum + ms)
            / latency_values.len().max(1) as f64;
        let worst_ms = latency_values.iter().copied().fold(0.0, f64::max);
        FrameRate { frames_a_second: self.starts.len() as f64, latency_ms, worst_ms }
    }

    fn forget(&mut self, now: Instant) {
        let old = |at: &Instant| now.saturating_duration_since(*at) >= WINDOW;
        while self.starts.front().is_some_and(old) {
            self.starts.pop_front();
        }
        while self.latencies.front().is_some_and(|(at, _)| old(at)) {
            self.latencies.pop_front();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn frames_of_the_last_second_are_counted() {
        let mut frames = Frames::default();
        let start = Instant::now();
        for frame in 0..100 {
            frames.begin(start + frame * 20 * MS, None);
        }
        assert_eq!(frames.rate().frames_a_second, 50.0);
    }

    #[test]
    fn latency_is_from_arrival_to_the_end_of_the_frame() {
        let mut frames = Frames::default();
        let start = Instant::now();
        frames.begin(start + 30 * MS, None);
        frames.shows(start + 10 * MS);
        frames.shows(start + 5 * MS);
        // This frame took 12 ms. The next starts later because it waited for the screen.
        frames.begin(start + 60 * MS, Some(12 * MS));
        frames.shows(start + 50 * MS);
        frames.begin(start + 90 * MS, Some(18 * MS));
        let rate = frames.rate();
        assert!((rate.latency_ms - 30.0).abs() < 1e-9, "{rate:?}");
        assert!((rate.worst_ms - 32.0).abs() < 1e-9, "{rate:?}");
        frames.begin(start + 1500 * MS, Some(MS));
        assert_eq!(frames.rate().latency_ms, 0.0);
    }
}
