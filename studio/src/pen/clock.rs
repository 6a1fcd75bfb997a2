//! Milliseconds stamped by a system, on the program's own clock.

use std::time::{Duration, Instant};

/// Stamps further behind than this belong to another time.
const STALE: Duration = Duration::from_secs(5);

/// Maps stamps to instants. The stamp that arrived soonest tells how the clocks
/// differ, so that waiting in a queue does not blur the times of a stroke.
#[derive(Debug, Default)]
pub(super) struct StampClock {
    /// A stamp, and when it was.
    known: Option<(u32, Instant)>,
}

impl StampClock {
    /// When it was that a system stamped `stamp_ms` (which starts anew at 2^32) on
    /// something that arrived at `arrived`; never later than that.
    pub(super) fn instant(&mut self, stamp_ms: u32, arrived: Instant) -> Instant {
        let found = self.known.and_then(|(stamp, was)| {
            // As signed, so that a stamp may be earlier than the known one.
            let later = i64::from(stamp_ms.wrapping_sub(stamp).cast_signed());
            let step = Duration::from_millis(later.unsigned_abs());
            if later < 0 { was.checked_sub(step) } else { was.checked_add(step) }
        });
        let sound = found.filter(|&at| at <= arrived && arrived - at < STALE);
        let at = sound.unwrap_or(arrived);
        // Carried along, so that clocks that drift apart are followed.
        self.known = Some((stamp_ms, at));
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_the_stamps_whatever_the_queue_did() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut clock = StampClock::default();
        assert_eq!(clock.instant(1000, at(10)), at(10));
        // These waited, the last for 26 ms.
        assert_eq!(clock.instant(1004, at(40)), at(14));
        assert_eq!(clock.instant(1008, at(40)), at(18));
        // This one was faster than all before.
        assert_eq!(clock.instant(1058, at(60)), at(60));
        assert_eq!(clock.instant(1060, at(90)), at(62));
    }

    #[test]
    fn stamps_start_anew_and_jump() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut clock = StampClock::default();
        assert_eq!(clock.instant(u32::MAX, at(0)), at(0));
        assert_eq!(clock.instant(4, at(20)), at(5));
        // Another clock altogether.
        assert_eq!(clock.instant(90_000_000, at(30)), at(30));
        assert_eq!(clock.instant(7, at(40)), at(40));
        assert_eq!(clock.instant(8, at(9_000)), at(9_000));
    }
}
