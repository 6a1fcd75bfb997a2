//! Times of the events of mice, from the window system.

use std::collections::VecDeque;
use web_time::{Duration, Instant};

use eframe::egui::Pos2;

/// Distance in points within which a report of the window system is that of an event.
const SAME_POINTS: f32 = 0.75;

/// Age beyond which a report is of an event that never came.
const OLD: Duration = Duration::from_millis(200);

/// A report of the window system: where a mouse was, and when.
pub(super) type Stamp = (Pos2, Instant);

/// Reports of the window system that no event was found for yet, in order.
///
/// The events of the window carry no times, so that they are matched by their places.
#[derive(Debug, Default)]
pub(super) struct Stamps(VecDeque<Stamp>);

impl Stamps {
    /// Adds reports, in order.
    pub(super) fn extend(&mut self, stamps: impl IntoIterator<Item = Stamp>) {
        self.0.extend(stamps);
    }

    /// The time of the next event, which is at `place`; `None` if it was not reported. Removes
    /// it and the reports before it.
    pub(super) fn take(&mut self, place: Pos2, now: Instant) -> Option<Instant> {
        while self.0.front().is_some_and(|stamp| now.saturating_duration_since(stamp.1) > OLD) {
            self.0.pop_front();
        }
        let found = self.0.iter().position(|stamp| stamp.0.distance(place) < SAME_POINTS)?;
        self.0.drain(..=found).next_back().map(|stamp| stamp.1)
    }
}

/// Fills in times that are not known: spread evenly from the time before, at first `from`, to the
/// next that is known, at last `to`. The result never decreases and lies in `from` to `to`.
pub(super) fn filled(known: &[Option<Instant>], from: Instant, to: Instant) -> Vec<Instant> {
    let mut times = Vec::with_capacity(known.len());
    let mut last = from;
    while times.len() < known.len() {
        let rest = &known[times.len()..];
        let unknown = rest.iter().take_while(|time| time.is_none()).count();
        let next = rest.get(unknown).copied().flatten();
        let until = next.unwrap_or(to).clamp(last, to.max(last));
        // The event that is known ends the gap; without one the last of the gap does.
        let parts = unknown + usize::from(next.is_some());
        for part in 1..=parts {
            times.push(last + (until - last).mul_f64(part as f64 / parts as f64));
        }
        last = until;
    }
    times
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    #[test]
    fn events_get_the_times_of_their_places() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut stamps = Stamps::default();
        stamps.extend(
            [(1.0, 1), (2.0, 4), (3.0, 9), (2.0, 12)].map(|(x, ms)| (pos2(x, 0.0), at(ms))),
        );
        let mut take = |x, ms| stamps.take(pos2(x, 0.0), at(ms));
        assert_eq!(take(2.2, 20), Some(at(4)));
        // The report before it is gone, and one that is not there removes none.
        assert_eq!((take(1.0, 20), take(9.0, 20)), (None, None));
        assert_eq!(take(2.0, 20), Some(at(12)));
        assert_eq!(take(3.0, 20), None);
        stamps.extend([(pos2(5.0, 0.0), at(30))]);
        assert_eq!(stamps.take(pos2(5.0, 0.0), at(900)), None);
    }

    #[test]
    fn unknown_times_are_spread_between_known_ones() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let known = [None, Some(at(4)), None, None, Some(at(10)), Some(at(7)), None, None];
        let wanted = [2, 4, 6, 8, 10, 10, 15, 20].map(at);
        assert_eq!(filled(&known, at(0), at(20)), wanted);
        assert_eq!(filled(&[Some(at(90)), Some(at(1))], at(5), at(20)), [at(20), at(20)]);
        assert!(filled(&[], at(5), at(20)).is_empty());
    }
}
