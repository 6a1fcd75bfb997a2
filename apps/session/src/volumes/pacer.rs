//! How many steps are due, so that the time of a scene runs as the clock does.

use std::collections::VecDeque;
use web_time::{Duration, Instant};

/// Steps of a scene in a second.
pub const STEPS_A_SECOND: u64 = 120;

/// Most steps that may be due. What a slow machine owes beyond is forgotten: the scene becomes
/// slower, but never answers late.
const MOST_DUE: u64 = 12;

/// Time span of the speed.
const SPAN: Duration = Duration::from_secs(1);

/// Counts the steps that the clock owes to a scene.
#[derive(Debug, Default)]
pub(super) struct Pacer {
    /// When counting began, and the steps taken since.
    running: Option<(Instant, u64)>,
    recent: VecDeque<(Instant, u64)>,
}

impl Pacer {
    /// Begins to count at `now`, unless it counts already.
    pub(super) fn start(&mut self, now: Instant) {
        self.running.get_or_insert((now, 0));
    }

    /// Ends counting: time stands.
    pub(super) fn stop(&mut self) {
        self.running = None;
    }

    /// Steps due at `now`.
    pub(super) fn due(&mut self, now: Instant) -> u64 {
        let Some((since, taken)) = &mut self.running else { return 0 };
        let passed = now.saturating_duration_since(*since).as_nanos();
        let owed = (passed * u128::from(STEPS_A_SECOND) / 1_000_000_000) as u64;
        let due = owed.saturating_sub(*taken);
        if due > MOST_DUE {
            *taken = owed - MOST_DUE;
        }
        due.min(MOST_DUE)
    }

    /// Time at which the next step is due; `None` while time stands.
    pub(super) fn next(&self) -> Option<Instant> {
        let (since, taken) = self.running?;
        let nanoseconds = (taken + 1) * 1_000_000_000 / STEPS_A_SECOND + 1;
        Some(since + Duration::from_nanos(nanoseconds))
    }

    /// Counts `steps` that were taken until `now`.
    pub(super) fn took(&mut self, steps: u64, now: Instant) {
        if let Some((_, taken)) = &mut self.running {
            *taken += steps;
        }
        self.recent.push_back((now, steps));
    }

    /// Forgets the steps that are still due, because taking them would delay the answers.
    pub(super) fn forget(&mut self, now: Instant) {
        if self.running.is_some() {
            self.running = Some((now, 0));
        }
    }

    /// Speed over the last second, 1 in real time.
    pub(super) fn speed(&mut self, now: Instant) -> f64 {
        while self.recent.front().is_some_and(|(at, _)| now.saturating_duration_since(*at) > SPAN) {
            self.recent.pop_front();
        }
        let steps: u64 = self.recent.iter().map(|(_, steps)| steps).sum();
        steps as f64 / (STEPS_A_SECOND as f64 * SPAN.as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_has_120_steps_however_it_is_divided() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        pacer.start(start);
        let mut taken = 0;
        for millisecond in [0, 7, 8, 9, 41, 100, 101, 180, 260, 330, 420, 500, 590, 680] {
            let now = start + Duration::from_millis(millisecond);
            let due = pacer.due(now);
            pacer.took(due, now);
            taken += due;
        }
        assert_eq!(taken, 81, "680 ms are 81.6 steps");
        let next = pacer.next().unwrap();
        assert_eq!(pacer.due(next - Duration::from_nanos(2)), 0);
        assert_eq!(pacer.due(next), 1);
        assert!((pacer.speed(start + Duration::from_millis(990)) - 0.675).abs() < 1e-9);
    }

    #[test]
    fn a_slow_machine_forgets_what_it_owes() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        assert_eq!(pacer.due(start + Duration::from_secs(9)), 0, "time stands");
        pacer.start(start);
        let late = start + Duration::from_secs(3);
        assert_eq!(pacer.due(late), MOST_DUE);
        pacer.took(5, late);
        assert_eq!(pacer.due(late), MOST_DUE - 5, "the rest of them is still due");
        pacer.forget(late);
        assert_eq!(pacer.due(late), 0);
        assert_eq!(pacer.due(late + Duration::from_millis(17)), 2);
        pacer.stop();
        assert_eq!((pacer.due(late + SPAN), pacer.next()), (0, None));
    }
}
