//! Playing a recording.

use web_time::{Duration, Instant};

use paint::session::{PaintingSession, SessionError};
use paint::strokes::{Action, SampleDecimals, Stroke, StrokeScript};

use super::command::Pace;
use super::event::Event;
use super::stroke_timing::{StrokeTiming, waiting_substeps};

/// Maximum number of samples added in one step of a fast replay. A cancelled replay still paints
/// the samples that were added, so this keeps the delay short.
const AHEAD: usize = 64;

/// Minimum time between two reports of progress.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(100);

/// A script and the position in it.
#[derive(Debug)]
pub(super) struct Replay {
    script: StrokeScript,
    pace: Pace,
    /// Index of the next action, or of the open stroke.
    pub(super) next: usize,
    /// Number of samples of the open stroke that were added.
    added: usize,
    /// Time at which the first sample of the open stroke was due.
    start: Instant,
    /// Number of save actions so far; a replay skips them.
    pub(super) unsaved: usize,
    /// Time of the next report of progress.
    progress_due: Instant,
}

/// Next step of a replay.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// Paint the samples of the open stroke.
    Paint,
    /// Wait until this time.
    Wait(Instant),
    /// Apply the next action.
    Next,
    /// The script has ended.
    End,
}

impl Replay {
    /// A replay from the first action.
    pub(super) fn new(script: StrokeScript, pace: Pace) -> Self {
        let now = Instant::now();
        Self { script, pace, next: 0, added: 0, start: now, unsaved: 0, progress_due: now }
    }

    /// Index and key of the current action, such as `action 3 (stroke)`.
    pub(super) fn current_action(&self) -> String {
        let kind = self.script.actions.get(self.next).map_or("end", Action::kind);
        format!("action {} ({kind})", self.next)
    }

    /// Number of actions played, such as `3 of 12 actions`.
    pub(super) fn count(&self) -> String {
        format!("{} of {} actions", self.next, self.script.actions.len())
    }

    /// Applies the next action, or begins its stroke.
    ///
    /// # Errors
    /// [`SessionError`] if the session refuses the action.
    pub(super) fn next_action(
        &mut self,
        session: &mut PaintingSession,
        open: &mut Option<StrokeTiming>,
    ) -> Result<Step, SessionError> {
        let Some(action) = self.script.actions.get(self.next) else { return Ok(Step::End) };
        match action {
            Action::Stroke(stroke) => {
                let decimals = SampleDecimals::RECORDING;
                session.begin_stroke_as(stroke.tool, stroke.on, &stroke.brush, decimals)?;
                *open = Some(StrokeTiming::default());
                (self.added, self.start) = (0, Instant::now());
                return Ok(Step::Paint);
            }
            Action::Save { .. } => self.unsaved += 1,
            action => {
                session.apply(action)?;
            }
        }
        self.next += 1;
        Ok(Step::Next)
    }

    /// Adds the samples that are due to the open stroke.
    ///
    /// # Errors
    /// [`SessionError`] for an impossible sample.
    pub(super) fn add_samples(
        &mut self,
        session: &mut PaintingSession,
        timing: &mut StrokeTiming,
    ) -> Result<Step, SessionError> {
        let Some(Action::Stroke(Stroke { samples, .. })) = self.script.actions.get(self.next)
        else {
            return Ok(Step::End);
        };
        let now = Instant::now();
        let first = samples.first().map_or(0.0, |sample| sample.seconds);
        let added = self.added;
        while let Some(sample) = samples.get(self.added) {
            let arrived = match self.pace {
                Pace::Fast if waiting_substeps(session) > 0 || self.added - added == AHEAD => break,
                Pace::Fast => now,
                Pace::AsPainted => {
                    let due = self.start + Duration::from_secs_f64(sample.seconds - first);
                    if due > now {
                        if waiting_substeps(session) == 0 && self.added == added {
                            return Ok(Step::Wait(due));
                        }
                        break;
                    }
                    due
                }
            };
            timing.extend(session, sample, arrived)?;
            self.added += 1;
        }
        if self.added == samples.len() {
            session.lift()?;
        }
        Ok(Step::Paint)
    }

    /// The progress, if it is due for a report.
    pub(super) fn progress(&mut self, now: Instant) -> Option<Event> {
        if now < self.progress_due {
            return None;
        }
        self.progress_due = now + PROGRESS_INTERVAL;
        Some(self.progress_now())
    }

    pub(super) fn progress_now(&self) -> Event {
        Event::Progress { done: self.next, of: self.script.actions.len() }
    }
}
