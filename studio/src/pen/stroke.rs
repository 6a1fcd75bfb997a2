//! A stroke as it grows: from holds to samples.

use std::time::{Duration, Instant};

use eframe::egui::Pos2;
use render::paint::pose::Sample;
use render::paint::strokes::SurfaceId;

use super::report::{Device, Hold};
use super::settings::PenSettings;
use super::sight::Sight;
use super::speed::SpeedPressure;
use session::PenSample;

/// A pen that tells nothing for so long is still; the path through the samples
/// lags one behind, and the still sample lets it catch up.
pub(super) const STILL: Duration = Duration::from_millis(30);

/// A change of pressure that a still brush tells.
const CHANGED: f64 = 0.005;

/// Seconds between the samples of lifting.
const LIFTING: f64 = 0.008;

/// How fast a straight line is drawn, in mm a second, and over how many mm it
/// lands.
const LINE_SPEED: f64 = 100.0;
const LINE_LANDING: f64 = 2.0;

/// What a brush turns its broad side across within, in points of way.
const TURNING: f64 = 30.0;

/// A stroke that is open.
#[derive(Debug)]
pub(super) struct Stroke {
    pub(super) device: Device,
    sight: Sight,
    began: Instant,
    /// Seconds that a straight line at its begin took.
    line: f64,
    hand: SpeedPressure,
    hold: Hold,
    moved: Instant,
    /// Whether the last sample was told because nothing came.
    still: bool,
    twist: f64,
    last: Option<Sample>,
    told: Vec<PenSample>,
}

impl Stroke {
    /// Sets down; with `from`, in mm, at that place, going straight to where the
    /// pen is.
    pub(super) fn new(
        device: Device,
        hold: Hold,
        at: Instant,
        sight: Sight,
        from: Option<(f64, f64)>,
        settings: &PenSettings,
    ) -> Self {
        let mut stroke = Self {
            device,
            sight,
            began: at,
            line: 0.0,
            hand: SpeedPressure::new(hold.at, 0.0),
            hold,
            moved: at,
            still: false,
            twist: settings.grip.twist_deg,
            last: None,
            told: Vec::new(),
        };
        if let Some(from) = from {
            stroke.straight(from, at, settings);
        }
        stroke.lead(hold, at, settings);
        stroke
    }

    /// On which surface.
    pub(super) fn surface(&self) -> SurfaceId {
        self.sight.surface
    }

    /// How it is held now.
    pub(super) fn hold(&self) -> Hold {
        self.hold
    }

    /// Where it is now, in mm.
    pub(super) fn place(&self) -> (f64, f64) {
        self.sight.place(self.hold.at)
    }

    /// The view moved.
    pub(super) fn see(&mut self, sight: Sight) {
        self.sight = sight;
    }

    /// Leads the brush on.
    pub(super) fn lead(&mut self, hold: Hold, at: Instant, settings: &PenSettings) {
        if settings.follow {
            self.follow(hold.at);
        }
        let seconds = self.seconds(at);
        let by_speed = self.hand.lead(hold.at, seconds);
        let pressure = hold.pressure.map_or(by_speed, |pressure| settings.pressed(pressure));
        self.hold = hold;
        self.moved = at;
        self.still = false;
        self.tell(pressure, seconds, at, settings);
    }

    /// Tells a still sample if nothing came for a while: one, and more only while
    /// the pressure changes.
    pub(super) fn rest(&mut self, now: Instant, settings: &PenSettings) {
        if now.saturating_duration_since(self.moved) < STILL {
            return;
        }
        let seconds = self.seconds(now);
        let pressure = self.pressure(seconds, settings);
        let last = self.last.map_or(0.0, |last| last.pressure);
        if !self.still || (pressure - last).abs() > CHANGED {
            self.still = true;
            self.tell(pressure, seconds, now, settings);
        }
    }

    /// How long until [`Self::rest`] has something to tell.
    pub(super) fn rests_in(&self, now: Instant) -> Option<Duration> {
        let landing = self.hold.pressure.is_none()
            && self.hand.pressure(f64::INFINITY) - self.hand.pressure(self.seconds(now)) > CHANGED;
        match (self.still, landing) {
            (false, _) => Some(STILL.saturating_sub(now.saturating_duration_since(self.moved))),
            (true, true) => Some(Duration::from_millis(10)),
            (true, false) => None,
        }
    }

    /// Lifts the brush.
    pub(super) fn lift(&mut self, at: Instant, settings: &PenSettings) {
        if self.hold.pressure.is_some() {
            return;
        }
        let mut seconds = self.seconds(at);
        for pressure in self.hand.lift(seconds) {
            seconds += LIFTING;
            self.tell(pressure, seconds, at, settings);
        }
    }

    /// The samples since the last call.
    pub(super) fn take(&mut self) -> Vec<PenSample> {
        std::mem::take(&mut self.told)
    }

    /// Draws a line to where the pen is, as a hand that has landed.
    fn straight(&mut self, from: (f64, f64), at: Instant, settings: &PenSettings) {
        let to = self.place();
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        if length < LINE_LANDING {
            return;
        }
        self.hand = SpeedPressure::new(self.hold.at, length / LINE_SPEED).landed();
        let moderate = self.hand.pressure(0.0);
        let full = self.hold.pressure.map_or(moderate, |told| settings.pressed(told).max(moderate));
        for (mm, pressure) in [(0.0, 0.2 * full), (LINE_LANDING, full)] {
            let share = mm / length;
            let place = (from.0 + (to.0 - from.0) * share, from.1 + (to.1 - from.1) * share);
            let sample = held(&self.sight, &self.hold, self.twist, settings);
            let sample = Sample { pressure, seconds: mm / LINE_SPEED, ..sample };
            self.push(Sample { x_mm: place.0, y_mm: place.1, ..sample }, at);
        }
        self.line = length / LINE_SPEED;
        if let Some(told) = &mut self.hold.pressure {
            *told = full;
        }
    }

    fn seconds(&self, at: Instant) -> f64 {
        at.saturating_duration_since(self.began).as_secs_f64() + self.line
    }

    fn pressure(&self, seconds: f64, settings: &PenSettings) -> f64 {
        let by_speed = || self.hand.pressure(seconds);
        self.hold.pressure.map_or_else(by_speed, |told| settings.pressed(told))
    }

    fn tell(&mut self, pressure: f64, seconds: f64, at: Instant, settings: &PenSettings) {
        let sample = held(&self.sight, &self.hold, self.twist, settings);
        self.push(Sample { pressure, seconds, ..sample }, at);
    }

    /// To the digits that a recording needs, within range, never back in time.
    fn push(&mut self, sample: Sample, arrived: Instant) {
        let earliest = self.last.map_or(0.0, |last| last.seconds);
        let sample = Sample {
            seconds: digits(sample.seconds, 1e4).max(earliest),
            pressure: digits(sample.pressure, 1e4),
            ..rounded(&sample)
        };
        self.last = Some(sample);
        self.told.push(PenSample { sample, arrived });
    }

    /// Turns the broad side across the way, slowly.
    fn follow(&mut self, to: Pos2) {
        let step = to - self.hold.at;
        let length = f64::from(step.length());
        if length == 0.0 {
            return;
        }
        let across = f64::from(step.y).atan2(f64::from(step.x)).to_degrees() + 90.0;
        // Either end of the broad side will do.
        let off = (across - self.twist + 90.0).rem_euclid(180.0) - 90.0;
        self.twist += off * (1.0 - (-length / TURNING).exp());
    }
}

/// How a brush is held just above a surface; `twist` is as the grip turned it.
pub(super) fn held(sight: &Sight, hold: &Hold, twist: f64, settings: &PenSettings) -> Sample {
    let (x_mm, y_mm) = sight.place(hold.at);
    let tilt = hold.tilt_deg.filter(|_| settings.pen_tilt);
    let tilt = sight.tilt(tilt.unwrap_or_else(|| settings.grip.tilt_deg()));
    let twist = hold.twist_deg.filter(|_| settings.pen_tilt).unwrap_or(twist);
    let twist_deg = sight.twist(twist);
    let (tilt_x_deg, tilt_y_deg) = tilt;
    let sample =
        Sample { seconds: 0.0, x_mm, y_mm, pressure: 0.0, tilt_x_deg, tilt_y_deg, twist_deg };
    rounded(&sample)
}

/// Places to a thousandth of a mm, angles to a hundredth of a degree.
fn rounded(sample: &Sample) -> Sample {
    Sample {
        x_mm: digits(sample.x_mm, 1e3),
        y_mm: digits(sample.y_mm, 1e3),
        tilt_x_deg: digits(sample.tilt_x_deg.clamp(-90.0, 90.0), 1e2),
        tilt_y_deg: digits(sample.tilt_y_deg.clamp(-90.0, 90.0), 1e2),
        twist_deg: digits(sample.twist_deg, 1e2),
        ..*sample
    }
}

fn digits(number: f64, scale: f64) -> f64 {
    // Not -0, which a recording would tell.
    (number * scale).round() / scale + 0.0
}
