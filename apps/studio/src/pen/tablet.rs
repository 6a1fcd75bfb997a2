//! Styluses under Wayland and Windows, through octotablet. This converts their millisecond
//! timestamps to [`Instant`]s of this program.

use std::panic::{AssertUnwindSafe, catch_unwind};

use eframe::egui::pos2;
use octotablet::axis::Pose;
use octotablet::events::{Event, FrameTimestamp, ToolEvent};
use octotablet::tool::{ButtonID, Type};
use octotablet::{Backend, Manager};
use web_time::{Duration, Instant};

use super::report::{Device, PointerState, Report, ReportKind};

pub(super) struct Tablet {
    /// Source of the events; `None` after it failed.
    manager: Option<Manager>,
    clock: StampClock,
    frame: EventFrame,
}

impl std::fmt::Debug for Tablet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Tablet").field("frame", &self.frame).finish_non_exhaustive()
    }
}

impl Tablet {
    pub(super) fn new(manager: Manager) -> Self {
        Self { manager: Some(manager), clock: StampClock::default(), frame: EventFrame::default() }
    }

    /// Whether a tablet is connected. Its events do not wake the window, so we must poll it.
    pub(super) fn connected(&self) -> bool {
        self.manager.as_ref().is_some_and(|manager| !manager.tablets().is_empty())
    }

    /// Whether the system does not move its pointer with the styluses. If so, we must emulate a
    /// pointer, or you could not press buttons of the window.
    pub(super) fn needs_pointer_emulation(&self) -> bool {
        let manager = self.manager.as_ref();
        manager.is_some_and(|m| matches!(m.backed(), Backend::WaylandTabletUnstableV2))
    }

    /// Reports since the last call. `zoom` is the number of the system's logical pixels per
    /// point.
    pub(super) fn reports(&mut self, zoom: f32, now: Instant) -> Vec<Report> {
        let Some(manager) = &mut self.manager else { return Vec::new() };
        let clock = &mut self.clock;
        let frame = &mut self.frame;
        // A panic in the library must not end the program and lose the painting.
        let reports = catch_unwind(AssertUnwindSafe(|| {
            let mut reports = Vec::new();
            for event in manager.pump().ok()? {
                let Event::Tool { tool, event } = event else { continue };
                let device = match tool.tool_type {
                    Some(Type::Eraser) => Device::Eraser,
                    // The window system reports these as pointer events too.
                    Some(Type::Emulated | Type::Finger) => continue,
                    _ => Device::Pen,
                };
                if let ToolEvent::Frame(stamp) = event {
                    let arrived = stamp.map_or(now, |stamp| {
                        let since = stamp - FrameTimestamp::epoch();
                        // The clock wraps at 2^32 ms.
                        let stamp = (since.as_millis() & u128::from(u32::MAX)) as u32;
                        clock.instant(stamp, now)
                    });
                    frame.finish(device, arrived, &mut reports);
                } else {
                    frame.add(event, zoom);
                }
            }
            Some(reports)
        }));
        let Ok(Some(reports)) = reports else {
            self.manager = None;
            return vec![Report { device: Device::Pen, arrived: now, kind: ReportKind::Gone }];
        };
        reports
    }
}

/// The events of one frame of the tablet protocol. They belong to one moment and may come in any
/// order.
#[derive(Debug, Default)]
struct EventFrame {
    state: Option<PointerState>,
    down: bool,
    up: bool,
    out: bool,
    buttons: Vec<ReportKind>,
    /// Barrel buttons in the system's order, the lower one first.
    known_buttons: Vec<ButtonID>,
    /// Last known state, for frames without a position.
    last: Option<PointerState>,
}

impl EventFrame {
    fn add(&mut self, event: ToolEvent<'_>, zoom: f32) {
        match event {
            ToolEvent::Down => self.down = true,
            ToolEvent::Up => self.up = true,
            ToolEvent::Out | ToolEvent::Removed => self.out = true,
            ToolEvent::Pose(pose) => self.state = Some(state(&pose, zoom)),
            ToolEvent::Button { button_id, pressed } => {
                if let Err(place) = self.known_buttons.binary_search(&button_id) {
                    self.known_buttons.insert(place, button_id);
                }
                let button = self.known_buttons.binary_search(&button_id).unwrap_or_default();
                self.buttons.push(ReportKind::Barrel { button: button.min(1), pressed });
            }
            ToolEvent::Added | ToolEvent::In { .. } | ToolEvent::Frame(_) => {}
        }
    }

    /// Ends the frame and appends its reports.
    fn finish(&mut self, device: Device, arrived: Instant, reports: &mut Vec<Report>) {
        let mut finish = |kind| reports.push(Report { device, arrived, kind });
        let state = self.state.take();
        self.last = state.or(self.last);
        match (std::mem::take(&mut self.down), state, self.last) {
            (true, _, Some(state)) => finish(ReportKind::Pressed(state)),
            (false, Some(state), _) => finish(ReportKind::Moved(state)),
            // The press has no position yet, so we report it with the next frame, which has one.
            (true, _, None) => self.down = true,
            (false, None, _) => {}
        }
        self.buttons.drain(..).for_each(&mut finish);
        if std::mem::take(&mut self.up) {
            finish(ReportKind::Released);
        }
        if std::mem::take(&mut self.out) {
            (self.last, self.down) = (None, false);
            finish(ReportKind::Gone);
        }
    }
}

fn state(pose: &Pose, zoom: f32) -> PointerState {
    let [x, y] = pose.position;
    PointerState {
        at: pos2(x / zoom, y / zoom),
        pressure: pose.pressure.get().map(f64::from),
        tilt_deg: pose.tilt.map(|[x, y]| (degrees(x), degrees(y))),
        twist_deg: pose.roll.get().map(degrees),
    }
}

fn degrees(radians: f32) -> f64 {
    f64::from(radians).to_degrees()
}

/// If a timestamp maps to an instant further in the past than this, it belongs to another clock.
const STALE: Duration = Duration::from_secs(5);

/// Converts timestamps to instants. The report with the smallest delay so far defines the offset
/// between the two clocks, so time in a queue does not distort the times of a stroke.
#[derive(Debug, Default)]
pub(super) struct StampClock {
    /// The last timestamp in ms and its instant.
    last: Option<(u32, Instant)>,
}

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
    use octotablet::util::NicheF32;

    const MS: Duration = Duration::from_millis(1);

    fn pose(x: f32) -> ToolEvent<'static> {
        let pressure = NicheF32::new_some(0.25).unwrap_or_default();
        let tilt = Some([0.5_f32.to_radians(), -30_f32.to_radians()]);
        ToolEvent::Pose(Pose { position: [x, 8.0], pressure, tilt, ..Pose::default() })
    }

    fn frame_reports(frame: &mut EventFrame, events: &[ToolEvent<'static>]) -> Vec<ReportKind> {
        events.iter().for_each(|&event| frame.add(event, 2.0));
        let mut reports = Vec::new();
        frame.finish(Device::Pen, Instant::now(), &mut reports);
        reports.iter().map(|report| report.kind).collect()
    }

    #[test]
    fn all_events_of_a_frame_are_reported_together() {
        let mut frame = EventFrame::default();
        let reports = frame_reports(&mut frame, &[pose(20.0)]);
        let [ReportKind::Moved(state)] = reports[..] else { panic!("{reports:?}") };
        assert_eq!((state.at, state.pressure), (pos2(10.0, 4.0), Some(0.25)));
        let (x, y) = state.tilt_deg.unwrap_or_default();
        assert!((x - 0.5).abs() < 1e-5 && (y + 30.0).abs() < 1e-5, "{x} {y}");
        assert_eq!(state.twist_deg, None);
        // Wayland reports down before the position.
        let reports = frame_reports(&mut frame, &[ToolEvent::Down, pose(30.0)]);
        assert!(
            matches!(reports[..], [ReportKind::Pressed(state)] if state.at.x == 15.0),
            "{reports:?}"
        );
        // Windows reports up before the position.
        let reports = frame_reports(&mut frame, &[ToolEvent::Up, pose(34.0)]);
        assert!(matches!(reports[..], [ReportKind::Moved(_), ReportKind::Released]), "{reports:?}");
        assert_eq!(frame_reports(&mut frame, &[ToolEvent::Out]), [ReportKind::Gone]);
    }

    #[test]
    fn a_press_waits_for_a_position() {
        let mut frame = EventFrame::default();
        assert_eq!(frame_reports(&mut frame, &[ToolEvent::Down]), []);
        let reports = frame_reports(&mut frame, &[pose(2.0)]);
        assert!(matches!(reports[..], [ReportKind::Pressed(_)]), "{reports:?}");
        // Without a movement in between, the press is at the last position.
        assert_eq!(frame_reports(&mut frame, &[ToolEvent::Up]), [ReportKind::Released]);
        let reports = frame_reports(&mut frame, &[ToolEvent::Down]);
        assert!(
            matches!(reports[..], [ReportKind::Pressed(state)] if state.at.x == 1.0),
            "{reports:?}"
        );
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
