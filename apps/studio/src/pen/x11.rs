//! Styluses under X11, through XInput 2 on a separate connection.
//!
//! Every device with an axis labelled `Abs Pressure` is a stylus. We select its events on the
//! program's window, in addition to the events of the pointer that it moves. Of other devices that
//! move a pointer, we read only the times of their events.
//!
//! In XInput, an axis of a stylus is a number within a range, and a label identifies it.

use std::sync::mpsc::{Receiver, Sender, channel};

use eframe::egui::{Pos2, pos2};
use web_time::Instant;
use x11rb::connection::Connection;
use x11rb::errors::ReplyError;
use x11rb::protocol::Event;
use x11rb::protocol::xinput::{self, ConnectionExt as _, DeviceClassData, DeviceType, XIEventMask};
use x11rb::protocol::xproto::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

use super::report::{Device, PointerState, Report, ReportKind, Stamp, StampClock};

const ALL_DEVICES: u16 = 0;

#[derive(Debug)]
pub(super) struct X11Pens {
    reports: Receiver<Report>,
    mouse_times: Receiver<Stamp>,
}

impl X11Pens {
    /// Reads events of the styluses over `window` on a new thread, which calls `wake` after
    /// each report. Positions are in pixels of the window.
    ///
    /// # Errors
    /// If there is no X server, or it does not support XInput 2.
    pub(super) fn start(
        window: u32,
        wake: impl Fn() + Send + 'static,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        Self::listen(None, window, wake)
    }

    /// Like [`Self::start`], on the server with this display name.
    fn listen(
        server: Option<&str>,
        window: u32,
        wake: impl Fn() + Send + 'static,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let (connection, screen) = x11rb::connect(server)?;
        let root = connection.setup().roots[screen].root;
        connection.xinput_xi_query_version(2, 2)?.reply()?;
        select_events(&connection, root, ALL_DEVICES, XIEventMask::HIERARCHY)?;
        let (pens, mice) = devices(&connection, window)?;
        let (sender, reports) = channel();
        let (stamper, mouse_times) = channel();
        let ends = PenEnds { pens, mice, clock: StampClock::default() };
        let mut listener = Listener { connection, window, ends, sender, stamper };
        std::thread::spawn(move || {
            // The thread ends when the server closes the connection or the receiver is
            // gone.
            while let Ok(event) = listener.connection.wait_for_event() {
                match listener.handle(&event) {
                    Ok(true) => wake(),
                    Ok(false) => {}
                    Err(Disconnected) => break,
                }
            }
        });
        Ok(Self { reports, mouse_times })
    }

    /// Reports since the last call. `pixels` is the number of pixels per point.
    pub(super) fn reports(&mut self, pixels: f32) -> impl Iterator<Item = Report> + '_ {
        self.reports.try_iter().map(move |mut report| {
            if let ReportKind::Moved(state) | ReportKind::Pressed(state) = &mut report.kind {
                state.at = (state.at.to_vec2() / pixels).to_pos2();
            }
            report
        })
    }

    /// Places and times of the events of mice since the last call.
    pub(super) fn mouse_times(&mut self, pixels: f32) -> impl Iterator<Item = Stamp> + '_ {
        self.mouse_times.try_iter().map(move |(at, time)| ((at.to_vec2() / pixels).to_pos2(), time))
    }
}

/// One end of a stylus. X lists it as a separate device.
struct PenEnd {
    id: u16,
    device: Device,
    valuators: Valuators,
}

/// The server closed the connection, or the receiver is gone.
struct Disconnected;

impl From<ReplyError> for Disconnected {
    fn from(_: ReplyError) -> Self {
        Self
    }
}

/// All ends of all styluses, and the numbers of the mice.
struct PenEnds {
    pens: Vec<PenEnd>,
    mice: Vec<u16>,
    clock: StampClock,
}

impl PenEnds {
    /// Turns an event that arrived at `arrived` into a report; `None` if it does not come from a
    /// stylus.
    fn report(&mut self, event: &Event, arrived: Instant) -> Option<Report> {
        let (Event::XinputMotion(input)
        | Event::XinputButtonPress(input)
        | Event::XinputButtonRelease(input)) = event
        else {
            return None;
        };
        let end = self.pens.iter_mut().find(|end| end.id == input.deviceid)?;
        end.valuators.update(&input.valuator_mask, input.axisvalues.iter().map(number));
        let state = end.valuators.state(position(input.event_x, input.event_y));
        let kind = match (event, input.detail) {
            (Event::XinputMotion(_), _) => ReportKind::Moved(state),
            (Event::XinputButtonPress(_), 1) => ReportKind::Pressed(state),
            (_, 1) => ReportKind::Released,
            (Event::XinputButtonPress(_), button) => barrel(button, true)?,
            (_, button) => barrel(button, false)?,
        };
        let arrived = self.clock.instant(input.time, arrived);
        Some(Report { device: end.device, arrived, kind })
    }

    fn stamp(&mut self, event: &Event, arrived: Instant) -> Option<Stamp> {
        let (Event::XinputMotion(input) | Event::XinputButtonPress(input)) = event else {
            return None;
        };
        let mouse = self.mice.contains(&input.deviceid);
        let place = position(input.event_x, input.event_y);
        mouse.then(|| (place, self.clock.instant(input.time, arrived)))
    }
}

struct Listener {
    connection: RustConnection,
    window: u32,
    ends: PenEnds,
    sender: Sender<Report>,
    stamper: Sender<Stamp>,
}

impl Listener {
    /// Handles an event and returns whether it caused a report.
    fn handle(&mut self, event: &Event) -> Result<bool, Disconnected> {
        let plugged = match event {
            Event::XinputHierarchy(_) => true,
            // The range changed, or you use another tool on a device with several.
            Event::XinputDeviceChanged(change) => {
                self.ends.pens.iter().any(|end| end.id == change.deviceid)
            }
            _ => false,
        };
        if plugged {
            (self.ends.pens, self.ends.mice) = devices(&self.connection, self.window)?;
        }
        let arrived = Instant::now();
        if let Some(stamp) = self.ends.stamp(event, arrived) {
            self.stamper.send(stamp).map_err(|_| Disconnected)?;
        }
        let Some(report) = self.ends.report(event, arrived) else { return Ok(false) };
        self.sender.send(report).map_err(|_| Disconnected)?;
        Ok(true)
    }
}

/// Buttons 2 and 3 are on the barrel. Those after them are scroll wheels.
fn barrel(button: u32, pressed: bool) -> Option<ReportKind> {
    let button = usize::try_from(button).ok()?.checked_sub(2)?;
    (button < 2).then_some(ReportKind::Barrel { button, pressed })
}

/// Lists the styluses and the mice and selects their events over `window`.
fn devices(
    connection: &RustConnection,
    window: u32,
) -> Result<(Vec<PenEnd>, Vec<u16>), ReplyError> {
    let devices = connection.xinput_xi_query_device(ALL_DEVICES)?.reply()?;
    let mut pens = Vec::new();
    let mut mice = Vec::new();
    for device in devices.infos {
        if !matches!(device.type_, DeviceType::SLAVE_POINTER | DeviceType::FLOATING_SLAVE) {
            continue;
        }
        let mut valuators = Valuators::default();
        for class in &device.classes {
            let DeviceClassData::Valuator(class) = &class.data else { continue };
            if class.label == x11rb::NONE {
                continue;
            }
            let label = connection.get_atom_name(class.label)?.reply()?.name;
            let Some(axis) = Axis::labelled(&String::from_utf8_lossy(&label)) else { continue };
            let range = (number(&class.min), number(&class.max));
            valuators.0.push(Valuator {
                number: class.number,
                axis,
                range,
                value: number(&class.value),
            });
        }
        if !valuators.is_pen() {
            let mask = XIEventMask::MOTION | XIEventMask::BUTTON_PRESS;
            if select_events(connection, window, device.deviceid, mask).is_ok() {
                mice.push(device.deviceid);
            }
            continue;
        }
        let name = String::from_utf8_lossy(&device.name).to_lowercase();
        let eraser = name.contains("eraser");
        let kind = if eraser { Device::Eraser } else { Device::Pen };
        let mask = XIEventMask::MOTION
            | XIEventMask::BUTTON_PRESS
            | XIEventMask::BUTTON_RELEASE
            | XIEventMask::DEVICE_CHANGED;
        // Someone may have unplugged the device meanwhile.
        if select_events(connection, window, device.deviceid, mask).is_ok() {
            pens.push(PenEnd { id: device.deviceid, device: kind, valuators });
        }
    }
    Ok((pens, mice))
}

fn select_events(
    connection: &RustConnection,
    window: u32,
    deviceid: u16,
    mask: XIEventMask,
) -> Result<(), ReplyError> {
    let mask = xinput::EventMask { deviceid, mask: vec![mask] };
    connection.xinput_xi_select_events(window, &[mask])?.check()
}

/// Converts a 32.32 fixed-point number.
fn number(fixed: &xinput::Fp3232) -> f64 {
    f64::from(fixed.integral) + f64::from(fixed.frac) / 4_294_967_296.0
}

/// Converts a position in 16.16 fixed-point pixels.
fn position(x: i32, y: i32) -> Pos2 {
    pos2(x as f32 / 65536.0, y as f32 / 65536.0)
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    Pressure,
    /// Tilt towards the right.
    TiltX,
    /// Tilt towards the lower edge.
    TiltY,
    Twist,
}

impl Axis {
    /// The axis with this label in the X server's input drivers, if it is one of the four (labels
    /// from xserver-properties.h).
    pub(super) fn labelled(label: &str) -> Option<Self> {
        match label {
            "Abs Pressure" => Some(Self::Pressure),
            "Abs Tilt X" => Some(Self::TiltX),
            "Abs Tilt Y" => Some(Self::TiltY),
            // The Wacom driver uses the first label, libinput the second one.
            "Abs Wheel" | "Abs Rotary Z" => Some(Self::Twist),
            _ => None,
        }
    }
}

/// One axis with its last value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Valuator {
    pub(super) number: u16,
    pub(super) axis: Axis,
    /// Lowest and highest value, in the server's unit.
    pub(super) range: (f64, f64),
    pub(super) value: f64,
}

impl Valuator {
    /// The value as a pressure of 0 to 1 or as an angle in degrees; `None` if range or value are
    /// invalid.
    fn normalized(&self) -> Option<f64> {
        let (lowest, highest) = self.range;
        let span = highest - lowest;
        if !(span.is_finite() && span > 0.0 && self.value.is_finite()) {
            return None;
        }
        let value = self.value.clamp(lowest, highest);
        Some(match self.axis {
            Axis::Pressure => (value - lowest) / span,
            // Drivers report degrees, at most 64 from upright. A range beyond 90 has another unit,
            // so we take its end as 60 degrees.
            Axis::TiltX | Axis::TiltY => {
                let most = lowest.abs().max(highest.abs());
                if most <= 90.0 { value } else { value / most * 60.0 }
            }
            Axis::Twist => value / span * 360.0,
        })
    }
}

#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Valuators(pub(super) Vec<Valuator>);

impl Valuators {
    /// Whether the device is a stylus: it measures pressure.
    pub(super) fn is_pen(&self) -> bool {
        self.0.iter().any(|valuator| valuator.axis == Axis::Pressure)
    }

    /// Applies an event. `mask` has one bit for each axis with a value in `values`, in order. The
    /// other axes keep their values. If there are more bits than values, this ignores the rest.
    pub(super) fn update(&mut self, mask: &[u32], values: impl IntoIterator<Item = f64>) {
        let numbers = (0_u16..).zip(mask).flat_map(|(word, &bits)| {
            (0_u16..32).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| 32 * word + bit)
        });
        for (number, value) in numbers.zip(values) {
            for valuator in self.0.iter_mut().filter(|valuator| valuator.number == number) {
                valuator.value = value;
            }
        }
    }

    /// State of the stylus at a point of the window.
    pub(super) fn state(&self, at: Pos2) -> PointerState {
        let axes = [Axis::Pressure, Axis::TiltX, Axis::TiltY, Axis::Twist];
        let [pressure, tilt_x, tilt_y, twist_deg] = axes.map(|axis| {
            let valuator = self.0.iter().find(|valuator| valuator.axis == axis);
            valuator.and_then(Valuator::normalized)
        });
        PointerState { at, pressure, tilt_deg: tilt_x.zip(tilt_y), twist_deg }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{BufRead, BufReader};
    use std::process::{Child, Command, Stdio};
    use std::time::Duration;
    use x11rb::protocol::xinput::{
        ButtonPressEvent, Fp3232, HierarchyChange, HierarchyChangeData,
        HierarchyChangeDataAddMaster,
    };
    use x11rb::protocol::xproto::{CreateWindowAux, WindowClass};
    use x11rb::wrapper::ConnectionExt as _;

    const MS: Duration = Duration::from_millis(1);

    fn button_event(time: u32, detail: u32, pressure: Option<i32>) -> ButtonPressEvent {
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
    fn stylus_events_are_reported_with_their_axes_and_server_times() {
        let pressure =
            Valuator { number: 2, axis: Axis::Pressure, range: (0.0, 2047.0), value: 0.0 };
        let valuators = Valuators(vec![pressure]);
        let pens = vec![PenEnd { id: 9, device: Device::Eraser, valuators }];
        let mut ends = PenEnds { pens, mice: vec![7], clock: StampClock::default() };
        let start = Instant::now();
        let events = [
            (Event::XinputMotion(button_event(500, 0, None)), 0_u32),
            (Event::XinputButtonPress(button_event(508, 1, Some(1023))), 20),
            (Event::XinputButtonPress(button_event(516, 2, None)), 20),
            (Event::XinputButtonRelease(button_event(517, 3, None)), 20),
            (Event::XinputButtonRelease(button_event(518, 1, Some(0))), 20),
            // These are a scroll wheel, and a device that is not a stylus.
            (Event::XinputButtonPress(button_event(519, 4, None)), 20),
            (
                Event::XinputMotion(ButtonPressEvent { deviceid: 4, ..button_event(520, 0, None) }),
                20,
            ),
        ];
        let reports: Vec<Report> =
            events.iter().filter_map(|(event, ms)| ends.report(event, start + *ms * MS)).collect();
        assert!(reports.iter().all(|report| report.device == Device::Eraser));
        let times: Vec<Instant> = reports.iter().map(|report| report.arrived).collect();
        assert_eq!(times, [0_u32, 8, 16, 17, 18].map(|ms| start + ms * MS));
        let kinds: Vec<ReportKind> = reports.iter().map(|report| report.kind).collect();
        let [ReportKind::Moved(near), ReportKind::Pressed(down), rest @ ..] = &kinds[..] else {
            panic!("{kinds:?}")
        };
        assert_eq!((near.at, near.pressure), (pos2(100.5, 1.75), Some(0.0)));
        assert_eq!((down.pressure, down.tilt_deg), (Some(0.5), None));
        let pressed = ReportKind::Barrel { button: 0, pressed: true };
        let released = ReportKind::Barrel { button: 1, pressed: false };
        assert_eq!(rest, [pressed, released, ReportKind::Released]);
        let of_mouse = ButtonPressEvent { deviceid: 7, ..button_event(524, 0, None) };
        let stamp = ends.stamp(&Event::XinputMotion(of_mouse.clone()), start + 40 * MS);
        assert_eq!(stamp, Some((pos2(100.5, 1.75), start + 24 * MS)));
        assert!(ends.report(&Event::XinputMotion(of_mouse), start + 40 * MS).is_none());
    }

    /// An X server without a screen, ended after the test.
    struct Server(Child);

    impl Drop for Server {
        fn drop(&mut self) {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }

    /// Starts an X server; `None` without Xvfb. Returns it with its display name.
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
    fn adding_a_device_without_pressure_adds_no_stylus() {
        let Some((_server, name)) = server() else {
            eprintln!("skipped: Xvfb is not installed");
            return;
        };
        let (connection, screen) = x11rb::connect(Some(&name)).unwrap();
        let root = connection.setup().roots[screen].root;
        let window = connection.generate_id().unwrap();
        let class = WindowClass::INPUT_OUTPUT;
        let looks = CreateWindowAux::new();
        connection
            .create_window(24, window, root, 0, 0, 90, 90, 0, class, 0, &looks)
            .unwrap()
            .check()
            .unwrap();
        let pens_of_server = X11Pens::listen(Some(&name), window, || {}).unwrap();
        let name = b"another".to_vec();
        let master = HierarchyChangeDataAddMaster { send_core: true, enable: true, name };
        let change = HierarchyChange { len: 4, data: HierarchyChangeData::AddMaster(master) };
        connection.xinput_xi_change_hierarchy(&[change]).unwrap().check().unwrap();
        connection.sync().unwrap();
        // The thread lists the devices again. This gives no error and no report.
        std::thread::sleep(Duration::from_millis(100));
        assert!(matches!(
            pens_of_server.reports.try_recv(),
            Err(std::sync::mpsc::TryRecvError::Empty)
        ));
        let (pens, mice) = devices(&connection, window).unwrap();
        assert!(pens.is_empty() && !mice.is_empty());
    }

    fn wacom() -> Valuators {
        let axes = [
            (2, Axis::Pressure, (0.0, 65536.0)),
            (3, Axis::TiltX, (-64.0, 63.0)),
            (4, Axis::TiltY, (-64.0, 63.0)),
            (5, Axis::Twist, (-900.0, 899.0)),
        ];
        Valuators(
            axes.map(|(number, axis, range)| Valuator { number, axis, range, value: 0.0 }).to_vec(),
        )
    }

    #[test]
    fn an_event_updates_its_axes_and_keeps_the_others() {
        let mut pen = wacom();
        // Axes 0, 2 and 4.
        pen.update(&[0b1_0101], [123.0, 16384.0, -20.0]);
        pen.update(&[0b10_1000], [30.0, 450.0]);
        let state = pen.state(Pos2::ZERO);
        assert_eq!((state.pressure, state.tilt_deg), (Some(0.25), Some((30.0, -20.0))));
        let twist = state.twist_deg.unwrap_or_default();
        assert!((twist - 90.0).abs() < 0.1, "{twist}");
    }

    #[test]
    fn invalid_masks_and_ranges_are_harmless() {
        let mut pen = wacom();
        // There are more bits than values, and axes that the device does not have.
        pen.update(&[u32::MAX, u32::MAX], [0.0, 0.0, 32768.0]);
        pen.update(&[], [1.0]);
        assert_eq!(pen.state(Pos2::ZERO).pressure, Some(0.5));
        pen.update(&[0, 0b100], [0.0]);
        assert_eq!(pen.state(Pos2::ZERO).pressure, Some(0.5));
        pen.update(&[0b100], [1e9]);
        assert_eq!(pen.state(Pos2::ZERO).pressure, Some(1.0));
        for range in [(0.0, 0.0), (5.0, -5.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
            pen.0[0].range = range;
            assert_eq!(pen.state(Pos2::ZERO).pressure, None, "{range:?}");
        }
        pen.0[1].value = f64::NAN;
        assert_eq!(pen.state(Pos2::ZERO).tilt_deg, None);
        // The pressure range does not start at 0, and tilt has another unit.
        fn normalized(axis: Axis, range: (f64, f64), value: f64) -> f64 {
            Valuator { number: 0, axis, range, value }.normalized().unwrap_or(f64::NAN)
        }
        assert_eq!(normalized(Axis::Pressure, (100.0, 300.0), 150.0), 0.25);
        assert_eq!(normalized(Axis::TiltX, (-9000.0, 9000.0), -4500.0), -30.0);
    }

    #[test]
    fn a_device_with_pressure_is_a_stylus() {
        let labels = ["Abs X", "Abs Y", "Abs Pressure", "Abs Tilt X", "Rel Horiz Scroll"];
        let axes: Vec<Option<Axis>> = labels.iter().map(|label| Axis::labelled(label)).collect();
        assert_eq!(axes, [None, None, Some(Axis::Pressure), Some(Axis::TiltX), None]);
        assert!(wacom().is_pen());
        assert!(!Valuators(wacom().0.split_off(1)).is_pen());
    }
}
