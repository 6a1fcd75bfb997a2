//! Combines all input devices: turns their reports into strokes and hover events on the surfaces.
//! [`TestField`] does this in a window, so that you can try the settings of the pen.

#[cfg(not(target_arch = "wasm32"))]
use eframe::CreationContext;
use eframe::egui::{self, Event, Modifiers, Pos2, RawInput, Rect, pos2};
use paint::pose::Sample;
use paint::strokes::SurfaceId;
use session::PenSample;
use session::brushes::BrushOptions;
use web_time::{Duration, Instant};

use super::aids::Guide;
use super::pen_stroke::{Handling, PenStroke, brush_sample};
use super::pointer::Pointer;
use super::report::{Device, PointerState, Report, ReportKind};
use super::settings::PenSettings;
#[cfg(any(target_os = "linux", windows))]
use super::systems::Systems;
use super::transform::{PenTargets, SurfaceTransform};
#[cfg(not(any(target_os = "linux", windows)))]
use super::web::Systems;

/// A stylus counts as near for this time after its last report. The window system reports a stylus
/// as a mouse too. While the stylus is near, we ignore the events of the mouse, because otherwise
/// it would paint twice.
const NEAR: Duration = Duration::from_millis(300);

/// An event of a stylus, mouse or finger on canvas or palette.
#[derive(Debug, Clone, PartialEq)]
pub enum PenEvent {
    /// The device touched a surface and a stroke begins. Samples follow.
    Down {
        /// The surface that was touched.
        surface: SurfaceId,
        /// The device that paints.
        device: Device,
    },
    /// The stroke continues. This has at least one sample. Seconds count from the first sample of
    /// the stroke.
    Move(Vec<PenSample>),
    /// The stroke ends.
    Up,
    /// The device is over a surface without painting.
    Hover {
        /// The surface below the device.
        surface: SurfaceId,
        /// Position and attitude of the brush. Pressure and seconds are 0.
        sample: Sample,
        /// The device that hovers.
        device: Device,
    },
    /// The device is no longer over any surface.
    Leave,
    /// Several fingers tapped a surface at once.
    Tap {
        /// Number of fingers, 2 or more.
        fingers: usize,
    },
    /// A button on the barrel of a stylus changed.
    Barrel {
        /// Button number; 0 is the button nearest to the tip.
        button: usize,
        /// Whether you pressed the button. False means you released it.
        pressed: bool,
    },
}

/// All devices that can paint: styluses, mice and fingers.
///
/// Call [`Pen::read_systems`] once a frame before egui processes its input, then
/// [`Pen::process_frame`].
#[derive(Debug, Default)]
pub struct Pen {
    /// Preferences for pressure and grip.
    pub settings: PenSettings,
    /// Options of the brush in hand. They override the settings.
    pub options: BrushOptions,
    /// Options of the brush that the eraser end of a stylus moves.
    pub eraser_options: BrushOptions,
    /// The guide that leads strokes on the canvas that begin from now on.
    pub guide: Option<Guide>,
    systems: Systems,
    pointer: Pointer,
    pending: Vec<Report>,
    /// Reports that we used in the last frame.
    used: Vec<Report>,
    stylus_near_until: Option<Instant>,
    stroke: Option<PenStroke>,
    /// Whether a button or finger is still down that was pressed outside the surfaces.
    pressed_outside: bool,
    /// The device over the window, with its state.
    hovering: Option<(Device, PointerState)>,
    reported_hover: Option<PenEvent>,
    /// Surface and position in mm where the last stroke ended.
    last_end: Option<(SurfaceId, (f64, f64))>,
}

impl Pen {
    /// Input without a window. Mice and fingers come from egui, and you pass other reports to
    /// [`Pen::feed`].
    #[must_use]
    pub fn new(settings: PenSettings) -> Self {
        Self { settings, ..Self::default() }
    }

    /// Input for a window, with the styluses of its window system.
    #[must_use]
    #[cfg(not(target_arch = "wasm32"))]
    pub fn for_window(context: &CreationContext<'_>, settings: PenSettings) -> Self {
        Self { settings, systems: Systems::for_window(context), ..Self::default() }
    }

    /// Removes and returns the reason why styluses act as mice; `None` if they do not, or if you
    /// have asked before.
    pub fn take_notice(&mut self) -> Option<String> {
        self.systems.notice.take()
    }

    /// Collects the reports of the window system's styluses and the times of its mice. Call this
    /// from `App::raw_input_hook`.
    pub fn read_systems(&mut self, context: &egui::Context, input: &mut RawInput) {
        self.pending.extend(self.systems.reports(context, input));
        self.pointer.stamp(self.systems.mouse_times(context));
    }

    /// Adds a report as if a window system had sent it. You can use this in tests.
    pub fn feed(&mut self, report: Report) {
        self.pending.push(report);
    }

    /// Reports used in the last frame, in order. This leaves out the mouse events that the system
    /// makes of a stylus.
    #[must_use]
    pub fn reports(&self) -> &[Report] {
        &self.used
    }

    /// Line in the window from the brush to the pen, while a stabilised brush stays behind.
    #[must_use]
    pub fn string_line(&self) -> Option<[Pos2; 2]> {
        self.stroke.as_ref()?.string_line()
    }

    /// Surface of the open stroke of a stylus, if one is open.
    #[must_use]
    pub fn stylus_on(&self) -> Option<SurfaceId> {
        self.stroke.as_ref().filter(|stroke| stroke.device.is_pen()).map(PenStroke::surface)
    }

    /// Whether a stroke is open.
    #[must_use]
    pub fn is_down(&self) -> bool {
        self.stroke.is_some()
    }

    /// Time until you must call [`Pen::process_frame`] again even without new input; `None` if you
    /// need not.
    #[must_use]
    pub fn repaint_after(&self, now: Instant) -> Option<Duration> {
        let rests = self.stroke.as_ref().and_then(|stroke| stroke.next_rest_sample(now));
        let finger = self.pointer.undecided().then_some(Duration::from_millis(10));
        let near = self.stroke.is_some() || self.is_near(now);
        [rests, finger, self.systems.poll_after(near)].into_iter().flatten().min()
    }

    /// Returns all events since the last frame in order of time. `events` are egui's events of this
    /// frame, `modifiers` the held keys, and `targets` the surfaces that you see now. With shift, a
    /// stroke begins with a straight line from the end of the last one.
    pub fn process_frame(
        &mut self,
        events: &[Event],
        modifiers: Modifiers,
        now: Instant,
        targets: &PenTargets<'_>,
    ) -> Vec<PenEvent> {
        let mut reports = self.pointer.reports(events, now);
        let mut latest = None;
        for mut report in self.pending.drain(..) {
            report.arrived = latest.map_or(report.arrived, |at| report.arrived.max(at));
            latest = Some(report.arrived);
            reports.push(report);
        }
        // A stable sort keeps the order within each device.
        reports.sort_by_key(|report| report.arrived);
        if let Some(last) = reports.iter().rfind(|report| report.device.is_pen()) {
            self.stylus_near_until = Some(last.arrived.max(now) + NEAR);
        }
        if let Some(stroke) = &mut self.stroke
            && let Some(transform) = targets.transform_of(stroke.surface())
        {
            stroke.set_transform(*transform);
        }
        self.used.clear();
        let mut events = Vec::new();
        for report in reports {
            self.handle(&report, modifiers, now, targets, &mut events);
        }
        if let Some(stroke) = &mut self.stroke {
            let options = options_for(stroke.device, &self.options, &self.eraser_options);
            let handling = Handling { settings: &self.settings, options };
            stroke.add_rest_sample(now, &handling);
            flush(stroke, &mut events);
        }
        // The palm of a hand that holds a stylus is not a tap.
        let tapped = self.pointer.tapped().filter(|tap| {
            self.stroke.is_none() && !self.is_near(now) && targets.surface_at(tap.at).is_some()
        });
        events.extend(tapped.map(|tap| PenEvent::Tap { fingers: tap.fingers }));
        self.hover(targets, &mut events);
        events
    }

    /// Ends the open stroke, for example when the window loses focus.
    pub fn end_stroke(&mut self, now: Instant) -> Vec<PenEvent> {
        let mut events = Vec::new();
        self.finish_stroke(now, &mut events);
        events
    }

    /// How a device leads its brush.
    pub(super) fn handling(&self, device: Device) -> Handling<'_> {
        let options = options_for(device, &self.options, &self.eraser_options);
        Handling { settings: &self.settings, options }
    }

    fn is_near(&self, now: Instant) -> bool {
        self.stylus_near_until.is_some_and(|until| now < until)
    }

    fn handle(
        &mut self,
        report: &Report,
        modifiers: Modifiers,
        now: Instant,
        targets: &PenTargets<'_>,
        events: &mut Vec<PenEvent>,
    ) {
        let &Report { device, arrived, kind } = report;
        let same = |other: Device| other == device || (other.is_pen() && device.is_pen());
        let paints = self.stroke.as_ref().is_some_and(|stroke| same(stroke.device));
        if !device.is_pen() && !paints && self.is_near(now) {
            return;
        }
        let options = options_for(device, &self.options, &self.eraser_options);
        let handling = Handling { settings: &self.settings, options };
        match kind {
            ReportKind::Moved(state) | ReportKind::Pressed(state) if !state.is_finite() => return,
            _ => self.used.push(*report),
        }
        match kind {
            ReportKind::Moved(state) => match &mut self.stroke {
                Some(stroke) if paints => stroke.extend(state, arrived, &handling),
                Some(_) => {}
                None => self.hovering = Some((device, state)),
            },
            ReportKind::Pressed(state) => match &mut self.stroke {
                // The system reported this press as a mouse event before, and it began the stroke.
                Some(stroke) if !paints && device.is_pen() => {
                    stroke.device = device;
                    stroke.extend(state, arrived, &handling);
                }
                Some(_) if !paints => {}
                _ => {
                    self.finish_stroke(arrived, events);
                    self.begin_stroke(device, state, arrived, modifiers, targets, events);
                }
            },
            ReportKind::Released => {
                self.pressed_outside = false;
                if paints {
                    self.finish_stroke(arrived, events);
                    if device == Device::Touch {
                        self.hovering = None;
                    }
                }
            }
            ReportKind::Gone => {
                if paints && device.is_pen() {
                    self.finish_stroke(arrived, events);
                }
                if device.is_pen() {
                    self.stylus_near_until = None;
                }
                if self.hovering.is_some_and(|(other, _)| same(other)) {
                    self.hovering = None;
                }
            }
            ReportKind::Barrel { button, pressed } => {
                events.push(PenEvent::Barrel { button, pressed });
            }
        }
    }

    fn begin_stroke(
        &mut self,
        device: Device,
        state: PointerState,
        at: Instant,
        modifiers: Modifiers,
        targets: &PenTargets<'_>,
        events: &mut Vec<PenEvent>,
    ) {
        let Some(transform) = targets.surface_at(state.at) else {
            self.pressed_outside = true;
            return;
        };
        let from =
            self.last_end.filter(|(surface, _)| modifiers.shift && *surface == transform.surface);
        let from = from.map(|(_, place)| place);
        events.push(PenEvent::Down { surface: transform.surface, device });
        let handling = self.handling(device);
        let guide = self.guide.filter(|_| transform.surface == SurfaceId::Canvas);
        let stroke = PenStroke::new(device, state, at, (*transform, guide), from, &handling);
        self.stroke = Some(stroke);
        // This differs from every hover event, so the next one is reported as a change.
        self.reported_hover = Some(PenEvent::Up);
    }

    fn finish_stroke(&mut self, at: Instant, events: &mut Vec<PenEvent>) {
        let Some(mut stroke) = self.stroke.take() else { return };
        let handling = self.handling(stroke.device);
        stroke.finish(at, &handling);
        flush(&mut stroke, events);
        events.push(PenEvent::Up);
        self.last_end = Some((stroke.surface(), stroke.end_mm()));
        self.hovering = Some((stroke.device, stroke.state()));
    }

    fn hover(&mut self, targets: &PenTargets<'_>, events: &mut Vec<PenEvent>) {
        if self.stroke.is_some() {
            return;
        }
        let found = self.hovering.filter(|_| !self.pressed_outside).and_then(|(device, state)| {
            let transform = targets.surface_at(state.at)?;
            let handling = self.handling(device);
            let sample = brush_sample(transform, &state, handling.first_twist(), &handling);
            Some(PenEvent::Hover { surface: transform.surface, sample, device })
        });
        if found != self.reported_hover {
            events.push(found.clone().unwrap_or(PenEvent::Leave));
            self.reported_hover = found;
        }
    }
}

/// Options of the brush that a device moves.
fn options_for<'a>(
    device: Device,
    options: &'a BrushOptions,
    eraser_options: &'a BrushOptions,
) -> &'a BrushOptions {
    if device == Device::Eraser { eraser_options } else { options }
}

/// Reports the samples that the stroke has gathered.
fn flush(stroke: &mut PenStroke, events: &mut Vec<PenEvent>) {
    let samples = stroke.take_samples();
    if !samples.is_empty() {
        events.push(PenEvent::Move(samples));
    }
}

/// Millimetres per point of the window, at the usual 96 points per inch.
const MM_PER_POINT: f64 = 25.4 / 96.0;

/// Strokes that stay in the field.
const MOST_STROKES: usize = 8;

/// A sample of a stroke in the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TestPoint {
    /// Place in points from the upper left corner of the field.
    pub at: Pos2,
    /// Pressure of the brush, 0 to 1.
    pub pressure: f64,
}

/// Strokes drawn on a field.
#[derive(Debug, Default)]
pub struct TestField {
    stroke: Option<PenStroke>,
    strokes: Vec<Vec<TestPoint>>,
}

impl TestField {
    /// Draws with the reports of this frame in `area`, with the pen's settings and options.
    /// `reachable` says whether nothing lies above the area.
    pub fn update(&mut self, pen: &Pen, area: Rect, reachable: bool, now: Instant) {
        for report in pen.reports() {
            self.handle(report, area, reachable, &pen.handling(report.device));
        }
        if let Some(stroke) = &mut self.stroke {
            stroke.add_rest_sample(now, &pen.handling(stroke.device));
        }
        self.take_samples();
    }

    /// The strokes in the order of drawing.
    #[must_use]
    pub fn strokes(&self) -> &[Vec<TestPoint>] {
        &self.strokes
    }

    /// Whether a stroke is open.
    #[must_use]
    pub fn is_drawing(&self) -> bool {
        self.stroke.is_some()
    }

    /// Removes all strokes.
    pub fn clear(&mut self) {
        (self.stroke, self.strokes) = (None, Vec::new());
    }

    fn handle(&mut self, report: &Report, area: Rect, reachable: bool, handling: &Handling<'_>) {
        let Report { device, arrived, kind } = *report;
        match kind {
            ReportKind::Pressed(state) if reachable && area.contains(state.at) => {
                self.finish(arrived, handling);
                let corner = area.min;
                let transform = SurfaceTransform::new(SurfaceId::Canvas, area, |at| {
                    let place = at - corner;
                    (f64::from(place.x) * MM_PER_POINT, f64::from(place.y) * MM_PER_POINT)
                });
                self.stroke =
                    Some(PenStroke::new(device, state, arrived, (transform, None), None, handling));
                self.strokes.push(Vec::new());
                let surplus = self.strokes.len().saturating_sub(MOST_STROKES);
                self.strokes.drain(..surplus);
            }
            ReportKind::Moved(state) => {
                if let Some(stroke) = &mut self.stroke {
                    stroke.extend(state, arrived, handling);
                }
            }
            ReportKind::Released | ReportKind::Gone => self.finish(arrived, handling),
            ReportKind::Pressed(_) | ReportKind::Barrel { .. } => {}
        }
    }

    fn finish(&mut self, at: Instant, handling: &Handling<'_>) {
        if let Some(stroke) = &mut self.stroke {
            stroke.finish(at, handling);
            self.take_samples();
            self.stroke = None;
        }
    }

    fn take_samples(&mut self) {
        let (Some(stroke), Some(points)) = (&mut self.stroke, self.strokes.last_mut()) else {
            return;
        };
        points.extend(stroke.take_samples().into_iter().map(|taken| {
            let sample = taken.sample;
            TestPoint {
                at: pos2((sample.x_mm / MM_PER_POINT) as f32, (sample.y_mm / MM_PER_POINT) as f32),
                pressure: sample.pressure,
            }
        }));
    }
}
