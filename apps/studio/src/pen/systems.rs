//! Styluses of the window system (X11, Wayland or Windows), and the times of mouse events from the
//! window system.

use eframe::CreationContext;
use eframe::egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput};
#[cfg(target_os = "linux")]
use wayland_client::globals::{GlobalListContents, registry_queue_init};
#[cfg(target_os = "linux")]
use wayland_client::protocol::wl_registry::{Event as WaylandEvent, WlRegistry};
#[cfg(target_os = "linux")]
use wayland_client::{Connection, Dispatch, QueueHandle};
use web_time::{Duration, Instant};

use super::report::{Report, ReportKind, Stamp};
use super::tablet::Tablet;
#[cfg(target_os = "linux")]
use super::x11::X11Pens;

/// Newest version of Wayland's tablet protocol that octotablet supports. If we bound a newer
/// version, this would break the connection to the compositor and end the program.
#[cfg(target_os = "linux")]
const TABLET_VERSION: u32 = 1;

/// We poll an idle tablet at this interval.
const IDLE: Duration = Duration::from_millis(100);

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
    use super::super::report::{Device, PointerState};
    use super::*;
    use eframe::egui::pos2;

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
}
