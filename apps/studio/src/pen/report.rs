//! Reports of input devices, before they become strokes, with their times from the window system.
//! [`Script`] is a synthetic pen for tests and demonstrations.

use std::collections::VecDeque;

use eframe::egui::Pos2;
use web_time::{Duration, Instant};

/// The device that you use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Device {
    /// A mouse, or a device that acts as one.
    Mouse,
    /// A finger on a touch screen.
    Touch,
    /// The tip of a stylus.
    Pen,
    /// The eraser end of a stylus.
    Eraser,
}

impl Device {
    /// Whether this is a stylus, held either way round.
    #[must_use]
    pub const fn is_pen(self) -> bool {
        matches!(self, Self::Pen | Self::Eraser)
    }
}

/// Position and attitude of a device. If it does not measure a quantity, this is `None`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointerState {
    /// Position in points of the window.
    pub at: Pos2,
    /// Pressure, 0 to 1.
    pub pressure: Option<f64>,
    /// Tilt towards the right and the lower edge of the window, in degrees from upright.
    pub tilt_deg: Option<(f64, f64)>,
    /// Rotation about the device's own axis, clockwise from above, in degrees.
    pub twist_deg: Option<f64>,
}

impl PointerState {
    /// State of a device that measures only its position.
    #[must_use]
    pub const fn at(at: Pos2) -> Self {
        Self { at, pressure: None, tilt_deg: None, twist_deg: None }
    }

    /// Whether every value is finite.
    pub(super) fn is_finite(&self) -> bool {
        let (tilt_x, tilt_y) = self.tilt_deg.unwrap_or_default();
        let rest = [self.pressure.unwrap_or_default(), self.twist_deg.unwrap_or_default()];
        self.at.is_finite()
            && tilt_x.is_finite()
            && tilt_y.is_finite()
            && rest.iter().all(|number| number.is_finite())
    }
}

/// The event that a report describes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ReportKind {
    /// The device moved to this state.
    Moved(PointerState),
    /// The device touched the surface, or its primary button was pressed.
    Pressed(PointerState),
    /// You lifted the device or released its primary button.
    Released,
    /// The device left the range of the system.
    Gone,
    /// A button on the barrel of a stylus.
    Barrel {
        /// Button number; 0 is the button nearest to the tip.
        button: usize,
        /// Whether you pressed the button. False means you released it.
        pressed: bool,
    },
}

/// One event of an input device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// The device that caused the event.
    pub device: Device,
    /// Time of the event, as exactly as the system reports it.
    pub arrived: Instant,
    /// The event and the state of the device.
    pub kind: ReportKind,
}

/// Reports of one device, each with its time since the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Script {
    device: Device,
    steps: Vec<(Duration, ReportKind)>,
    next: usize,
}

impl Script {
    /// An empty script for one device.
    #[must_use]
    pub const fn new(device: Device) -> Self {
        Self { device, steps: Vec::new(), next: 0 }
    }

    /// Adds an event `after` the previous one.
    #[must_use]
    pub fn then(mut self, after: Duration, kind: ReportKind) -> Self {
        self.steps.push((self.length() + after, kind));
        self
    }

    /// Adds a stroke: pressed at the first state, moved through the others at intervals of `every`,
    /// and released.
    #[must_use]
    pub fn stroke(
        mut self,
        holds: impl IntoIterator<Item = PointerState>,
        every: Duration,
    ) -> Self {
        for (order, state) in holds.into_iter().enumerate() {
            let kind =
                if order == 0 { ReportKind::Pressed(state) } else { ReportKind::Moved(state) };
            self = self.then(every, kind);
        }
        self.then(every, ReportKind::Released)
    }

    /// Duration from the start to the last event.
    #[must_use]
    pub fn length(&self) -> Duration {
        self.steps.last().map_or(Duration::ZERO, |&(at, _)| at)
    }

    /// Reports that became due since the last call, for a script that began at `start`.
    pub fn due(&mut self, start: Instant, now: Instant) -> Vec<Report> {
        let mut due = Vec::new();
        while let Some(&(at, kind)) = self.steps.get(self.next)
            && start + at <= now
        {
            due.push(Report { device: self.device, arrived: start + at, kind });
            self.next += 1;
        }
        due
    }
}

/// A time from the window system belongs to an event if their places are at most this far apart, in
/// points.
const SAME_POINTS: f32 = 0.75;

/// We drop times older than this, because their events did not come.
const OLD: Duration = Duration::from_millis(200);

/// Time of a mouse event from the window system, with the place of the mouse.
pub(super) type Stamp = (Pos2, Instant);

/// Times from the window system that wait for their events, in order.
///
/// The events of the window carry no times, so we match them by their places.
#[derive(Debug, Default)]
pub(super) struct Stamps(VecDeque<Stamp>);

impl Stamps {
    /// Adds times, in order.
    pub(super) fn extend(&mut self, stamps: impl IntoIterator<Item = Stamp>) {
        self.0.extend(stamps);
    }

    /// The time of the next event, which is at `place`; `None` if we do not know it. This removes
    /// the time and those before it.
    pub(super) fn take(&mut self, place: Pos2, now: Instant) -> Option<Instant> {
        while self.0.front().is_some_and(|stamp| now.saturating_duration_since(stamp.1) > OLD) {
            self.0.pop_front();
        }
        let found = self.0.iter().position(|stamp| stamp.0.distance(place) < SAME_POINTS)?;
        self.0.drain(..=found).next_back().map(|stamp| stamp.1)
    }
}

/// Fills in unknown times. They are spread evenly from the known time before (or `from`) to the
/// known time after (or `to`). The times never decrease, and lie between `from` and `to`.
pub(super) fn filled(known: &[Option<Instant>], from: Instant, to: Instant) -> Vec<Instant> {
    let mut times = Vec::with_capacity(known.len());
    let mut last = from;
    while times.len() < known.len() {
        let rest = &known[times.len()..];
        let unknown = rest.iter().take_while(|time| time.is_none()).count();
        let next = rest.get(unknown).copied().flatten();
        let until = next.unwrap_or(to).clamp(last, to.max(last));
        // The known event ends the gap. If there is none, the last of the gap does.
        let parts = unknown + usize::from(next.is_some());
        for part in 1..=parts {
            times.push(last + (until - last).mul_f64(part as f64 / parts as f64));
        }
        last = until;
    }
    times
}

/// If a timestamp maps to an instant further in the past than this, it belongs to another clock.
#[cfg(any(test, target_os = "linux", windows))]
const STALE: Duration = Duration::from_secs(5);

/// Converts timestamps to instants. The report with the smallest delay so far defines the offset
/// between the two clocks, so time in a queue does not distort the times of a stroke.
#[derive(Debug, Default)]
#[cfg(any(test, target_os = "linux", windows))]
pub(super) struct StampClock {
    /// The last timestamp in ms and its instant.
    last: Option<(u32, Instant)>,
}

#[cfg(any(test, target_os = "linux", windows))]
impl StampClock {
    /// Returns the instant of the timestamp `stamp_ms` (wraps at 2^32) of an event that you
    /// received at `arrived`. The result is never later than `arrived`.
    pub(super) fn instant(&mut self, stamp_ms: u32, arrived: Instant) -> Instant {
        let mapped = self.last.and_then(|(stamp, instant)| {
            // This is signed, because the timestamp may be earlier than the last one.
            let later = i64::from(stamp_ms.wrapping_sub(stamp).cast_signed());
            let step = Duration::from_millis(later.unsigned_abs());
            if later < 0 { instant.checked_sub(step) } else { instant.checked_add(step) }
        });
        let plausible = mapped.filter(|&at| at <= arrived && arrived - at < STALE);
        let at = plausible.unwrap_or(arrived);
        // We update this at every event, to follow clocks that drift apart.
        self.last = Some((stamp_ms, at));
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn events_get_the_times_of_their_places() {
        let start = Instant::now();
        let mut stamps = Stamps::default();
        let moves = [(1.0, 1_u32), (2.0, 4), (3.0, 9), (2.0, 12)];
        stamps.extend(moves.map(|(x, ms)| (pos2(x, 0.0), start + ms * MS)));
        let now = start + 20 * MS;
        assert_eq!(stamps.take(pos2(2.2, 0.0), now), Some(start + 4 * MS));
        // The report before it is gone, and a missing one removes none.
        assert_eq!(stamps.take(pos2(1.0, 0.0), now), None);
        assert_eq!(stamps.take(pos2(9.0, 0.0), now), None);
        assert_eq!(stamps.take(pos2(2.0, 0.0), now), Some(start + 12 * MS));
        assert_eq!(stamps.take(pos2(3.0, 0.0), now), None);
        stamps.extend([(pos2(5.0, 0.0), start + 30 * MS)]);
        assert_eq!(stamps.take(pos2(5.0, 0.0), start + 900 * MS), None);
    }

    #[test]
    fn unknown_times_are_spread_between_known_ones() {
        let start = Instant::now();
        let known = [None, Some(4_u32), None, None, Some(10), Some(7), None, None];
        let known = known.map(|ms| Some(start + ms? * MS));
        let wanted = [2_u32, 4, 6, 8, 10, 10, 15, 20].map(|ms| start + ms * MS);
        let last = start + 20 * MS;
        assert_eq!(filled(&known, start, last), wanted);
        let outside = [90_u32, 1].map(|ms| Some(start + ms * MS));
        assert_eq!(filled(&outside, start + 5 * MS, last), [last, last]);
        assert!(filled(&[], start + 5 * MS, last).is_empty());
    }

    #[test]
    fn times_follow_the_timestamps_whatever_the_delay() {
        let start = Instant::now();
        let mut clock = StampClock::default();
        for (stamp, arrived, wanted) in [
            (1000, 10_u32, 10_u32),
            // These events were delayed, the last by 26 ms.
            (1004, 40, 14),
            (1008, 40, 18),
            // This event had less delay than all before it.
            (1058, 60, 60),
            (1060, 90, 62),
        ] {
            let found = clock.instant(stamp, start + arrived * MS);
            assert_eq!(found, start + wanted * MS, "{stamp}");
        }
    }

    #[test]
    fn timestamps_may_wrap_and_jump() {
        let start = Instant::now();
        let mut clock = StampClock::default();
        for (stamp, arrived, wanted) in [
            (u32::MAX, 0_u32, 0_u32),
            (4, 20, 5),
            // This timestamp comes from an unrelated clock.
            (90_000_000, 30, 30),
            (7, 40, 40),
            (8, 9_000, 9_000),
        ] {
            let found = clock.instant(stamp, start + arrived * MS);
            assert_eq!(found, start + wanted * MS, "{stamp}");
        }
    }
}
