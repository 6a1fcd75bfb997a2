//! A recording that is being played.

use std::time::{Duration, Instant};

use render::paint::session::{PaintingSession, SessionError};
use render::paint::strokes::{Action, Stroke, StrokeScript};

use super::command::Pace;
use super::event::Event;
use super::stroke::LiveStroke;

/// Samples that a stroke is told ahead of its paint, so that it can end soon
/// after a cancel.
const AHEAD: usize = 64;

/// The least time between two tellings of progress.
const PROGRESS: Duration = Duration::from_millis(100);

/// A script and how far it is.
#[derive(Debug)]
pub(super) struct Replay {
    script: StrokeScript,
    pace: Pace,
    /// The action that comes next, or whose stroke is open.
    pub(super) next: usize,
    /// Samples of that stroke that were told.
    fed: usize,
    /// When its first sample was due.
    began: Instant,
    /// Actions that save, which were passed over.
    pub(super) unsaved: usize,
    progress: Instant,
}

/// What there is to do next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// To paint what the open stroke was told.
    Paint,
    /// Nothing before then.
    Wait(Instant),
    /// Another action.
    Go,
    /// All is played.
    Over,
}

impl Replay {
    /// From the first action.
    pub(super) fn new(script: StrokeScript, pace: Pace) -> Self {
        let now = Instant::now();
        Self { script, pace, next: 0, fed: 0, began: now, unsaved: 0, progress: now }
    }

    /// Which action is played, in words: `action 3 (stroke)`.
    pub(super) fn place(&self) -> String {
        let kind = self.script.actions.get(self.next).map_or("end", Action::kind);
        format!("action {} ({kind})", self.next)
    }

    /// The next action that is no stroke is done; a stroke begins.
    ///
    /// # Errors
    /// [`SessionError`] for what the session refuses.
    pub(super) fn go(
        &mut self,
        session: &mut PaintingSession,
        live: &mut Option<LiveStroke>,
    ) -> Result<Step, SessionError> {
        let Some(action) = self.script.actions.get(self.next) else { return Ok(Step::Over) };
        match action {
            Action::Stroke(stroke) => {
                *live = Some(LiveStroke::begin(session, stroke.on, &stroke.brush)?);
                (self.fed, self.began) = (0, Instant::now());
                return Ok(Step::Paint);
            }
            Action::Save { .. } => self.unsaved += 1,
            action => {
                session.apply(action)?;
            }
        }
        self.next += 1;
        Ok(Step::Go)
    }

    /// Tells the open stroke the samples whose time has come.
    ///
    /// # Errors
    /// [`SessionError`] for an impossible sample.
    pub(super) fn feed(
        &mut self,
        session: &mut PaintingSession,
        live: &mut LiveStroke,
    ) -> Result<Step, SessionError> {
        let Some(Action::Stroke(Stroke { samples, .. })) = self.script.actions.get(self.next)
        else {
            return Ok(Step::Over);
        };
        let now = Instant::now();
        let first = samples.first().map_or(0.0, |sample| sample.seconds);
        let fed = self.fed;
        while let Some(sample) = samples.get(self.fed) {
            let arrived = match self.pace {
                Pace::Fast if live.waiting > 0 || self.fed - fed == AHEAD => break,
                Pace::Fast => now,
                Pace::AsPainted => {
                    let due = self.began + Duration::from_secs_f64(sample.seconds - first);
                    if due > now {
                        if live.waiting == 0 && self.fed == fed {
                            return Ok(Step::Wait(due));
                        }
                        break;
                    }
                    due
                }
            };
            live.extend(session, sample, arrived)?;
            self.fed += 1;
        }
        if self.fed == samples.len() {
            live.lift(session)?;
        }
        Ok(Step::Paint)
    }

    /// How far it is, if that is worth telling again.
    pub(super) fn progress(&mut self, now: Instant) -> Option<Event> {
        if now < self.progress {
            return None;
        }
        self.progress = now + PROGRESS;
        Some(self.progress_now())
    }

    pub(super) fn progress_now(&self) -> Event {
        Event::Progress { done: self.next, of: self.script.actions.len() }
    }
}
