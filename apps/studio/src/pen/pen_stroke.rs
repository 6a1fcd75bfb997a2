//! Turns the states of a pressed device into samples of a stroke. The settings of the pen and the
//! options of the brush say how.

use eframe::egui::{Pos2, Vec2};
use paint::pose::Sample;
use paint::strokes::SurfaceId;
use session::PenSample;
use session::brushes::{BrushOptions, StabiliserMethod, TiltUse, TwistUse};
use web_time::{Duration, Instant};

use super::aids::{Guide, Lead};
use super::report::{Device, PointerState};
use super::settings::{Grip, PenSettings};
use super::stabiliser::{SpeedPressure, Stabiliser, distance};
use super::transform::SurfaceTransform;

/// Time without reports after which a pen counts as still. We then add a sample at its position,
/// because the smoothed path of the brush lags one sample behind.
pub(super) const STILL: Duration = Duration::from_millis(30);

/// While the pen rests, we add a sample if the pressure changes by more than this (1 is full
/// pressure).
const CHANGED: f64 = 0.005;

/// Seconds between the samples at the end of a stroke.
const END_INTERVAL_SECONDS: f64 = 0.008;

/// Speed of a straight line drawn with shift, in mm per second.
const LINE_SPEED_MM_S: f64 = 100.0;
/// The pressure of a straight line rises over this length, in mm.
const LINE_START_MM: f64 = 2.0;

/// Perspective takes the direction of a stroke after this length, in points.
const DECIDED_POINTS: f64 = 14.0;

/// The first samples wait at most this long for the direction of the stroke.
const LONGEST_WAIT: Duration = Duration::from_millis(80);

#[derive(Debug)]
pub(super) struct PenStroke {
    pub(super) device: Device,
    transform: SurfaceTransform,
    began: Instant,
    /// Seconds that the straight line at the start takes.
    line_seconds: f64,
    pressure_model: SpeedPressure,
    state: PointerState,
    moved: Instant,
    /// Whether the last sample was added because the pen rested.
    still: bool,
    heading: Heading,
    stabiliser: Stabiliser,
    lead: Lead,
    last: Option<Sample>,
    samples: Vec<PenSample>,
}

impl PenStroke {
    /// Begins a stroke on a surface. A guide may lead it. If you give `from`, a position in mm, a
    /// straight line leads from there to the pen.
    pub(super) fn new(
        device: Device,
        state: PointerState,
        at: Instant,
        (transform, guide): (SurfaceTransform, Option<Guide>),
        from: Option<(f64, f64)>,
        handling: &Handling<'_>,
    ) -> Self {
        let (method, length_mm) = handling.stabiliser(&transform);
        let mut stroke = Self {
            device,
            transform,
            began: at,
            line_seconds: 0.0,
            pressure_model: SpeedPressure::new(state.at, 0.0),
            state,
            moved: at,
            still: false,
            heading: Heading::new(handling.first_twist()),
            stabiliser: Stabiliser::new(method, length_mm),
            lead: Lead::new(guide, DECIDED_POINTS * transform.mm_per_point()),
            last: None,
            samples: Vec::new(),
        };
        if !handling.follows() {
            stroke.heading.start();
        }
        if let Some(from) = from {
            stroke.add_straight_line(from, at, handling);
        }
        stroke.extend(state, at, handling);
        stroke
    }

    pub(super) fn surface(&self) -> SurfaceId {
        self.transform.surface
    }

    pub(super) fn state(&self) -> PointerState {
        self.state
    }

    pub(super) fn position_mm(&self) -> (f64, f64) {
        self.transform.position_mm(self.state.at)
    }

    /// The place in mm where the brush will be after it has caught up.
    pub(super) fn end_mm(&self) -> (f64, f64) {
        self.lead.led(self.position_mm())
    }

    pub(super) fn set_transform(&mut self, transform: SurfaceTransform) {
        self.transform = transform;
    }

    /// Adds a sample for a new state of the device.
    pub(super) fn extend(&mut self, state: PointerState, at: Instant, handling: &Handling<'_>) {
        let seconds = self.seconds(at);
        let by_speed = handling.pressure_by_speed(self.pressure_model.move_to(state.at, seconds));
        let pressure = state.pressure.map_or(by_speed, |pressure| handling.pressure(pressure));
        let step = state.at - self.state.at;
        self.state = state;
        self.moved = at;
        self.still = false;
        let before = self.lead.last();
        let free = self.stabiliser.is_off() && self.lead.is_off();
        let place = self.follow(handling);
        if handling.follows() {
            let step = match before {
                Some(before) if !free => self.way_in_window(self.lead.led(before), place),
                _ => step,
            };
            self.heading.add(step);
        }
        self.add_sample(place, pressure, seconds, at, handling);
        let measured = handling.measured_twist(&state).is_some();
        let clear = self.heading.is_clear() || self.has_waited(at);
        if measured || clear && !self.lead.is_open() {
            self.start_heading(handling);
        }
    }

    /// Adds one sample when the pen comes to rest, and more only while the pressure changes.
    pub(super) fn add_rest_sample(&mut self, now: Instant, handling: &Handling<'_>) {
        if self.has_waited(now) && !self.lead.is_open() {
            self.start_heading(handling);
        }
        if now.saturating_duration_since(self.moved) < STILL {
            return;
        }
        let seconds = self.seconds(now);
        let pressure = self.pressure(seconds, handling);
        let last = self.last.map_or(0.0, |last| last.pressure);
        if !self.still || (pressure - last).abs() > CHANGED {
            self.still = true;
            let place = self.follow(handling);
            self.add_sample(place, pressure, seconds, now, handling);
        }
    }

    /// Place of the brush for the present place of the pen. The stabiliser keeps the brush behind
    /// the pen, and a guide keeps it on its line.
    fn follow(&mut self, handling: &Handling<'_>) -> (f64, f64) {
        let place = self.stabiliser.follow(self.position_mm());
        self.led(place, handling)
    }

    /// The place on the line of the guide for a place of the brush. Once we know this line, we move
    /// the samples that waited for it there, and turn a brush that follows its direction.
    fn led(&mut self, place: (f64, f64), handling: &Handling<'_>) -> (f64, f64) {
        let waited = self.lead.is_open();
        let place = self.lead.follow(place);
        if !waited || self.lead.is_open() {
            return place;
        }
        for PenSample { sample, .. } in &mut self.samples {
            (sample.x_mm, sample.y_mm) = self.lead.led((sample.x_mm, sample.y_mm));
        }
        let first = self.samples.first().map(|first| (first.sample.x_mm, first.sample.y_mm));
        if let Some(first) = first
            && !self.heading.is_started()
        {
            self.heading = Heading::new(handling.first_twist());
            self.heading.add(self.way_in_window(first, place));
            self.start_heading(handling);
        }
        place
    }

    /// Time until [`Self::add_rest_sample`] must be called; `None` if it would do nothing.
    pub(super) fn next_rest_sample(&self, now: Instant) -> Option<Duration> {
        let waits = (!self.heading.is_started() && !self.lead.is_open())
            .then(|| LONGEST_WAIT.saturating_sub(now.saturating_duration_since(self.began)));
        [waits, self.next_still_sample(now)].into_iter().flatten().min()
    }

    fn next_still_sample(&self, now: Instant) -> Option<Duration> {
        let landing = self.state.pressure.is_none()
            && self.pressure_model.pressure(f64::INFINITY)
                - self.pressure_model.pressure(self.seconds(now))
                > CHANGED;
        match (self.still, landing) {
            (false, _) => Some(STILL.saturating_sub(now.saturating_duration_since(self.moved))),
            (true, true) => Some(Duration::from_millis(10)),
            (true, false) => None,
        }
    }

    /// Adds the samples that end a stroke. A brush that stayed behind catches up, and a brush
    /// without pressure is lifted.
    pub(super) fn finish(&mut self, at: Instant, handling: &Handling<'_>) {
        self.catch_up(at, handling);
        self.lead.settle();
        self.start_heading(handling);
        if self.state.pressure.is_some() {
            return;
        }
        let mut seconds = self.last_seconds().max(self.seconds(at));
        for pressure in self.pressure_model.end_pressures(self.seconds(at)) {
            seconds += END_INTERVAL_SECONDS;
            let pressure = handling.pressure_by_speed(pressure);
            self.add_sample(self.end_mm(), pressure, seconds, at, handling);
        }
    }

    /// Moves the brush to the last place of the pen, as fast as a straight line is drawn.
    fn catch_up(&mut self, at: Instant, handling: &Handling<'_>) {
        let mut before = self.lead.last().unwrap_or_else(|| self.position_mm());
        let mut seconds = self.last_seconds().max(self.seconds(at));
        let pressure = self.last.map_or(0.0, |last| last.pressure);
        for place in self.stabiliser.catch_up() {
            let place = self.led(place, handling);
            if handling.follows() {
                self.heading.add(self.way_in_window(self.lead.led(before), place));
            }
            seconds += distance(before, place) / LINE_SPEED_MM_S;
            self.add_sample(place, pressure, seconds, at, handling);
            before = place;
        }
    }

    /// Line in the window from the brush to the pen, if the brush stays behind.
    pub(super) fn string_line(&self) -> Option<[Pos2; 2]> {
        let free = self.stabiliser.is_off() && self.lead.is_off();
        let brush = self.lead.last().filter(|_| !free)?;
        Some([self.state.at + self.way_in_window(self.position_mm(), brush), self.state.at])
    }

    fn way_in_window(&self, from: (f64, f64), to: (f64, f64)) -> Vec2 {
        self.transform.way_in_window((to.0 - from.0, to.1 - from.1))
    }

    fn last_seconds(&self) -> f64 {
        self.last.map_or(0.0, |last| last.seconds)
    }

    /// Removes and returns the samples since the last call. There are none until we know the
    /// direction that brush or guide follow. If the brush turned on the canvas, it would paint a
    /// hook.
    pub(super) fn take_samples(&mut self) -> Vec<PenSample> {
        let waits = !self.heading.is_started() || self.lead.is_open();
        if waits { Vec::new() } else { std::mem::take(&mut self.samples) }
    }

    fn has_waited(&self, now: Instant) -> bool {
        now.saturating_duration_since(self.began) >= LONGEST_WAIT
    }

    /// Turns the brush across the direction of the stroke, from its first sample on.
    fn start_heading(&mut self, handling: &Handling<'_>) {
        if self.heading.is_started() {
            return;
        }
        self.heading.start();
        let Sample { twist_deg, .. } =
            brush_sample(&self.transform, &self.state, self.heading.twist(), handling);
        for PenSample { sample, .. } in &mut self.samples {
            sample.twist_deg = twist_deg;
        }
    }

    /// Adds a straight line from `from`, in mm, to the current position.
    fn add_straight_line(&mut self, from: (f64, f64), at: Instant, handling: &Handling<'_>) {
        let (from, to) = match self.lead.is_off() {
            true => (from, self.position_mm()),
            false => (self.lead.follow(from), self.lead.follow(self.position_mm())),
        };
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        if length < LINE_START_MM {
            return;
        }
        if handling.follows() {
            self.heading.add(self.way_in_window(from, to));
            self.start_heading(handling);
        }
        self.pressure_model =
            SpeedPressure::new(self.state.at, length / LINE_SPEED_MM_S).at_full_pressure();
        let moderate = handling.pressure_by_speed(self.pressure_model.pressure(0.0));
        let full = self
            .state
            .pressure
            .map_or(moderate, |measured| handling.pressure(measured).max(moderate));
        for (mm, pressure) in [(0.0, 0.2 * full), (LINE_START_MM, full)] {
            let share = mm / length;
            let position_mm = (from.0 + (to.0 - from.0) * share, from.1 + (to.1 - from.1) * share);
            let sample = brush_sample(&self.transform, &self.state, self.heading.twist(), handling);
            let sample = Sample { pressure, seconds: mm / LINE_SPEED_MM_S, ..sample };
            self.push(Sample { x_mm: position_mm.0, y_mm: position_mm.1, ..sample }, at);
        }
        self.line_seconds = length / LINE_SPEED_MM_S;
        if let Some(measured) = &mut self.state.pressure {
            *measured = full;
        }
    }

    fn seconds(&self, at: Instant) -> f64 {
        at.saturating_duration_since(self.began).as_secs_f64() + self.line_seconds
    }

    fn pressure(&self, seconds: f64, handling: &Handling<'_>) -> f64 {
        self.state.pressure.map_or_else(
            || handling.pressure_by_speed(self.pressure_model.pressure(seconds)),
            |measured| handling.pressure(measured),
        )
    }

    fn add_sample(
        &mut self,
        (x_mm, y_mm): (f64, f64),
        pressure: f64,
        seconds: f64,
        at: Instant,
        handling: &Handling<'_>,
    ) {
        let sample = brush_sample(&self.transform, &self.state, self.heading.twist(), handling);
        self.push(Sample { pressure, seconds, x_mm, y_mm, ..sample }, at);
    }

    /// Adds a sample. Time never runs backwards: an earlier time is set to the time of the last
    /// sample.
    fn push(&mut self, sample: Sample, arrived: Instant) {
        let earliest = self.last.map_or(0.0, |last| last.seconds);
        let sample = Sample { seconds: sample.seconds.max(earliest), ..sample };
        self.last = Some(sample);
        self.samples.push(PenSample { sample, arrived });
    }
}

/// Sample of a brush over a surface at pressure 0. If the device measures no rotation, `twist` is
/// used.
pub(super) fn brush_sample(
    transform: &SurfaceTransform,
    state: &PointerState,
    twist: f64,
    handling: &Handling<'_>,
) -> Sample {
    let (x_mm, y_mm) = transform.position_mm(state.at);
    let tilt = transform.surface_tilt(handling.tilt_deg(state));
    let twist = handling.measured_twist(state).unwrap_or(twist);
    let twist_deg = transform.surface_twist(twist);
    let tilt_x_deg = tilt.0.clamp(-90.0, 90.0);
    let tilt_y_deg = tilt.1.clamp(-90.0, 90.0);
    Sample { seconds: 0.0, x_mm, y_mm, pressure: 0.0, tilt_x_deg, tilt_y_deg, twist_deg }
}

/// The general settings and the options of the brush in hand. The options win.
#[derive(Debug, Clone, Copy)]
pub(super) struct Handling<'a> {
    pub(super) settings: &'a PenSettings,
    pub(super) options: &'a BrushOptions,
}

impl Handling<'_> {
    /// Pressure of the brush for a measured pressure, 0 to 1.
    pub(super) fn pressure(&self, measured: f64) -> f64 {
        let curve = self.options.curve.as_ref().unwrap_or(&self.settings.curve);
        self.options.in_range(curve.at(measured))
    }

    /// Pressure of the brush for a device without pressure; `pressure` follows from its speed.
    pub(super) fn pressure_by_speed(&self, pressure: f64) -> f64 {
        self.options.in_range(pressure)
    }

    /// Tilt in the window, in degrees.
    pub(super) fn tilt_deg(&self, state: &PointerState) -> (f64, f64) {
        let grip = self.settings.grip;
        let measured = match self.options.tilt {
            TiltUse::AsSet => state.tilt_deg.filter(|_| self.settings.pen_tilt),
            TiltUse::Pen => state.tilt_deg,
            TiltUse::Ignored => None,
            TiltUse::Fixed(lean_deg) => return Grip { lean_deg, ..grip }.tilt_deg(),
        };
        measured.unwrap_or_else(|| grip.tilt_deg())
    }

    /// Rotation in the window that the device measures, in degrees. `None` if it measures none, or
    /// if the settings ignore it.
    pub(super) fn measured_twist(&self, state: &PointerState) -> Option<f64> {
        match self.options.twist {
            TwistUse::AsSet => state.twist_deg.filter(|_| self.settings.pen_tilt),
            TwistUse::Device => state.twist_deg,
            TwistUse::Stroke | TwistUse::Fixed(_) => None,
        }
    }

    /// Rotation in the window that a brush has at the start of a stroke if none is measured, in
    /// degrees.
    pub(super) fn first_twist(&self) -> f64 {
        match self.options.twist {
            TwistUse::Fixed(degrees) => degrees,
            _ => self.settings.grip.twist_deg,
        }
    }

    /// Whether the broad side turns across the direction of the stroke, if no rotation is measured.
    pub(super) fn follows(&self) -> bool {
        match self.options.twist {
            TwistUse::AsSet | TwistUse::Device => self.settings.follow,
            TwistUse::Stroke => true,
            TwistUse::Fixed(_) => false,
        }
    }

    /// Method of the stabiliser, and its length in mm on a surface with this transform.
    pub(super) fn stabiliser(&self, transform: &SurfaceTransform) -> (StabiliserMethod, f64) {
        let settings = self.options.stabiliser.unwrap_or(self.settings.stabiliser);
        let scale = match settings.unit {
            session::brushes::LengthUnit::Mm => 1.0,
            session::brushes::LengthUnit::Px => transform.mm_per_point(),
        };
        (settings.method, settings.length * scale)
    }
}

/// Over this length, in points, a brush that turns reduces the angle still to turn by a factor of
/// e.
const TURNING_POINTS: f64 = 30.0;

/// We average the direction of the stroke over this length, in points. Single steps of a mouse are
/// a few whole points, so their directions jump by up to 45 degrees.
const AVERAGED_POINTS: f64 = 20.0;

/// We take the first direction of the stroke after this length, in points. A shorter length would
/// make the direction coarse, a longer one would delay the stroke.
const START_POINTS: f64 = 8.0;

/// Rotation of a brush that follows its stroke.
#[derive(Debug, Clone, Copy)]
pub(super) struct Heading {
    twist: f64,
    /// Recent displacement of the stroke in points, right and down. Older steps weigh less.
    way: (f64, f64),
    path: f64,
    /// Whether the rotation at the start of the stroke is decided.
    started: bool,
}

impl Heading {
    /// A stroke without direction, with this rotation of the brush.
    pub(super) fn new(twist: f64) -> Self {
        Self { twist, way: (0.0, 0.0), path: 0.0, started: false }
    }

    pub(super) fn twist(&self) -> f64 {
        self.twist
    }

    pub(super) fn is_started(&self) -> bool {
        self.started
    }

    /// Whether the stroke is long enough to have a direction.
    pub(super) fn is_clear(&self) -> bool {
        self.path >= START_POINTS
    }

    /// Adds a step of the stroke. Once started, the brush turns gradually across the direction.
    pub(super) fn add(&mut self, step: Vec2) {
        let length = f64::from(step.length());
        if length == 0.0 {
            return;
        }
        let kept = (-length / AVERAGED_POINTS).exp();
        self.way = (self.way.0 * kept + f64::from(step.x), self.way.1 * kept + f64::from(step.y));
        self.path += length;
        if self.started {
            self.twist += self.off() * (1.0 - (-length / TURNING_POINTS).exp());
        }
    }

    /// Decides the rotation at the start: across the direction so far, if there is one.
    pub(super) fn start(&mut self) {
        self.started = true;
        if self.path > 0.0 {
            self.twist += self.off();
        }
    }

    /// Angle in degrees by which the broad side must turn to lie across the direction. We take it
    /// modulo 180 degrees, because it does not matter which end of the broad side is where.
    fn off(&self) -> f64 {
        let across = self.way.1.atan2(self.way.0).to_degrees() + 90.0;
        (across - self.twist + 90.0).rem_euclid(180.0) - 90.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::Pos2;
    use session::brushes::PressureCurve;

    fn state() -> PointerState {
        let tilt_deg = Some((20.0, -10.0));
        let twist_deg = Some(70.0);
        PointerState { tilt_deg, twist_deg, ..PointerState::at(Pos2::ZERO) }
    }

    #[test]
    fn options_of_the_brush_come_before_the_general_settings() {
        let general = PenSettings { curve: PressureCurve::Power(2.0), ..PenSettings::default() };
        let plain = BrushOptions::default();
        let handling = Handling { settings: &general, options: &plain };
        assert_eq!((handling.pressure(0.5), handling.tilt_deg(&state())), (0.25, (20.0, -10.0)));
        assert_eq!((handling.measured_twist(&state()), handling.follows()), (Some(70.0), true));
        let own = BrushOptions {
            tilt: TiltUse::Ignored,
            twist: TwistUse::Fixed(40.0),
            range: [0.5, 1.0],
            curve: Some(PressureCurve::LINEAR),
            stabiliser: None,
        };
        let handling = Handling { options: &own, ..handling };
        assert_eq!((handling.pressure(0.5), handling.pressure_by_speed(0.2)), (0.75, 0.6));
        assert_eq!(handling.tilt_deg(&state()), general.grip.tilt_deg());
        let twist = (handling.measured_twist(&state()), handling.first_twist(), handling.follows());
        assert_eq!(twist, (None, 40.0, false));
    }

    #[test]
    fn a_brush_uses_the_pen_although_the_general_settings_do_not() {
        let general = PenSettings { pen_tilt: false, follow: false, ..PenSettings::default() };
        let plain = BrushOptions::default();
        let handling = Handling { settings: &general, options: &plain };
        assert_eq!(handling.tilt_deg(&state()), general.grip.tilt_deg());
        assert_eq!(handling.measured_twist(&state()), None);
        let own = BrushOptions { tilt: TiltUse::Pen, twist: TwistUse::Device, ..plain.clone() };
        let handling = Handling { options: &own, ..handling };
        assert_eq!(handling.tilt_deg(&state()), (20.0, -10.0));
        assert_eq!(handling.measured_twist(&state()), Some(70.0));
        let own =
            BrushOptions { tilt: TiltUse::Fixed(60.0), twist: TwistUse::Stroke, ..plain.clone() };
        let handling = Handling { options: &own, ..handling };
        let (x, y) = handling.tilt_deg(&state());
        let lean = x.to_radians().tan().hypot(y.to_radians().tan()).atan().to_degrees();
        assert!((lean - 60.0).abs() < 1e-9 && handling.follows(), "{lean}");
    }
}
