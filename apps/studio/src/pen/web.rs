//! Styluses in a page: reports of the browser's pointer events.
//!
//! A browser gives every quantity a value, even if a stylus does not measure it: 0 for tilt and
//! rotation, and 0.5 for the pressure. So we count a quantity as measured after its first other
//! value. Some browsers on Windows 11 report 0.5 for every stylus. Then the pressure follows from
//! the speed, as with a mouse, and we show a message.

use web_time::Instant;

use eframe::egui::Pos2;
#[cfg(not(any(target_os = "linux", windows)))]
use eframe::egui::{Context, RawInput};

#[cfg(not(any(target_os = "linux", windows)))]
use super::report::Stamp;
use super::report::{Device, PointerState, Report, ReportKind};
use crate::language::tr;
#[cfg(not(any(target_os = "linux", windows)))]
use web_time::Duration;

/// The pressure that a browser reports for a stylus without pressure.
const UNMEASURED: f64 = 0.5;

/// After this many reports with that pressure, in contact, we show the message.
const CERTAIN: usize = 24;

/// Bit of `buttons` for the nearest button on the barrel.
const BARREL: u16 = 2;

/// Bit of `buttons` for the eraser end.
const ERASER: u16 = 32;

/// Kind of a pointer event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PagePhase {
    /// The stylus touches.
    Down,
    /// It moves, touching or not.
    Move,
    /// It is lifted.
    Up,
    /// The browser no longer feels it, or takes it for a gesture.
    Gone,
}

/// A pointer event of a stylus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PagePointer {
    /// Kind of the event.
    pub phase: PagePhase,
    /// Position in points of the window.
    pub at: Pos2,
    /// `pressure`, 0 to 1.
    pub pressure: f64,
    /// `tiltX` and `tiltY`, in degrees.
    pub tilt_deg: (f64, f64),
    /// `twist`, 0 to 359 degrees.
    pub twist_deg: f64,
    /// `buttons`, one bit each.
    pub buttons: u16,
    /// Time of the event.
    pub arrived: Instant,
}

/// Converts the pointer events of styluses to reports.
#[derive(Debug, Default)]
pub struct PagePens {
    pressure: bool,
    tilt: bool,
    twist: bool,
    /// Reports in contact without a measured pressure.
    unmeasured: usize,
    down: bool,
    eraser: bool,
    barrel: bool,
    notice: Option<String>,
}

impl PagePens {
    /// The reports of an event. Pass them to [`Pen::feed`](super::Pen::feed).
    pub fn reports(&mut self, event: &PagePointer) -> Vec<Report> {
        let mut kinds = Vec::new();
        // We know from the first contact on which end touches.
        if event.phase == PagePhase::Down || !self.down {
            self.eraser = event.buttons & ERASER != 0;
        }
        let barrel = event.buttons & BARREL != 0;
        if barrel != self.barrel && event.phase != PagePhase::Gone {
            self.barrel = barrel;
            kinds.push(ReportKind::Barrel { button: 0, pressed: barrel });
        }
        match event.phase {
            PagePhase::Down => {
                self.down = true;
                kinds.push(ReportKind::Pressed(self.state(event)));
            }
            PagePhase::Move => kinds.push(ReportKind::Moved(self.state(event))),
            PagePhase::Up => {
                if std::mem::take(&mut self.down) {
                    kinds.push(ReportKind::Released);
                }
            }
            PagePhase::Gone => {
                if std::mem::take(&mut self.down) {
                    kinds.push(ReportKind::Released);
                }
                kinds.push(ReportKind::Gone);
            }
        }
        let device = if self.eraser { Device::Eraser } else { Device::Pen };
        kinds.into_iter().map(|kind| Report { device, arrived: event.arrived, kind }).collect()
    }

    fn state(&mut self, event: &PagePointer) -> PointerState {
        if self.down {
            self.pressure |= event.pressure != UNMEASURED && event.pressure > 0.0;
            self.unmeasured += usize::from(!self.pressure);
            if self.unmeasured == CERTAIN && !self.pressure {
                let text = tr(
                    "this browser reports no pressure of the pen: it follows from the speed, as \
                     with a mouse",
                );
                self.notice = Some(text.to_owned());
            }
        }
        self.tilt |= event.tilt_deg != (0.0, 0.0);
        self.twist |= event.twist_deg != 0.0;
        PointerState {
            at: event.at,
            pressure: self.pressure.then_some(event.pressure),
            tilt_deg: self.tilt.then_some(event.tilt_deg),
            twist_deg: self.twist.then_some(event.twist_deg),
        }
    }

    /// Removes and returns a message about the stylus. You get it once for each page.
    pub fn take_notice(&mut self) -> Option<String> {
        self.notice.take()
    }
}

/// The styluses of a page, which passes their reports to [`Pen::feed`](super::Pen::feed), and of macOS, where
/// styluses act as mice. So this has none.
#[cfg(not(any(target_os = "linux", windows)))]
#[derive(Debug, Default)]
pub(super) struct Systems {
    /// Always `None` here.
    pub(super) notice: Option<String>,
}

#[cfg(not(any(target_os = "linux", windows)))]
#[expect(clippy::unused_self, reason = "the calls of the other window systems")]
impl Systems {
    #[cfg(not(target_arch = "wasm32"))]
    pub(super) fn for_window(_: &eframe::CreationContext<'_>) -> Self {
        Self::default()
    }

    pub(super) fn reports(&mut self, _: &Context, _: &mut RawInput) -> Vec<Report> {
        Vec::new()
    }

    pub(super) fn mouse_times(&mut self, _: &Context) -> Vec<Stamp> {
        Vec::new()
    }

    pub(super) fn poll_after(&self, _: bool) -> Option<Duration> {
        None
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    fn event(phase: PagePhase, pressure: f64) -> PagePointer {
        let tilt_deg = (0.0, 0.0);
        let twist_deg = 0.0;
        let buttons = 1;
        let at = pos2(3.0, 4.0);
        let arrived = Instant::now();
        PagePointer { phase, at, pressure, tilt_deg, twist_deg, buttons, arrived }
    }

    fn state(reports: &[Report]) -> PointerState {
        match reports {
            [Report { kind: ReportKind::Moved(state) | ReportKind::Pressed(state), .. }] => *state,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_quantity_is_measured_from_its_first_value_on() {
        let mut pens = PagePens::default();
        let first = state(&pens.reports(&event(PagePhase::Down, 0.5)));
        assert_eq!((first.pressure, first.tilt_deg, first.twist_deg), (None, None, None));
        let tilted = PagePointer { tilt_deg: (20.0, -5.0), ..event(PagePhase::Move, 0.25) };
        let second = state(&pens.reports(&tilted));
        assert_eq!((second.pressure, second.tilt_deg), (Some(0.25), Some((20.0, -5.0))));
        let turned = PagePointer { twist_deg: 90.0, ..event(PagePhase::Move, 0.5) };
        let third = state(&pens.reports(&turned));
        assert_eq!((third.pressure, third.twist_deg), (Some(0.5), Some(90.0)), "0.5 may be true");
        assert_eq!(third.tilt_deg, Some((0.0, 0.0)), "upright");
        for _ in 0..2 * CERTAIN {
            pens.reports(&event(PagePhase::Move, 0.5));
        }
        assert_eq!(pens.take_notice(), None);
    }

    #[test]
    fn a_constant_pressure_is_none_and_is_told_once() {
        let mut pens = PagePens::default();
        let mut notices = Vec::new();
        pens.reports(&event(PagePhase::Down, 0.5));
        for _ in 0..3 * CERTAIN {
            assert_eq!(state(&pens.reports(&event(PagePhase::Move, 0.5))).pressure, None);
            notices.extend(pens.take_notice());
        }
        assert_eq!(notices.len(), 1);
        assert!(notices[0].contains("speed"), "{notices:?}");
    }

    #[test]
    fn the_eraser_and_the_barrel_are_told_by_their_buttons() {
        let mut pens = PagePens::default();
        let erasing = PagePointer { buttons: 32, ..event(PagePhase::Down, 0.4) };
        assert_eq!(pens.reports(&erasing)[0].device, Device::Eraser);
        let moved = PagePointer { buttons: 34, ..event(PagePhase::Move, 0.4) };
        let reports = pens.reports(&moved);
        let [barrel, _] = &reports[..] else { panic!("{reports:?}") };
        assert_eq!(barrel.kind, ReportKind::Barrel { button: 0, pressed: true });
        let gone = PagePointer { buttons: 0, ..event(PagePhase::Gone, 0.0) };
        let kinds: Vec<ReportKind> = pens.reports(&gone).iter().map(|report| report.kind).collect();
        assert_eq!(kinds, [ReportKind::Released, ReportKind::Gone]);
        assert!(
            pens.reports(&event(PagePhase::Up, 0.0)).iter().all(|r| r.kind != ReportKind::Released)
        );
    }
}
