//! Converts millisecond timestamps of a window system to [`Instant`]s of this program.

use web_time::{Duration, Instant};

/// A timestamp that maps to an instant further in the past than this belongs to another
/// clock.
const STALE: Duration = Duration::from_secs(5);

/// Converts timestamps to instants. The report with the least delay so far defines the
/// offset between the two clocks, so time spent in a queue does not distort the times of a
/// stroke.
#[derive(Debug, Default)]
pub(super) struct StampClock {
    /// The last timestamp in ms and the instant it was mapped to.
    last: Option<(u32, Instant)>,
}

impl StampClock {
    /// Returns the instant of the timestamp `stamp_ms` (wraps at 2^32) of an event that was
    /// received at `arrived`. The result is never later than `arrived`.
    pub(super) fn instant(&mut self, stamp_ms: u32, arrived: Instant) -> Instant {
        let mapped = self.last.and_then(|(stamp, instant)| {
            // Signed, because this timestamp may be earlier than the last one.
            let later = i64::from(stamp_ms.wrapping_sub(stamp).cast_signed());
            let step = Duration::from_millis(later.unsigned_abs());
            if later < 0 { instant.checked_sub(step) } else { instant.checked_add(step) }
        });
        let plausible = mapped.filter(|&at| at <= arrived && arrived - at < STALE);
        let at = plausible.unwrap_or(arrived);
        // Updated at every event, so that clocks that drift apart are followed.
        self.last = Some((stamp_ms, at));
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_follow_the_timestamps_whatever_the_delay() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut clock = StampClock::default();
        assert_eq!(clock.instant(1000, at(10)), at(10));
        // These events were delayed, the last by 26 ms.
        assert_eq!(clock.instant(1004, at(40)), at(14));
        assert_eq!(clock.instant(1008, at(40)), at(18));
        // This event had less delay than all before it.
        assert_eq!(clock.instant(1058, at(60)), at(60));
        assert_eq!(clock.instant(1060, at(90)), at(62));
    }

    #[test]
    fn timestamps_may_wrap_and_jump() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut clock = StampClock::default();
        assert_eq!(clock.instant(u32::MAX, at(0)), at(0));
        assert_eq!(clock.instant(4, at(20)), at(5));
        // A timestamp of an unrelated clock.
        assert_eq!(clock.instant(90_000_000, at(30)), at(30));
        assert_eq!(clock.instant(7, at(40)), at(40));
        assert_eq!(clock.instant(8, at(9_000)), at(9_000));
    }
}
