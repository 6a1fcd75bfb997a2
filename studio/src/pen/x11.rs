//! Pens under X: XInput 2 on a connection of our own.
//!
//! Every device with an axis labelled `Abs Pressure` is a pen. Its events are
//! asked for on the program's window, beside those of the pointer that it moves.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Instant;

use eframe::egui::{Pos2, pos2};
use x11rb::connection::Connection;
use x11rb::errors::ReplyError;
use x11rb::protocol::Event;
use x11rb::protocol::xinput::{
    self, ButtonPressEvent, ConnectionExt as _, DeviceClassData, DeviceType, XIEventMask,
};
use x11rb::protocol::xproto::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

use super::clock::StampClock;
use super::report::{Device, Report, What};
use super::valuator::{Axis, Valuator, Valuators};

/// `XIAllDevices` of the protocol.
const ALL_DEVICES: u16 = 0;

/// The pens of an X server.
#[derive(Debug)]
pub(super) struct X11Pens {
    told: Receiver<Report>,
}

impl X11Pens {
    /// Listens to the pens over `window`, on a thread of its own that calls
    /// `wake` after each report. Their places are pixels of the window.
    ///
    /// # Errors
    /// If there is no X server, or none with XInput 2.
    pub(super) fn start(
        window: u32,
        wake: impl Fn() + Send + 'static,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let (connection, screen) = x11rb::connect(None)?;
        let root = connection.setup().roots[screen].root;
        connection.xinput_xi_query_version(2, 2)?.reply()?;
        select(&connection, root, ALL_DEVICES, XIEventMask::HIERARCHY)?;
        let pens = pens(&connection, window)?;
        let (tell, told) = channel();
        let mut listener =
            Listener { connection, window, pens, clock: StampClock::default(), tell };
        std::thread::spawn(move || {
            // It ends when the server goes, or nobody listens any more.
            while let Ok(event) = listener.connection.wait_for_event() {
                match listener.hear(&event) {
                    Ok(true) => wake(),
                    Ok(false) => {}
                    Err(Lost) => break,
                }
            }
        });
        Ok(Self { told })
    }

    /// What was told since the last call; `pixels` are those of a point.
    pub(super) fn reports(&mut self, pixels: f32) -> impl Iterator<Item = Report> + '_ {
        self.told.try_iter().map(move |mut report| {
            if let What::Moved(hold) | What::Pressed(hold) = &mut report.what {
                hold.at = (hold.at.to_vec2() / pixels).to_pos2();
            }
            report
        })
    }
}

/// One end of a pen.
struct End {
    id: u16,
    device: Device,
    valuators: Valuators,
}

/// Nobody listens, or nobody tells.
struct Lost;

impl From<ReplyError> for Lost {
    fn from(_: ReplyError) -> Self {
        Self
    }
}

struct Listener {
    connection: RustConnection,
    window: u32,
    pens: Vec<End>,
    clock: StampClock,
    tell: Sender<Report>,
}

impl Listener {
    /// Whether it was of a pen.
    fn hear(&mut self, event: &Event) -> Result<bool, Lost> {
        match event {
            Event::XinputHierarchy(_) => {
                self.pens = pens(&self.connection, self.window)?;
                Ok(false)
            }
            Event::XinputDeviceChanged(changed) => {
                // Another range, or another tool on a device of many.
                if self.pens.iter().any(|end| end.id == changed.deviceid) {
                    self.pens = pens(&self.connection, self.window)?;
                }
                Ok(false)
            }
            Event::XinputMotion(event) => self.pen(event, |hold| Some(What::Moved(hold))),
            Event::XinputButtonPress(event) => self.pen(event, |hold| match event.detail {
                1 => Some(What::Pressed(hold)),
                button => barrel(button, true),
            }),
            Event::XinputButtonRelease(event) => self.pen(event, |_| match event.detail {
                1 => Some(What::Released),
                button => barrel(button, false),
            }),
            _ => Ok(false),
        }
    }

    fn pen(
        &mut self,
        event: &ButtonPressEvent,
        what: impl Fn(super::report::Hold) -> Option<What>,
    ) -> Result<bool, Lost> {
        let Some(end) = self.pens.iter_mut().find(|end| end.id == event.deviceid) else {
            return Ok(false);
        };
        end.valuators.take(&event.valuator_mask, event.axisvalues.iter().map(number));
        let hold = end.valuators.hold(place(event.event_x, event.event_y));
        let arrived = self.clock.instant(event.time, Instant::now());
        let Some(what) = what(hold) else { return Ok(false) };
        self.tell.send(Report { device: end.device, arrived, what }).map_err(|_| Lost)?;
        Ok(true)
    }
}

/// Buttons of the barrel are 2 and 3; those after them are wheels.
fn barrel(button: u32, pressed: bool) -> Option<What> {
    let button = usize::try_from(button).ok()?.checked_sub(2)?;
    (button < 2).then_some(What::Barrel { button, pressed })
}

/// The pens there are, each asked to tell what it does over `window`.
fn pens(connection: &RustConnection, window: u32) -> Result<Vec<End>, ReplyError> {
    let devices = connection.xinput_xi_query_device(ALL_DEVICES)?.reply()?;
    let mut pens = Vec::new();
    for device in devices.infos {
        if !matches!(device.type_, DeviceType::SLAVE_POINTER | DeviceType::FLOATING_SLAVE) {
            continue;
        }
        let mut valuators = Valuators::default();
        for class in &device.classes {
            let DeviceClassData::Valuator(told) = &class.data else { continue };
            if told.label == x11rb::NONE {
                continue;
            }
            let label = connection.get_atom_name(told.label)?.reply()?.name;
            let Some(axis) = Axis::labelled(&String::from_utf8_lossy(&label)) else { continue };
            let range = (number(&told.min), number(&told.max));
            valuators.0.push(Valuator {
                number: told.number,
                axis,
                range,
                value: number(&told.value),
            });
        }
        if !valuators.is_pen() {
            continue;
        }
        let name = String::from_utf8_lossy(&device.name).to_lowercase();
        let eraser = name.contains("eraser");
        let kind = if eraser { Device::Eraser } else { Device::Pen };
        let mask = XIEventMask::MOTION
            | XIEventMask::BUTTON_PRESS
            | XIEventMask::BUTTON_RELEASE
            | XIEventMask::DEVICE_CHANGED;
        // A device may have gone since.
        if select(connection, window, device.deviceid, mask).is_ok() {
            pens.push(End { id: device.deviceid, device: kind, valuators });
        }
    }
    Ok(pens)
}

fn select(
    connection: &RustConnection,
    window: u32,
    deviceid: u16,
    mask: XIEventMask,
) -> Result<(), ReplyError> {
    let mask = xinput::EventMask { deviceid, mask: vec![mask] };
    connection.xinput_xi_select_events(window, &[mask])?.check()
}

/// A number of 32 bits before the point and 32 after it.
fn number(fixed: &xinput::Fp3232) -> f64 {
    f64::from(fixed.integral) + f64::from(fixed.frac) / 4_294_967_296.0
}

/// A place of 16 bits before the point and 16 after it, in pixels.
fn place(x: i32, y: i32) -> Pos2 {
    pos2(x as f32 / 65536.0, y as f32 / 65536.0)
}
