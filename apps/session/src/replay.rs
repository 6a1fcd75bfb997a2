//! Plays a recording, and undoes actions together.
//!
//! States of the painting have the numbers of
//! [`PaintingSession::history_numbers`](paint::session::PaintingSession::history_numbers). These
//! rise and are never used twice.

use paint::painting::PaintingError;
use paint::session::PaintingSession;
use paint::strokes::{Action, SampleDecimals, Stroke, StrokeScript};
use web_time::{Duration, Instant};

use super::command::Pace;
use super::event::Event;
use super::outbox::{Outbox, waiting_substeps};

/// Most samples that one step of a fast replay adds. If you cancel a replay, the samples that were
/// added are still painted, so this limits the delay.
const AHEAD: usize = 64;

const PROGRESS_INTERVAL: Duration = Duration::from_millis(100);

/// A script and the position in it.
#[derive(Debug)]
pub(super) struct Replay {
    script: StrokeScript,
    pace: Pace,
    /// Index of the next action, or of the open stroke.
    pub(super) next: usize,
    /// Samples of the open stroke that were added.
    added: usize,
    /// When the first sample of the open stroke was due.
    start: Instant,
    /// Number of save actions so far. A replay skips these.
    pub(super) skipped_saves: usize,
    progress_due: Instant,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    Paint,
    Wait(Instant),
    Next,
    End,
}

impl Replay {
    pub(super) fn new(script: StrokeScript, pace: Pace) -> Self {
        let now = Instant::now();
        Self { script, pace, next: 0, added: 0, start: now, skipped_saves: 0, progress_due: now }
    }

    /// Number, from 1, and key of the current action, e.g. `action 3 (stroke)`.
    pub(super) fn current_action(&self) -> String {
        let kind = self.script.actions.get(self.next).map_or("end", Action::kind);
        format!("action {} ({kind})", self.next + 1)
    }

    /// How many actions were played, e.g. `3 of 12 actions`.
    pub(super) fn count(&self) -> String {
        format!("{} of {} actions", self.next, self.script.actions.len())
    }

    /// Applies the next action, or begins its stroke.
    ///
    /// # Errors
    /// [`PaintingError`] if the session refuses the action.
    pub(super) fn next_action(
        &mut self,
        session: &mut PaintingSession,
    ) -> Result<Step, PaintingError> {
        let Some(action) = self.script.actions.get(self.next) else { return Ok(Step::End) };
        match action {
            Action::Stroke(stroke) => {
                let decimals = SampleDecimals::RECORDING;
                session.begin_stroke_as(stroke.tool, stroke.on, &stroke.brush, decimals)?;
                (self.added, self.start) = (0, Instant::now());
                return Ok(Step::Paint);
            }
            Action::Save { .. } => self.skipped_saves += 1,
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
    /// [`PaintingError`] for an impossible sample.
    pub(super) fn add_samples(
        &mut self,
        session: &mut PaintingSession,
        outbox: &mut Outbox,
    ) -> Result<Step, PaintingError> {
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
            session.extend(&[*sample])?;
            outbox.add_sample(arrived);
            self.added += 1;
        }
        if self.added == samples.len() {
            session.lift()?;
        }
        Ok(Step::Paint)
    }

    /// The progress, if it is time to report it.
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

#[derive(Debug, Default)]
pub(super) struct Groups {
    /// Number of the state before the open group.
    open: Option<u64>,
    /// Numbers of the states before and after each finished group.
    whole: Vec<(u64, u64)>,
}

impl Groups {
    /// Begins a group with the next action. `numbers` are all states that you can reach, and `done`
    /// is the index of the present one.
    pub(super) fn begin(&mut self, numbers: &[u64], done: usize) {
        self.open = numbers.get(done).copied();
    }

    /// Ends the open group. It counts if it has at least two actions.
    pub(super) fn end(&mut self, numbers: &[u64], done: usize) {
        let (Some(before), Some(&now)) = (self.open.take(), numbers.get(done)) else { return };
        self.whole.retain(|(_, after)| numbers.contains(after));
        if numbers.iter().filter(|&&number| (before + 1..=now).contains(&number)).count() > 1 {
            self.whole.push((before, now));
        }
    }

    /// Drops the open group, because another action came between its strokes.
    pub(super) fn give_up(&mut self) {
        self.open = None;
    }

    /// Index of the state that one undo leads to, if the last action belongs to a group.
    pub(super) fn undo_target(&self, numbers: &[u64], done: usize) -> Option<usize> {
        let now = *numbers.get(done)?;
        let (before, _) =
            self.whole.iter().find(|(before, after)| (before + 1..=*after).contains(&now))?;
        // The state before the group may be forgotten: then use the first one that is known.
        Some(numbers.partition_point(|number| number < before))
    }

    /// Index of the state that one redo leads to, if the next action belongs to a group.
    pub(super) fn redo_target(&self, numbers: &[u64], done: usize) -> Option<usize> {
        let now = *numbers.get(done)?;
        let (_, after) =
            self.whole.iter().find(|(before, after)| (*before..*after).contains(&now))?;
        numbers.iter().position(|number| number == after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// States 0 to 5. The actions 2 to 4 are a group.
    fn grouped() -> Groups {
        let mut groups = Groups::default();
        groups.begin(&[0, 1], 1);
        groups.end(&[0, 1, 2, 3, 4], 4);
        groups
    }

    #[test]
    fn one_undo_and_one_redo_lead_over_a_whole_group() {
        let groups = grouped();
        let numbers = [0, 1, 2, 3, 4, 5];
        for (at, undo, redo) in [
            (0, None, None),
            (1, None, Some(4)),
            // This also works from within a group, since the history panel leads there.
            (2, Some(1), Some(4)),
            (3, Some(1), Some(4)),
            (4, Some(1), None),
            (5, None, None),
        ] {
            assert_eq!(groups.undo_target(&numbers, at), undo, "undo from {at}");
            assert_eq!(groups.redo_target(&numbers, at), redo, "redo from {at}");
        }
    }

    #[test]
    fn a_group_whose_beginning_is_forgotten_is_undone_as_far_as_it_is_known() {
        let groups = grouped();
        assert_eq!(groups.undo_target(&[2, 3, 4], 2), Some(0));
        // Another action replaced the last ones.
        assert_eq!(groups.redo_target(&[0, 1, 2, 9], 2), None);
        assert_eq!(groups.undo_target(&[0, 1, 2, 9], 3), None);
    }

    #[test]
    fn groups_of_one_action_and_those_that_were_given_up_do_not_count() {
        let mut groups = Groups::default();
        groups.begin(&[0], 0);
        groups.end(&[0, 1], 1);
        assert_eq!(groups.undo_target(&[0, 1], 1), None);
        groups.begin(&[0, 1], 1);
        groups.give_up();
        groups.end(&[0, 1, 2, 3], 3);
        assert_eq!(groups.undo_target(&[0, 1, 2, 3], 3), None);
        let mut groups = grouped();
        groups.begin(&[0, 1, 7], 2);
        groups.end(&[0, 1, 7, 8, 9], 4);
        assert_eq!(groups.whole, [(7, 9)], "one that cannot be reached any more is forgotten");
    }
}
