//! Opening paintings, playing recordings, and recovering after a lost device.
//!
//! Playing a recording.
//!
//! Actions of the history that are undone and repeated together, such as a stroke and its mirrored
//! twins.
//!
//! States of the painting are known by the numbers of
//! [`PaintingSession::history_numbers`](paint::session::PaintingSession::history_numbers):
//! rising, and never given twice.

use documents::hint::{Explain, Hint};
use paint::session::{PaintingSession, SessionError};
use paint::strokes::{Action, SampleDecimals, Stroke, StrokeScript};
use pigment::library::PigmentLibrary;
use web_time::{Duration, Instant};

use super::command::{Origin, Pace};
use super::event::{Event, Snapshot};
use super::miniature::Shots;
use super::outbox::{StrokeTiming, waiting_substeps};
use super::prepare::{OpenError, PreparedPainting, prepare, prepare_script};
use super::report::Reporter;
use super::worker::{OpenPainting, WorkerLoop};

/// Advice after a recording that was played to its end.
const GO_ON: &str = "paint on, or save the painting";

/// Advice after a recording that was not played to its end.
const STAYS: &str = "what was played stays, open the recording again to play it from its start";

/// How a replay ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    /// All actions were played.
    Played,
    /// The painter stopped it.
    Stopped,
    /// An action was refused.
    Refused,
}

impl WorkerLoop<'_> {
    /// Opens a painting in place of the open one. If that fails, the error is reported and the open
    /// painting stays.
    pub(super) fn open(&mut self, origin: Origin) {
        let prepared = prepare(origin, &mut self.backend, self.undo_bytes);
        self.replace_painting(prepared);
    }

    /// Replaces the open painting by a prepared one, or reports why it could not be prepared.
    /// Returns whether it was replaced.
    fn replace_painting(&mut self, prepared: Result<PreparedPainting, OpenError>) -> bool {
        let mut prepared = match prepared {
            Ok(prepared) => prepared,
            Err(error) => {
                self.send_message(error.to_string(), error.hint(), true);
                return false;
            }
        };
        for remark in std::mem::take(&mut prepared.remarks) {
            self.send_message(remark, None, false);
        }
        let reporter = Reporter::new(&prepared);
        let shots = Shots::default();
        let groups = Groups::default();
        let recording_stop_reported = false;
        self.open =
            Some(OpenPainting { prepared, reporter, shots, groups, recording_stop_reported });
        self.shot_revision = None;
        self.stroke = None;
        self.kept = None;
        self.revision += 1;
        self.outbox.clear();
        (self.picture_stale, self.state_stale) = (true, false);
        match self.state() {
            Ok(Some(state)) => (self.send)(Event::Opened(state)),
            Ok(None) => {}
            Err(error) => self.report_failure(&error),
        }
        true
    }

    /// Starts to play a script on the painting that it describes.
    pub(super) fn replay(&mut self, script: StrokeScript, library: &PigmentLibrary, pace: Pace) {
        // Checked before the open painting is replaced. The pigments of a script that
        // continues a painting are known only with that painting.
        if script.start.is_none()
            && let Err(error) = script.resolve(library)
        {
            return self.send_message(error.to_string(), error.hint(), true);
        }
        let prepared = prepare_script(&script, library, &mut self.backend, self.undo_bytes);
        if self.replace_painting(prepared) {
            self.playing = Some(Replay::new(script, pace));
        }
    }

    /// Takes the next step of the replay: adds samples and paints a slice, applies an action,
    /// waits, or ends the replay.
    pub(super) fn play(&mut self) -> Result<(), SessionError> {
        let (Some(playing), Some(open)) = (&mut self.playing, &mut self.open) else {
            return Ok(());
        };
        let session = &mut open.prepared.session;
        let step = match &mut self.stroke {
            Some(stroke) => playing.add_samples(session, stroke),
            None => playing.next_action(session, &mut self.stroke),
        };
        self.pause = None;
        match step {
            Ok(Step::Paint) => {
                self.paint_slice()?;
                if self.stroke.is_none()
                    && let Some(playing) = &mut self.playing
                {
                    playing.next += 1;
                }
            }
            Ok(Step::Wait(then)) => self.pause = Some(then),
            Ok(Step::Next) => self.all_changed(),
            Ok(Step::End) => return self.end_replay(Ending::Played),
            Err(error) => {
                let hint = error.hint().unwrap_or_else(|| Hint::new(STAYS));
                let text = format!(
                    "the recording cannot go on after {}, at {}: {error}",
                    playing.count(),
                    playing.current_action()
                );
                self.send_message(text, Some(hint), true);
                return self.end_replay(Ending::Refused);
            }
        }
        if let Some(event) = self.playing.as_mut().and_then(|p| p.progress(Instant::now())) {
            (self.send)(event);
        }
        Ok(())
    }

    /// Ends a replay early. What was played so far stays in the painting.
    pub(super) fn cancel(&mut self) {
        if self.playing.is_some()
            && let Err(error) = self.end_replay(Ending::Stopped)
        {
            self.report_failure(&error);
        }
    }

    /// Ends the replay, and says how far it came and what to do.
    fn end_replay(&mut self, ending: Ending) -> Result<(), SessionError> {
        self.pause = None;
        let Some(playing) = self.playing.take() else { return Ok(()) };
        // The samples of the open stroke that were already added are still painted.
        self.lift()?;
        (self.send)(playing.progress_now());
        let unwritten = match playing.unsaved {
            0 => String::new(),
            1 => "; 1 file that it saves was not written".to_owned(),
            files => format!("; {files} files that it saves were not written"),
        };
        let count = playing.count();
        let told = match ending {
            Ending::Played => Some((format!("the recording was played, {count}"), GO_ON)),
            Ending::Stopped => Some((format!("the recording was stopped after {count}"), STAYS)),
            // The reason was told.
            Ending::Refused => None,
        };
        if let Some((text, hint)) = told {
            self.send_message(format!("{text}{unwritten}"), Some(Hint::new(hint)), false);
        }
        self.state_stale = true;
        (self.send)(Event::Replayed);
        Ok(())
    }

    /// Keeps `snapshot` for [`Self::recover`] if the paint is on a graphics device.
    pub(super) fn keep(&mut self, snapshot: &Snapshot) {
        if self.backend.is_device() {
            self.kept = Some(snapshot.clone());
        }
    }

    /// Opens the last snapshot on the processor after the device was lost. Without a snapshot, the
    /// painting is lost, which is reported.
    pub(super) fn recover(&mut self) {
        (self.open, self.stroke, self.playing, self.pause) = (None, None, None, None);
        self.backend.fall_back();
        let Some(Snapshot { canvas, palette, .. }) = self.kept.take() else {
            let hint = "open the painting again; what was saved by itself can be recovered";
            let text = "the painting was on the device, and is lost".to_owned();
            return self.send_message(text, Some(Hint::new(hint)), true);
        };
        let session = Origin::Recovered {
            canvas: Box::new((*canvas).clone()),
            palette: Box::new((*palette).clone()),
            kept: None,
        };
        self.open(session);
        let text = "the painting was taken up on the processor as it was last saved".to_owned();
        self.send_message(text, None, false);
    }
}

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

/// Groups of actions of the history.
#[derive(Debug, Default)]
pub(super) struct Groups {
    /// Number of the state before the group that is being made.
    open: Option<u64>,
    /// Numbers of the states before and after each group.
    whole: Vec<(u64, u64)>,
}

impl Groups {
    /// Begins a group with the next action. `numbers` are those of all states that can be reached,
    /// and `done` is the index of the present one.
    pub(super) fn begin(&mut self, numbers: &[u64], done: usize) {
        self.open = numbers.get(done).copied();
    }

    /// Ends the group that is being made. It counts if it has two actions or more.
    pub(super) fn end(&mut self, numbers: &[u64], done: usize) {
        let (Some(before), Some(&now)) = (self.open.take(), numbers.get(done)) else { return };
        self.whole.retain(|(_, after)| numbers.contains(after));
        if numbers.iter().filter(|&&number| (before + 1..=now).contains(&number)).count() > 1 {
            self.whole.push((before, now));
        }
    }

    /// Gives up the group that is being made: another action came between its own.
    pub(super) fn give_up(&mut self) {
        self.open = None;
    }

    /// Index of the state to which one undo leads, if the last action belongs to a group.
    pub(super) fn undo_to(&self, numbers: &[u64], done: usize) -> Option<usize> {
        let now = *numbers.get(done)?;
        let (before, _) =
            self.whole.iter().find(|(before, after)| (before + 1..=*after).contains(&now))?;
        // The state before the group may be forgotten: then the first one that is known.
        Some(numbers.partition_point(|number| number < before))
    }

    /// Index of the state to which one redo leads, if the next action belongs to a group.
    pub(super) fn redo_to(&self, numbers: &[u64], done: usize) -> Option<usize> {
        let now = *numbers.get(done)?;
        let (_, after) =
            self.whole.iter().find(|(before, after)| (*before..*after).contains(&now))?;
        numbers.iter().position(|number| number == after)
    }
}

#[cfg(test)]
mod tests {
    use super::super::backend::Backend;
    use super::super::inbox::Inbox;
    use super::super::prepare::blank_canvas;
    use super::*;
    use graphics::gpu::{BackendChoice, DeviceError};
    use paint::painting::PaintingError;
    use paint::strokes::{Action, Squeeze, SurfaceId};
    use pigment::library::PigmentLibrary;
    use std::cell::RefCell;
    use std::sync::Arc;
    use std::sync::mpsc::channel;

    /// Paints and loses the device; returns the snapshot, if the painting was recovered, and the
    /// events since. `saved` is whether a snapshot was sent before.
    fn lost(saved: bool) -> (Option<Snapshot>, Vec<Event>) {
        let events = RefCell::new(Vec::new());
        let (_sender, receiver) = channel();
        let backend = Backend::new(BackendChoice::Cpu);
        let mut worker = WorkerLoop::new(Inbox::new(receiver), backend, 1 << 24, |event| {
            events.borrow_mut().push(event)
        });
        worker.open(blank_canvas(PigmentLibrary::van_gogh_oils(), 6.0, 5.0, 0.1));
        let heap = Action::Squeeze(Squeeze {
            on: SurfaceId::Canvas,
            recipe: [("Vermilion".to_owned(), 1.0)].into(),
            vehicle: 0.0,
            x_mm: 3.0,
            y_mm: 2.0,
            volume_mm3: 2.0,
        });
        worker.session().apply(&heap).unwrap();
        let (canvas, palette) = worker.session().documents().unwrap();
        let canvas = Arc::new(canvas);
        let palette = Arc::new(palette.unwrap());
        let brushes = Arc::new(worker.session().kept_brushes().unwrap());
        let snapshot = Snapshot { number: 1, canvas, palette, brushes, revision: 1 };
        // Set by hand, because a worker without a graphics device keeps no snapshot.
        worker.kept = saved.then(|| snapshot.clone());
        events.borrow_mut().clear();
        let gone = DeviceError::Lost { reason: "it was pulled out".to_owned() };
        worker.report_failure(&SessionError::Painting(PaintingError::Engine(gone)));
        let found = worker.open.as_mut().map(|open| open.prepared.session.documents().unwrap());
        if let Some((canvas, palette)) = found {
            assert!(canvas == *snapshot.canvas, "the canvas as it was saved");
            assert_eq!(palette.as_ref(), Some(&*snapshot.palette), "the palette as well");
            assert!(canvas.wet.totals()[3] > 0, "there is paint on it");
        }
        let kept = worker.open.is_some().then_some(snapshot);
        (kept, events.take())
    }

    #[test]
    fn a_device_that_is_lost_takes_no_more_than_what_came_since_the_last_save() {
        let (kept, events) = lost(true);
        assert!(kept.is_some(), "one can paint on");
        let [first, Event::Opened(_), last] = &events[..] else {
            panic!("three events: {events:?}")
        };
        let message = |event: &Event| match event {
            Event::Message { text, failed, .. } => (text.clone(), *failed),
            other => panic!("no message: {other:?}"),
        };
        assert!(message(first).0.contains("pulled out") && message(first).1, "the loss is told");
        assert!(message(last).0.contains("processor") && !message(last).1, "and the way on");
    }

    #[test]
    fn a_device_that_is_lost_before_any_save_is_told_of() {
        let (kept, events) = lost(false);
        assert!(kept.is_none(), "there is no painting");
        let Some(Event::Message { hint: Some(hint), failed: true, .. }) = events.last() else {
            panic!("a message with a hint: {events:?}");
        };
        assert!(hint.to_string().contains("recovered"), "{hint}");
    }

    /// States 0 to 5, of which 2 to 4 are a group.
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
        let undo = |done| groups.undo_to(&numbers, done);
        assert_eq!([undo(0), undo(1), undo(5)], [None; 3], "single actions");
        // Also from within: the history panel leads there.
        assert_eq!([undo(2), undo(3), undo(4)], [Some(1); 3]);
        let redo = |done| groups.redo_to(&numbers, done);
        assert_eq!([redo(0), redo(4), redo(5)], [None; 3]);
        assert_eq!([redo(1), redo(2), redo(3)], [Some(4); 3]);
    }

    #[test]
    fn a_group_whose_beginning_is_forgotten_is_undone_as_far_as_it_is_known() {
        let groups = grouped();
        assert_eq!(groups.undo_to(&[2, 3, 4], 2), Some(0));
        // Another action took the place of its last ones.
        assert_eq!(groups.redo_to(&[0, 1, 2, 9], 2), None);
        assert_eq!(groups.undo_to(&[0, 1, 2, 9], 3), None);
    }

    #[test]
    fn groups_of_one_action_and_those_that_were_given_up_do_not_count() {
        let mut groups = Groups::default();
        groups.begin(&[0], 0);
        groups.end(&[0, 1], 1);
        assert_eq!(groups.undo_to(&[0, 1], 1), None);
        groups.begin(&[0, 1], 1);
        groups.give_up();
        groups.end(&[0, 1, 2, 3], 3);
        assert_eq!(groups.undo_to(&[0, 1, 2, 3], 3), None);
        let mut groups = grouped();
        groups.begin(&[0, 1, 7], 2);
        groups.end(&[0, 1, 7, 8, 9], 4);
        assert_eq!(groups.whole, [(7, 9)], "one that cannot be reached any more is forgotten");
    }
}
