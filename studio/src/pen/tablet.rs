//! Pens under Wayland and Windows, by octotablet.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use eframe::egui::pos2;
use octotablet::axis::Pose;
use octotablet::events::{Event, FrameTimestamp, ToolEvent};
use octotablet::tool::{ButtonID, Type};
use octotablet::{Backend, Manager};

use super::clock::StampClock;
use super::report::{Device, Hold, Report, What};

/// The pens of the system.
pub(super) struct Tablet {
    /// Gone once it failed.
    manager: Option<Manager>,
    clock: StampClock,
    group: Group,
}

impl std::fmt::Debug for Tablet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Tablet").field("group", &self.group).finish_non_exhaustive()
    }
}

impl Tablet {
    /// Listens by a manager of the window.
    pub(super) fn new(manager: Manager) -> Self {
        Self { manager: Some(manager), clock: StampClock::default(), group: Group::default() }
    }

    /// Whether there is a tablet at all; nothing wakes the window for it, so it
    /// has to be asked again and again.
    pub(super) fn plugged(&self) -> bool {
        self.manager.as_ref().is_some_and(|manager| !manager.tablets().is_empty())
    }

    /// Whether the system moves no pointer for these pens, so that buttons of the
    /// window know nothing of them.
    pub(super) fn without_pointer(&self) -> bool {
        let manager = self.manager.as_ref();
        manager.is_some_and(|m| matches!(m.backed(), Backend::WaylandTabletUnstableV2))
    }

    /// What was told since the last call; `zoom` is how many of the system's
    /// logical pixels a point has.
    pub(super) fn reports(&mut self, zoom: f32, now: Instant) -> Vec<Report> {
        let Some(manager) = &mut self.manager else { return Vec::new() };
        let (clock, group) = (&mut self.clock, &mut self.group);
        // A fault in there must not take the painting with it.
        let told = catch_unwind(AssertUnwindSafe(|| {
            let mut told = Vec::new();
            for event in manager.pump().ok()? {
                let Event::Tool { tool, event } = event else { continue };
                let device = match tool.tool_type {
                    Some(Type::Eraser) => Device::Eraser,
                    // These are pointers, and told as such.
                    Some(Type::Emulated | Type::Finger) => continue,
                    _ => Device::Pen,
                };
                if let ToolEvent::Frame(stamp) = event {
                    let arrived = stamp.map_or(now, |stamp| {
                        let since = stamp - FrameTimestamp::epoch();
                        // The clock counts modulo 2^32.
                        let stamp = (since.as_millis() & u128::from(u32::MAX)) as u32;
                        clock.instant(stamp, now)
                    });
                    group.tell(device, arrived, &mut told);
                } else {
                    group.take(event, zoom);
                }
            }
            Some(told)
        }));
        let Ok(Some(told)) = told else {
            self.manager = None;
            return vec![Report { device: Device::Pen, arrived: now, what: What::Gone }];
        };
        told
    }
}

/// What happened at one moment; its parts come in any order.
#[derive(Debug, Default)]
struct Group {
    hold: Option<Hold>,
    down: bool,
    up: bool,
    out: bool,
    buttons: Vec<What>,
    /// Of the barrel, in the system's order: the lower one first.
    known: Vec<ButtonID>,
    /// Where it was last, if a moment tells no place.
    last: Option<Hold>,
}

impl Group {
    fn take(&mut self, event: ToolEvent<'_>, zoom: f32) {
        match event {
            ToolEvent::Down => self.down = true,
            ToolEvent::Up => self.up = true,
            ToolEvent::Out | ToolEvent::Removed => self.out = true,
            ToolEvent::Pose(pose) => self.hold = Some(hold(&pose, zoom)),
            ToolEvent::Button { button_id, pressed } => {
                if let Err(place) = self.known.binary_search(&button_id) {
                    self.known.insert(place, button_id);
                }
                let button = self.known.binary_search(&button_id).unwrap_or_default();
                self.buttons.push(What::Barrel { button: button.min(1), pressed });
            }
            ToolEvent::Added | ToolEvent::In { .. } | ToolEvent::Frame(_) => {}
        }
    }

    /// Ends the moment.
    fn tell(&mut self, device: Device, arrived: Instant, told: &mut Vec<Report>) {
        let mut tell = |what| told.push(Report { device, arrived, what });
        let hold = self.hold.take();
        self.last = hold.or(self.last);
        match (std::mem::take(&mut self.down), hold, self.last) {
            (true, _, Some(hold)) => tell(What::Pressed(hold)),
            (false, Some(hold), _) => tell(What::Moved(hold)),
            // Touched down nowhere: the place comes in the next moment.
            (true, _, None) => self.down = true,
            (false, None, _) => {}
        }
        self.buttons.drain(..).for_each(&mut tell);
        if std::mem::take(&mut self.up) {
            tell(What::Released);
        }
        if std::mem::take(&mut self.out) {
            (self.last, self.down) = (None, false);
            tell(What::Gone);
        }
    }
}

fn hold(pose: &Pose, zoom: f32) -> Hold {
    let [x, y] = pose.position;
    let degrees = |radians: f32| f64::from(radians).to_degrees();
    Hold {
        at: pos2(x / zoom, y / zoom),
        pressure: pose.pressure.get().map(f64::from),
        tilt_deg: pose.tilt.map(|[x, y]| (degrees(x), degrees(y))),
        twist_deg: pose.roll.get().map(degrees),
    }
}

#[cfg(test)]
mod tests {
    use octotablet::util::NicheF32;

    use super::*;

    fn pose(x: f32) -> ToolEvent<'static> {
        let pressure = NicheF32::new_some(0.25).unwrap_or_default();
        let tilt = Some([0.5_f32.to_radians(), -30_f32.to_radians()]);
        ToolEvent::Pose(Pose { position: [x, 8.0], pressure, tilt, ..Pose::default() })
    }

    /// What a moment of these events tells.
    fn moment(group: &mut Group, events: &[ToolEvent<'static>]) -> Vec<What> {
        events.iter().for_each(|&event| group.take(event, 2.0));
        let mut told = Vec::new();
        group.tell(Device::Pen, Instant::now(), &mut told);
        told.iter().map(|report| report.what).collect()
    }

    #[test]
    fn moments_are_told_whole() {
        let mut group = Group::default();
        let told = moment(&mut group, &[pose(20.0)]);
        let [What::Moved(hold)] = told[..] else { panic!("{told:?}") };
        assert_eq!((hold.at, hold.pressure), (pos2(10.0, 4.0), Some(0.25)));
        let (x, y) = hold.tilt_deg.unwrap_or_default();
        assert!((x - 0.5).abs() < 1e-5 && (y + 30.0).abs() < 1e-5, "{x} {y}");
        assert_eq!(hold.twist_deg, None);
        // Down before its place, as Wayland tells it.
        let told = moment(&mut group, &[ToolEvent::Down, pose(30.0)]);
        assert!(matches!(told[..], [What::Pressed(hold)] if hold.at.x == 15.0), "{told:?}");
        // Up before its place, as Windows does.
        let told = moment(&mut group, &[ToolEvent::Up, pose(34.0)]);
        assert!(matches!(told[..], [What::Moved(_), What::Released]), "{told:?}");
        assert_eq!(moment(&mut group, &[ToolEvent::Out]), [What::Gone]);
    }

    #[test]
    fn touching_down_waits_for_a_place() {
        let mut group = Group::default();
        assert_eq!(moment(&mut group, &[ToolEvent::Down]), []);
        let told = moment(&mut group, &[pose(2.0)]);
        assert!(matches!(told[..], [What::Pressed(_)]), "{told:?}");
        // Without moving in between, it sets down where it was.
        assert_eq!(moment(&mut group, &[ToolEvent::Up]), [What::Released]);
        let told = moment(&mut group, &[ToolEvent::Down]);
        assert!(matches!(told[..], [What::Pressed(hold)] if hold.at.x == 1.0), "{told:?}");
    }
}
