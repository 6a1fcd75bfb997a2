//! Styluses of the window system, and the times of its mouse events. Under X11 they come from `x11`,
//! under Wayland and Windows from a [`Tablet`]. It stamps events in milliseconds of its own clock,
//! which we convert to [`Instant`]s.

use std::panic::{AssertUnwindSafe, catch_unwind};

use eframe::CreationContext;
use eframe::egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, pos2};
use octotablet::axis::Pose;
use octotablet::events::{Event as TabletEvent, FrameTimestamp, ToolEvent};
use octotablet::tool::{ButtonID, Type};
use octotablet::{Backend, Manager};
#[cfg(target_os = "linux")]
use wayland_client::globals::{GlobalListContents, registry_queue_init};
#[cfg(target_os = "linux")]
use wayland_client::protocol::wl_registry::{Event as WaylandEvent, WlRegistry};
#[cfg(target_os = "linux")]
use wayland_client::{Connection, Dispatch, QueueHandle};
use web_time::{Duration, Instant};

use super::report::{Device, PointerState, Report, ReportKind, Stamp, StampClock};
#[cfg(target_os = "linux")]
use super::x11::X11Pens;

/// Newest version of Wayland's tablet protocol that octotablet supports. If we bound a newer
/// version, this would break the connection to the compositor and end the program.
#[cfg(target_os = "linux")]
const TABLET_VERSION: u32 = 1;

/// We poll an idle tablet at this interval.
const IDLE: Duration = Duration::from_millis(100);

/// Styluses under Wayland and Windows, through octotablet.
struct Tablet {
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
    fn new(manager: Manager) -> Self {
        Self { manager: Some(manager), clock: StampClock::default(), frame: EventFrame::default() }
    }

    /// Whether a tablet is connected. Its events do not wake the window, so we must poll it.
    fn connected(&self) -> bool {
        self.manager.as_ref().is_some_and(|manager| !manager.tablets().is_empty())
    }

    /// Whether the system does not move its pointer with the styluses. If so, we must emulate a
    /// pointer, or you could not press buttons of the window.
    fn needs_pointer_emulation(&self) -> bool {
        let manager = self.manager.as_ref();
        manager.is_some_and(|m| matches!(m.backed(), Backend::WaylandTabletUnstableV2))
    }

    /// Reports since the last call. `zoom` is the number of the system's logical pixels per
    /// point.
    fn reports(&mut self, zoom: f32, now: Instant) -> Vec<Report> {
        let Some(manager) = &mut self.manager else { return Vec::new() };
        let clock = &mut self.clock;
        let frame = &mut self.frame;
        // A panic in the library must not end the program and lose the painting.
        let reports = catch_unwind(AssertUnwindSafe(|| {
            let mut reports = Vec::new();
            for event in manager.pump().ok()? {
                let TabletEvent::Tool { tool, event } = event else { continue };
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

#[derive(Debug, Default)]
pub(super) struct Systems {
    #[cfg(target_os = "linux")]
    x11: Option<X11Pens>,
    tablet: Option<Tablet>,
    /// Last position of the emulated pointer of a stylus.
    pointer: Pos2,
    /// Message about why styluses act as mice.
    pub(super) notice: Option<String>,
}

impl Systems {
    /// Connects to the styluses over a window.
    pub(super) fn for_window(context: &CreationContext<'_>) -> Self {
        let mut systems = Self::default();
        let Some(window) = context.winit_window() else { return systems };
        #[cfg(target_os = "linux")]
        {
            use raw_window_handle::{HasWindowHandle, RawWindowHandle};
            let number = match window.window_handle().map(|handle| handle.as_raw()) {
                Ok(RawWindowHandle::Xlib(handle)) => u32::try_from(handle.window).ok(),
                Ok(RawWindowHandle::Xcb(handle)) => Some(handle.window.get()),
                _ => None,
            };
            if let Some(number) = number {
                let egui = context.egui_ctx.clone();
                match X11Pens::start(number, move || crate::pace::wake(&egui)) {
                    Ok(pens) => systems.x11 = Some(pens),
                    Err(error) => {
                        systems.notice = Some(format!(
                            "pens act as mice: the X server does not support XInput 2.2: {error}"
                        ));
                    }
                }
                return systems;
            }
            match tablet_version() {
                Some(version) if version > TABLET_VERSION => {
                    systems.notice = Some(format!(
                        "pens act as mice: the compositor uses version {version} of the tablet \
                        protocol, but only version {TABLET_VERSION} is supported; they work as \
                        pens under X (start it with WAYLAND_DISPLAY= impasto-studio)"
                    ));
                    return systems;
                }
                None => return systems,
                Some(_) => {}
            }
        }
        let builder = octotablet::Builder::new().emulate_tool_from_mouse(false);
        match builder.build_shared(window) {
            Ok(manager) => systems.tablet = Some(Tablet::new(manager)),
            Err(octotablet::builder::BuildError::Unsupported) => {}
            Err(error) => systems.notice = Some(format!("pens act as mice: {error}")),
        }
        systems
    }

    /// Reports since the last call. If the window system does not move its pointer with the
    /// styluses, this adds pointer events to `input`, so that you can press buttons with a stylus.
    pub(super) fn reports(&mut self, egui: &Context, input: &mut RawInput) -> Vec<Report> {
        let mut all_reports = Vec::new();
        #[cfg(target_os = "linux")]
        if let Some(x11) = &mut self.x11 {
            all_reports.extend(x11.reports(egui.pixels_per_point()));
        }
        if let Some(tablet) = &mut self.tablet {
            let reports = tablet.reports(egui.zoom_factor(), Instant::now());
            if tablet.needs_pointer_emulation() {
                let modifiers = egui.input(|input| input.modifiers);
                emulate_pointer(&reports, modifiers, &mut self.pointer, input);
            }
            all_reports.extend(reports);
        }
        all_reports
    }

    /// Places and times of the mouse events since the last call, under X11. The events from winit
    /// carry no times, on any system.
    pub(super) fn mouse_times(&mut self, egui: &Context) -> Vec<Stamp> {
        #[cfg(target_os = "linux")]
        if let Some(x11) = &mut self.x11 {
            return x11.mouse_times(egui.pixels_per_point()).collect();
        }
        let _ = egui;
        Vec::new()
    }

    /// Time after which the window must poll a tablet, because its events do not wake it; `None`
    /// without a tablet. `near` is true while a stylus is close to the tablet.
    pub(super) fn poll_after(&self, near: bool) -> Option<Duration> {
        let connected = self.tablet.as_ref().is_some_and(Tablet::connected);
        connected.then_some(if near { Duration::ZERO } else { IDLE })
    }
}

/// Adds the pointer events that a mouse at the place of the stylus would send.
fn emulate_pointer(
    reports: &[Report],
    modifiers: Modifiers,
    pointer: &mut Pos2,
    input: &mut RawInput,
) {
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers,
    };
    for report in reports {
        match report.kind {
            ReportKind::Moved(state) => {
                *pointer = state.at;
                input.events.push(Event::PointerMoved(state.at));
            }
            ReportKind::Pressed(state) => {
                *pointer = state.at;
                input.events.push(Event::PointerMoved(state.at));
                input.events.push(button(state.at, true));
            }
            ReportKind::Released => input.events.push(button(*pointer, false)),
            ReportKind::Gone => input.events.push(Event::PointerGone),
            ReportKind::Barrel { .. } => {}
        }
    }
}

#[cfg(target_os = "linux")]
struct Globals;

#[cfg(target_os = "linux")]
impl Dispatch<WlRegistry, GlobalListContents> for Globals {
    fn event(
        _: &mut Self,
        _: &WlRegistry,
        _: WaylandEvent,
        _: &GlobalListContents,
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
    }
}

/// Version of `zwp_tablet_manager_v2` that the compositor offers, if any. We ask on a separate
/// connection.
#[cfg(target_os = "linux")]
pub(super) fn tablet_version() -> Option<u32> {
    let connection = Connection::connect_to_env().ok()?;
    let (globals, _) = registry_queue_init::<Globals>(&connection).ok()?;
    globals.contents().with_list(|list| {
        let found = list.iter().find(|global| global.interface == "zwp_tablet_manager_v2");
        found.map(|global| global.version)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use octotablet::util::NicheF32;

    #[test]
    fn a_stylus_moves_the_pointer_where_the_system_does_not() {
        let state = PointerState::at(pos2(3.0, 4.0));
        let kinds = [
            ReportKind::Moved(state),
            ReportKind::Pressed(state),
            ReportKind::Released,
            ReportKind::Gone,
        ];
        let arrived = Instant::now();
        let reports = kinds.map(|kind| Report { device: Device::Pen, arrived, kind });
        let mut input = RawInput::default();
        emulate_pointer(&reports, Modifiers::NONE, &mut Pos2::default(), &mut input);
        let moved = Event::PointerMoved(state.at);
        assert_eq!(input.events[..2], [moved.clone(), moved]);
        let pressed: Vec<Option<bool>> = input.events[2..]
            .iter()
            .map(|event| match event {
                Event::PointerButton { pos, pressed, .. } if *pos == state.at => Some(*pressed),
                _ => None,
            })
            .collect();
        assert_eq!(pressed, [Some(true), Some(false), None]);
        assert_eq!(input.events[4], Event::PointerGone);
    }

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
}
