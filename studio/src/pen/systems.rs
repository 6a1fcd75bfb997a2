//! The pens of the window system, whichever it is.

use std::time::{Duration, Instant};

use eframe::CreationContext;
use eframe::egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput};

use super::report::{Report, What};
use super::tablet::Tablet;
#[cfg(target_os = "linux")]
use super::x11::X11Pens;

/// The newest version of Wayland's tablet protocol that octotablet understands;
/// asking for a newer one would end the connection, and the program with it.
#[cfg(target_os = "linux")]
const TABLET_VERSION: u32 = 1;

/// How often a tablet is asked that nobody paints with.
const IDLE: Duration = Duration::from_millis(100);

/// The pens of the window system.
#[derive(Debug, Default)]
pub(super) struct Systems {
    #[cfg(target_os = "linux")]
    x11: Option<X11Pens>,
    tablet: Option<Tablet>,
    /// Where the pointer was last led for a pen.
    pointer: Pos2,
    /// Why there is none.
    pub(super) notice: Option<String>,
}

impl Systems {
    /// The pens over a window.
    pub(super) fn over(context: &CreationContext<'_>) -> Self {
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
                match X11Pens::start(number, move || egui.request_repaint()) {
                    Ok(pens) => systems.x11 = Some(pens),
                    Err(error) => {
                        systems.notice = Some(format!(
                            "pens act as mice: the X server has no XInput 2.2: {error}"
                        ));
                    }
                }
                return systems;
            }
            match super::wayland::tablet_version() {
                Some(version) if version > TABLET_VERSION => {
                    systems.notice = Some(format!(
                        "pens act as mice: the compositor tells them in version {version} of the \
                         tablet protocol, version {TABLET_VERSION} is understood; under X \
                         (WAYLAND_DISPLAY= impasto-studio) they are pens"
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

    /// What was told since the last call. Where the system leads no pointer for
    /// its pens, `input` gets one, so that they press buttons too.
    pub(super) fn reports(&mut self, egui: &Context, input: &mut RawInput) -> Vec<Report> {
        let mut told = Vec::new();
        #[cfg(target_os = "linux")]
        if let Some(x11) = &mut self.x11 {
            told.extend(x11.reports(egui.pixels_per_point()));
        }
        if let Some(tablet) = &mut self.tablet {
            let heard = tablet.reports(egui.zoom_factor(), Instant::now());
            if tablet.without_pointer() {
                let modifiers = egui.input(|input| input.modifiers);
                lead_pointer(&heard, modifiers, &mut self.pointer, input);
            }
            told.extend(heard);
        }
        told
    }

    /// When the window should ask again, though nothing wakes it; `near` while a
    /// pen is over the tablet.
    pub(super) fn asks_in(&self, near: bool) -> Option<Duration> {
        let plugged = self.tablet.as_ref().is_some_and(Tablet::plugged);
        plugged.then_some(if near { Duration::ZERO } else { IDLE })
    }
}

/// Tells egui what a pointer would do.
fn lead_pointer(heard: &[Report], modifiers: Modifiers, pointer: &mut Pos2, input: &mut RawInput) {
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers,
    };
    for report in heard {
        match report.what {
            What::Moved(hold) => {
                *pointer = hold.at;
                input.events.push(Event::PointerMoved(hold.at));
            }
            What::Pressed(hold) => {
                *pointer = hold.at;
                input.events.push(Event::PointerMoved(hold.at));
                input.events.push(button(hold.at, true));
            }
            What::Released => input.events.push(button(*pointer, false)),
            What::Gone => input.events.push(Event::PointerGone),
            What::Barrel { .. } => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::super::report::{Device, Hold};
    use super::*;

    #[test]
    fn a_pen_leads_the_pointer_where_the_system_does_not() {
        let hold = Hold::at(pos2(3.0, 4.0));
        let whats = [What::Moved(hold), What::Pressed(hold), What::Released, What::Gone];
        let arrived = Instant::now();
        let heard = whats.map(|what| Report { device: Device::Pen, arrived, what });
        let mut input = RawInput::default();
        lead_pointer(&heard, Modifiers::NONE, &mut Pos2::default(), &mut input);
        let moved = Event::PointerMoved(hold.at);
        assert_eq!(input.events[..2], [moved.clone(), moved]);
        let pressed = |event: &Event| match event {
            Event::PointerButton { pos, pressed, .. } if *pos == hold.at => Some(*pressed),
            _ => None,
        };
        let pressed: Vec<Option<bool>> = input.events[2..].iter().map(pressed).collect();
        assert_eq!(pressed, [Some(true), Some(false), None]);
        assert_eq!(input.events[4], Event::PointerGone);
    }
}
