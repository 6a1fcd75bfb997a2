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
use x11rb::protocol::xinput::{self, ConnectionExt as _, DeviceClassData, DeviceType, XIEventMask};
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
        Self::listen(None, window, wake)
    }

    /// As [`Self::start`], on a server by name.
    fn listen(
        server: Option<&str>,
        window: u32,
        wake: impl Fn() + Send + 'static,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let (connection, screen) = x11rb::connect(server)?;
        let root = connection.setup().roots[screen].root;
        connection.xinput_xi_query_version(2, 2)?.reply()?;
        select(&connection, root, ALL_DEVICES, XIEventMask::HIERARCHY)?;
        let pens = pens(&connection, window)?;
        let (tell, told) = channel();
        let ends = Ends { pens, clock: StampClock::default() };
        let mut listener = Listener { connection, window, ends, tell };
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

/// All ends of all pens.
struct Ends {
    pens: Vec<End>,
    clock: StampClock,
}

impl Ends {
    /// What an event tells of a pen that arrived at `arrived`.
    fn report(&mut self, event: &Event, arrived: Instant) -> Option<Report> {
        let (Event::XinputMotion(told)
        | Event::XinputButtonPress(told)
        | Event::XinputButtonRelease(told)) = event
        else {
            return None;
        };
        let end = self.pens.iter_mut().find(|end| end.id == told.deviceid)?;
        end.valuators.take(&told.valuator_mask, told.axisvalues.iter().map(number));
        let hold = end.valuators.hold(place(told.event_x, told.event_y));
        let what = match (event, told.detail) {
            (Event::XinputMotion(_), _) => What::Moved(hold),
            (Event::XinputButtonPress(_), 1) => What::Pressed(hold),
            (_, 1) => What::Released,
            (Event::XinputButtonPress(_), button) => barrel(button, true)?,
            (_, button) => barrel(button, false)?,
        };
        let arrived = self.clock.instant(told.time, arrived);
        Some(Report { device: end.device, arrived, what })
    }
}

struct Listener {
    connection: RustConnection,
    window: u32,
    ends: Ends,
    tell: Sender<Report>,
}

impl Listener {
    /// Whether it was of a pen.
    fn hear(&mut self, event: &Event) -> Result<bool, Lost> {
        let plugged = match event {
            Event::XinputHierarchy(_) => true,
            // Another range, or another tool on a device of many.
            Event::XinputDeviceChanged(told) => {
                self.ends.pens.iter().any(|end| end.id == told.deviceid)
            }
            _ => false,
        };
        if plugged {
            self.ends.pens = pens(&self.connection, self.window)?;
        }
        let Some(report) = self.ends.report(event, Instant::now()) else { return Ok(false) };
        self.tell.send(report).map_err(|_| Lost)?;
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

#[cfg(test)]
mod tests {
    use std::io::{BufRead, BufReader};
    use std::process::{Child, Command, Stdio};
    use std::time::Duration;

    use x11rb::protocol::xinput::{
        ButtonPressEvent, Fp3232, HierarchyChange, HierarchyChangeData,
        HierarchyChangeDataAddMaster,
    };
    use x11rb::protocol::xproto::{CreateWindowAux, WindowClass};
    use x11rb::wrapper::ConnectionExt as _;

    use super::*;

    fn told(time: u32, detail: u32, pressure: Option<i32>) -> ButtonPressEvent {
        ButtonPressEvent {
            deviceid: 9,
            time,
            detail,
            event_x: 100 * 65536 + 32768,
            event_y: 65536 * 7 / 4,
            valuator_mask: vec![u32::from(pressure.is_some()) << 2],
            axisvalues: pressure
                .map(|integral| Fp3232 { integral, frac: 1 << 31 })
                .into_iter()
                .collect(),
            ..ButtonPressEvent::default()
        }
    }

    #[test]
    fn events_of_a_pen_are_told_with_its_axes_and_the_servers_times() {
        let axis = |number, axis, range| Valuator { number, axis, range, value: 0.0 };
        let pressure = axis(2, Axis::Pressure, (0.0, 2047.0));
        let valuators = Valuators(vec![pressure]);
        let pens = vec![End { id: 9, device: Device::Eraser, valuators }];
        let mut ends = Ends { pens, clock: StampClock::default() };
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let events = [
            (Event::XinputMotion(told(500, 0, None)), 0),
            (Event::XinputButtonPress(told(508, 1, Some(1023))), 20),
            (Event::XinputButtonPress(told(516, 2, None)), 20),
            (Event::XinputButtonRelease(told(517, 3, None)), 20),
            (Event::XinputButtonRelease(told(518, 1, Some(0))), 20),
            // A wheel, and somebody else.
            (Event::XinputButtonPress(told(519, 4, None)), 20),
            (Event::XinputMotion(ButtonPressEvent { deviceid: 4, ..told(520, 0, None) }), 20),
        ];
        let reports: Vec<Report> =
            events.iter().filter_map(|(event, ms)| ends.report(event, at(*ms))).collect();
        assert!(reports.iter().all(|report| report.device == Device::Eraser));
        let times: Vec<Instant> = reports.iter().map(|report| report.arrived).collect();
        assert_eq!(times, [at(0), at(8), at(16), at(17), at(18)]);
        let whats: Vec<What> = reports.iter().map(|report| report.what).collect();
        let [What::Moved(near), What::Pressed(down), rest @ ..] = &whats[..] else {
            panic!("{whats:?}")
        };
        assert_eq!((near.at, near.pressure), (pos2(100.5, 1.75), Some(0.0)));
        assert_eq!((down.pressure, down.tilt_deg), (Some(0.5), None));
        let barrel = |button, pressed| What::Barrel { button, pressed };
        assert_eq!(rest, [barrel(0, true), barrel(1, false), What::Released]);
    }

    /// An X server without a screen, ended with the test.
    struct Server(Child);

    impl Drop for Server {
        fn drop(&mut self) {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }

    /// The server, and what it is called.
    fn server() -> Option<(Server, String)> {
        let mut command = Command::new("Xvfb");
        command.args(["-displayfd", "1", "-screen", "0", "320x200x24", "-nolisten", "tcp"]);
        let child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
        let mut server = Server(child.ok()?);
        let mut number = String::new();
        BufReader::new(server.0.stdout.take()?).read_line(&mut number).ok()?;
        Some((server, format!(":{}", number.trim())))
    }

    #[test]
    fn devices_of_a_server_that_come_and_go_are_no_pens() {
        let Some((_server, name)) = server() else {
            eprintln!("no Xvfb on this machine: nothing tried");
            return;
        };
        let (connection, screen) = x11rb::connect(Some(&name)).unwrap();
        let root = connection.setup().roots[screen].root;
        let window = connection.generate_id().unwrap();
        let (class, looks) = (WindowClass::INPUT_OUTPUT, CreateWindowAux::new());
        connection
            .create_window(24, window, root, 0, 0, 90, 90, 0, class, 0, &looks)
            .unwrap()
            .check()
            .unwrap();
        let told = X11Pens::listen(Some(&name), window, || {}).unwrap();
        let name = b"another".to_vec();
        let master = HierarchyChangeDataAddMaster { send_core: true, enable: true, name };
        let change = HierarchyChange { len: 4, data: HierarchyChangeData::AddMaster(master) };
        connection.xinput_xi_change_hierarchy(&[change]).unwrap().check().unwrap();
        connection.sync().unwrap();
        // The listener asked for the devices anew, and neither failed nor told.
        std::thread::sleep(Duration::from_millis(100));
        assert!(matches!(told.told.try_recv(), Err(std::sync::mpsc::TryRecvError::Empty)));
        assert!(pens(&connection, window).unwrap().is_empty());
    }
}
