//! The plan of a timelapse, and the frames that playing its script gives.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use graphics::export::{Frame, reduced, reduced_size, srgb8};

use super::error::TimelapseError;
use super::moments::{Moment, moments};
use super::settings::{MOST_FRAMES, TimelapseSettings};
use crate::session::{PaintingSession, SessionError};
use crate::strokes::{Action, ScriptError, Stroke, StrokeScript};

/// A script and the moments of its timelapse.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use paint::timelapse::{Interval, Timelapse, TimelapseSettings};
/// use paint::{Canvas, PaintingSession};
/// use pigment::PigmentLibrary;
///
/// let oils = PigmentLibrary::van_gogh_oils();
/// let canvas = Canvas { width_mm: 20.0, height_mm: 10.0, cell_mm: 0.5, ..Canvas::default() };
/// let script = PaintingSession::on_canvas(&oils, &canvas)?.recording().unwrap().clone();
/// let settings = TimelapseSettings { interval: Interval::Actions(1), ..Default::default() };
/// let timelapse = Timelapse::new(&script, settings)?;
/// let mut session = PaintingSession::on_canvas(&oils, &canvas)?;
/// let mut frames = Vec::new();
/// timelapse.play(&mut session, &[0], |_| ControlFlow::Continue(()), |_, frame| {
///     frames.push(frame);
///     Ok(())
/// })?;
/// assert_eq!((frames[0].width(), frames[0].height()), (40, 20));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Timelapse<'a> {
    pub(super) script: &'a StrokeScript,
    pub(super) settings: TimelapseSettings,
    moments: Vec<Moment>,
}

impl<'a> Timelapse<'a> {
    /// Plans the timelapse of `script`.
    ///
    /// # Errors
    /// [`TimelapseError`] for settings out of range, and for too many frames.
    pub fn new(
        script: &'a StrokeScript,
        settings: TimelapseSettings,
    ) -> Result<Self, TimelapseError> {
        settings.check()?;
        let moments = moments(&script.actions, &settings);
        match moments.len() {
            0..=MOST_FRAMES => Ok(Self { script, settings, moments }),
            found => Err(TimelapseError::Frames { most: MOST_FRAMES, found }),
        }
    }

    /// Number of frames, 1 and up.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.moments.len()
    }

    /// Width and height of a frame of the canvas of `session`, in pixels.
    #[must_use]
    pub fn size(&self, session: &PaintingSession) -> (usize, usize) {
        let bounds = session.canvas().bounds();
        reduced_size((bounds.width, bounds.height), self.settings.longest_px)
    }

    /// Plays the script on `session`, which must be as the script begins (see
    /// [`StrokeScript::surfaces`]), up to the last of the frames `wanted` (indices from 0,
    /// rising), and calls `put` with each of them. Files that the script saves are not written.
    /// Before each action `step` is called with the share of the script that is played, 0 to 1, and
    /// can end the play.
    ///
    /// # Errors
    /// [`TimelapseError`] if the script is invalid or the session refuses an action, and the
    /// errors of `put`.
    pub fn play(
        &self,
        session: &mut PaintingSession,
        wanted: &[usize],
        mut step: impl FnMut(f64) -> ControlFlow<()>,
        put: impl FnMut(usize, Frame) -> Result<(), TimelapseError>,
    ) -> Result<ControlFlow<()>, TimelapseError> {
        self.script.resolve(session.canvas().library())?;
        session.add_names_of(&self.script.palette).map_err(ScriptError::from)?;
        let mut taking = Taking { timelapse: self, wanted, put };
        let mut used = BTreeSet::new();
        let weights: Vec<usize> = self.script.actions.iter().map(weight).collect();
        let mut done = 0;
        let all = weights.iter().sum::<usize>().max(1);
        for (index, action) in self.script.actions.iter().enumerate() {
            taking.take_until(session, Moment { action: index, samples: 0 })?;
            if taking.wanted.is_empty() {
                break;
            }
            if step(done as f64 / all as f64).is_break() {
                return Ok(ControlFlow::Break(()));
            }
            // Brushes are added when they are first used.
            let brush = action.brush().filter(|name| used.insert(*name));
            let added = brush.map(|name| session.set_brush(name, &self.script.brushes[name]));
            let failed = |error| {
                let error = Box::new(error);
                TimelapseError::Action { index, kind: action.kind(), error }
            };
            added.unwrap_or(Ok(())).map_err(failed)?;
            match action {
                Action::Save { .. } => {}
                Action::Stroke(stroke) => taking.paint(session, index, stroke)?,
                action => {
                    session.apply(action).map_err(failed)?;
                }
            }
            done += weights[index];
        }
        taking.take_until(session, Moment { action: self.script.actions.len(), samples: 0 })?;
        Ok(ControlFlow::Continue(()))
    }
}

/// Share of the work of playing an action.
fn weight(action: &Action) -> usize {
    action.stroke().map_or(1, |stroke| stroke.samples.len())
}

/// The frames that are still to be taken.
struct Taking<'a, P> {
    timelapse: &'a Timelapse<'a>,
    /// Indices of these frames, rising.
    wanted: &'a [usize],
    put: P,
}

impl<P: FnMut(usize, Frame) -> Result<(), TimelapseError>> Taking<'_, P> {
    fn next(&self) -> Option<Moment> {
        self.wanted.first().map(|&frame| self.timelapse.moments[frame])
    }

    /// Takes all frames up to `now`, the present moment of `session`.
    fn take_until(
        &mut self,
        session: &mut PaintingSession,
        now: Moment,
    ) -> Result<(), TimelapseError> {
        if self.next().is_none_or(|moment| moment > now) {
            return Ok(());
        }
        let picture = session.canvas_mut().picture()?;
        let frame = srgb8(&reduced(&picture, self.timelapse.settings.longest_px))?;
        while let Some((&index, rest)) = self.wanted.split_first()
            && self.timelapse.moments[index] <= now
        {
            (self.put)(index, frame.clone())?;
            self.wanted = rest;
        }
        Ok(())
    }

    /// Paints the stroke that is action `index`, and takes the frames within it. Painted in pieces
    /// it equals the whole stroke to the bit.
    fn paint(
        &mut self,
        session: &mut PaintingSession,
        index: usize,
        stroke: &Stroke,
    ) -> Result<(), TimelapseError> {
        let failed = |error: SessionError| {
            let error = Box::new(error);
            TimelapseError::Action { index, kind: "stroke", error }
        };
        session.begin_stroke(stroke.on, &stroke.brush).map_err(failed)?;
        let mut added = 0;
        while let Some(Moment { samples, .. }) = self.next().filter(|next| next.action == index) {
            let samples = samples.min(stroke.samples.len());
            session.extend(&stroke.samples[added..samples]).map_err(failed)?;
            added = samples;
            while session.advance(usize::MAX).map_err(failed)? > 0 {}
            self.take_until(session, Moment { action: index, samples })?;
        }
        session.extend(&stroke.samples[added..]).map_err(failed)?;
        session.end_stroke().map_err(failed)?;
        Ok(())
    }
}
