//! All sources together: who paints, where, and what the window is told.

use std::time::{Duration, Instant};

use eframe::CreationContext;
use eframe::egui::{self, Event, Modifiers, RawInput};
use render::paint::pose::Sample;
use render::paint::strokes::SurfaceId;

use super::pointer::Pointer;
use super::report::{Device, Hold, Report, What};
use super::settings::PenSettings;
use super::sight::View;
use super::stroke::{Stroke, held};
use super::systems::Systems;
use session::PenSample;

/// A pen is near for so long after it told something. The window system tells
/// what it does as a mouse's doing too, and that must not paint again.
const NEAR: Duration = Duration::from_millis(300);

/// What a pen, mouse or finger does on the surfaces.
#[derive(Debug, Clone, PartialEq)]
pub enum PenEvent {
    /// It sets down; samples follow.
    Down {
        /// Where.
        surface: SurfaceId,
        /// By what.
        device: Device,
    },
    /// It is led on: at least one sample, seconds counted from the first of the
    /// stroke.
    Move(Vec<PenSample>),
    /// It is lifted.
    Up,
    /// It is over a surface.
    Hover {
        /// Which.
        surface: SurfaceId,
        /// How it is held; pressure and seconds are 0.
        sample: Sample,
        /// What is there.
        device: Device,
    },
    /// It is over no surface any more.
    Leave,
    /// A button on the barrel; the one nearer to the tip is 0.
    Barrel {
        /// Which.
        button: usize,
        /// Whether it is down now.
        pressed: bool,
    },
}

/// Everything that can lead a brush.
///
/// Once a frame: [`Pen::hear`] before the window's library sees the input, then
/// [`Pen::frame`].
#[derive(Debug, Default)]
pub struct Pen {
    /// What the painter wants of it.
    pub settings: PenSettings,
    systems: Systems,
    pointer: Pointer,
    /// Heard since the last frame.
    heard: Vec<Report>,
    near_until: Option<Instant>,
    stroke: Option<Stroke>,
    /// Whether something is held down that began on no surface.
    elsewhere: bool,
    /// What hovers, and what was told of it.
    hovers: Option<(Device, Hold)>,
    hovered: Option<PenEvent>,
    /// Where the last stroke ended, in mm.
    ended: Option<(SurfaceId, (f64, f64))>,
}

impl Pen {
    /// One without a window: mice and fingers, and what [`Pen::feed`] gives.
    #[must_use]
    pub fn new(settings: PenSettings) -> Self {
        Self { settings, ..Self::default() }
    }

    /// One over a window, with the pens of its system.
    #[must_use]
    pub fn over(context: &CreationContext<'_>, settings: PenSettings) -> Self {
        Self { settings, systems: Systems::over(context), ..Self::default() }
    }

    /// Why pens act as mice, if they do; told once.
    pub fn notice(&mut self) -> Option<String> {
        self.systems.notice.take()
    }

    /// Hears the pens of the system; for `App::raw_input_hook`.
    pub fn hear(&mut self, context: &egui::Context, input: &mut RawInput) {
        self.heard.extend(self.systems.reports(context, input));
    }

    /// Takes in a report as if a system had told it.
    pub fn feed(&mut self, report: Report) {
        self.heard.push(report);
    }

    /// Whether a stroke is open.
    #[must_use]
    pub fn is_down(&self) -> bool {
        self.stroke.is_some()
    }

    /// When [`Pen::frame`] has something to tell though nothing happens.
    #[must_use]
    pub fn next_frame(&self, now: Instant) -> Option<Duration> {
        let rests = self.stroke.as_ref().and_then(|stroke| stroke.rests_in(now));
        let finger = self.pointer.undecided().then_some(Duration::from_millis(10));
        let near = self.stroke.is_some() || self.is_near(now);
        [rests, finger, self.systems.asks_in(near)].into_iter().flatten().min()
    }

    /// Everything since the last frame, in order: `events` are egui's of this
    /// frame, `modifiers` the keys that are held (with shift, a stroke begins with
    /// a straight line from where the last one ended), `view` what is seen now.
    pub fn frame(
        &mut self,
        events: &[Event],
        modifiers: Modifiers,
        now: Instant,
        view: &View<'_>,
    ) -> Vec<PenEvent> {
        let mut reports = self.pointer.reports(events, now);
        let mut latest = None;
        for mut report in self.heard.drain(..) {
            report.arrived = latest.map_or(report.arrived, |at| report.arrived.max(at));
            latest = Some(report.arrived);
            reports.push(report);
        }
        // Stable: what one source tells stays in order.
        reports.sort_by_key(|report| report.arrived);
        if let Some(last) = reports.iter().rfind(|report| report.device.is_pen()) {
            self.near_until = Some(last.arrived.max(now) + NEAR);
        }
        if let Some(stroke) = &mut self.stroke
            && let Some(sight) = view.of(stroke.surface())
        {
            stroke.see(*sight);
        }
        let mut told = Vec::new();
        for report in reports {
            self.take(&report, modifiers, now, view, &mut told);
        }
        if let Some(stroke) = &mut self.stroke {
            stroke.rest(now, &self.settings);
            flush(stroke, &mut told);
        }
        self.hover(view, &mut told);
        told
    }

    /// Ends a stroke whatever holds the pen, as when the window loses it.
    pub fn let_go(&mut self, now: Instant) -> Vec<PenEvent> {
        let mut told = Vec::new();
        self.end(now, &mut told);
        told
    }

    fn is_near(&self, now: Instant) -> bool {
        self.near_until.is_some_and(|until| now < until)
    }

    fn take(
        &mut self,
        report: &Report,
        modifiers: Modifiers,
        now: Instant,
        view: &View<'_>,
        told: &mut Vec<PenEvent>,
    ) {
        let &Report { device, arrived, what } = report;
        let same = |other: Device| other == device || (other.is_pen() && device.is_pen());
        let paints = self.stroke.as_ref().is_some_and(|stroke| same(stroke.device));
        if !device.is_pen() && !paints && self.is_near(now) {
            return;
        }
        match what {
            What::Moved(hold) | What::Pressed(hold) if !hold.is_finite() => {}
            What::Moved(hold) => match &mut self.stroke {
                Some(stroke) if paints => stroke.lead(hold, arrived, &self.settings),
                Some(_) => {}
                None => self.hovers = Some((device, hold)),
            },
            What::Pressed(hold) => match &mut self.stroke {
                // The system had told the same press as a mouse's before.
                Some(stroke) if !paints && device.is_pen() => {
                    stroke.device = device;
                    stroke.lead(hold, arrived, &self.settings);
                }
                Some(_) if !paints => {}
                _ => {
                    self.end(arrived, told);
                    self.set_down(device, hold, arrived, modifiers, view, told);
                }
            },
            What::Released => {
                self.elsewhere = false;
                if paints {
                    self.end(arrived, told);
                    if device == Device::Touch {
                        self.hovers = None;
                    }
                }
            }
            What::Gone => {
                if paints && device.is_pen() {
                    self.end(arrived, told);
                }
                if device.is_pen() {
                    self.near_until = None;
                }
                if self.hovers.is_some_and(|(other, _)| same(other)) {
                    self.hovers = None;
                }
            }
            What::Barrel { button, pressed } => told.push(PenEvent::Barrel { button, pressed }),
        }
    }

    fn set_down(
        &mut self,
        device: Device,
        hold: Hold,
        at: Instant,
        modifiers: Modifiers,
        view: &View<'_>,
        told: &mut Vec<PenEvent>,
    ) {
        let Some(sight) = view.under(hold.at) else {
            self.elsewhere = true;
            return;
        };
        let from = self.ended.filter(|(surface, _)| modifiers.shift && *surface == sight.surface);
        let from = from.map(|(_, place)| place);
        told.push(PenEvent::Down { surface: sight.surface, device });
        self.stroke = Some(Stroke::new(device, hold, at, *sight, from, &self.settings));
        // Whatever comes after it is told.
        self.hovered = Some(PenEvent::Up);
    }

    fn end(&mut self, at: Instant, told: &mut Vec<PenEvent>) {
        let Some(mut stroke) = self.stroke.take() else { return };
        stroke.lift(at, &self.settings);
        flush(&mut stroke, told);
        told.push(PenEvent::Up);
        self.ended = Some((stroke.surface(), stroke.place()));
        self.hovers = Some((stroke.device, stroke.hold()));
    }

    fn hover(&mut self, view: &View<'_>, told: &mut Vec<PenEvent>) {
        if self.stroke.is_some() {
            return;
        }
        let found = self.hovers.filter(|_| !self.elsewhere).and_then(|(device, hold)| {
            let sight = view.under(hold.at)?;
            let sample = held(sight, &hold, self.settings.grip.twist_deg, &self.settings);
            Some(PenEvent::Hover { surface: sight.surface, sample, device })
        });
        if found != self.hovered {
            told.push(found.clone().unwrap_or(PenEvent::Leave));
            self.hovered = found;
        }
    }
}

/// Tells the samples that a stroke has gathered.
fn flush(stroke: &mut Stroke, told: &mut Vec<PenEvent>) {
    let samples = stroke.take();
    if !samples.is_empty() {
        told.push(PenEvent::Move(samples));
    }
}
