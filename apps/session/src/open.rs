//! Opens paintings, plays recordings, and recovers the painting when the graphics device is lost.

use documents::hint::{Explain, Hint};
use paint::painting::PaintingError;
use paint::strokes::StrokeScript;
use pigment::library::PigmentLibrary;
use web_time::Instant;

use super::command::{Origin, Pace};
use super::event::{Event, Snapshot};
use super::miniature::Shots;
use super::prepare::{OpenError, PreparedPainting, prepare, prepare_script};
use super::replay::{Groups, Replay, Step};
use super::report::Reporter;
use super::worker::{OpenPainting, WorkerLoop};

/// Advice after a recording that was played to its end.
const GO_ON: &str = "paint on, or save the painting";

/// Advice after a recording that was not played to its end.
const STAYS: &str = "what was played stays, open the recording again to play it from its start";

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Played,
    Stopped,
    Refused,
}

impl WorkerLoop<'_> {
    /// Opens a painting and closes the open one. If this fails, it reports the error and the open
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

    /// Opens the painting that a script describes and starts to play the script.
    pub(super) fn replay(&mut self, script: StrokeScript, library: &PigmentLibrary, pace: Pace) {
        // We check this before we replace the open painting. If the script continues a painting,
        // its pigments are known only once that painting is open.
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
    pub(super) fn play(&mut self) -> Result<(), PaintingError> {
        let (Some(playing), Some(open)) = (&mut self.playing, &mut self.open) else {
            return Ok(());
        };
        let session = &mut open.prepared.session;
        let step = if session.open_stroke().is_some() {
            playing.add_samples(session, &mut self.outbox)
        } else {
            self.outbox.begin_stroke();
            playing.next_action(session)
        };
        self.pause = None;
        match step {
            Ok(Step::Paint) => {
                self.paint_slice()?;
                if self.stroke().is_none()
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
    fn end_replay(&mut self, ending: Ending) -> Result<(), PaintingError> {
        self.pause = None;
        let Some(playing) = self.playing.take() else { return Ok(()) };
        // Some samples of the open stroke were added already: paint them.
        self.lift()?;
        (self.send)(playing.progress_now());
        let unwritten = match playing.skipped_saves {
            0 => String::new(),
            1 => "; 1 file that it saves was not written".to_owned(),
            files => format!("; {files} files that it saves were not written"),
        };
        let count = playing.count();
        let remark = match ending {
            Ending::Played => Some((format!("the recording was played, {count}"), GO_ON)),
            Ending::Stopped => Some((format!("the recording was stopped after {count}"), STAYS)),
            // The user has seen the reason already.
            Ending::Refused => None,
        };
        if let Some((text, hint)) = remark {
            self.send_message(format!("{text}{unwritten}"), Some(Hint::new(hint)), false);
        }
        self.state_stale = true;
        (self.send)(Event::Replayed);
        Ok(())
    }

    /// Stores `snapshot` for [`Self::recover`] if the paint is on a graphics device.
    pub(super) fn keep(&mut self, snapshot: &Snapshot) {
        if self.backend.is_device() {
            self.kept = Some(snapshot.clone());
        }
    }

    /// Opens the last snapshot on the processor after the device was lost. Without a snapshot the
    /// painting is gone, and this reports it.
    pub(super) fn recover(&mut self) {
        (self.open, self.playing, self.pause) = (None, None, None);
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

#[cfg(test)]
mod tests {
    use super::super::backend::Backend;
    use super::super::prepare::blank_canvas;
    use super::super::worker::Inbox;
    use super::*;
    use graphics::gpu::{BackendChoice, DeviceError};
    use paint::strokes::{Action, Squeeze, SurfaceId};
    use pigment::library::PigmentLibrary;
    use std::cell::RefCell;
    use std::sync::Arc;
    use std::sync::mpsc::channel;

    /// Paints and loses the device. Returns the snapshot if the painting was recovered, and the
    /// events since. Pass `saved` if a snapshot was sent before.
    fn lost(saved: bool) -> (Option<Snapshot>, Vec<Event>) {
        let events = RefCell::new(Vec::new());
        let (_sender, receiver) = channel();
        let backend = Backend::new(BackendChoice::Cpu);
        let mut worker = WorkerLoop::new(Inbox::new(receiver), backend, 1 << 24, |event| {
            events.borrow_mut().push(event);
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
        // Set by hand, because a worker without a graphics device stores no snapshot.
        worker.kept = saved.then(|| snapshot.clone());
        events.borrow_mut().clear();
        let gone = DeviceError::Lost("it was pulled out".to_owned());
        worker.report_failure(&PaintingError::Engine(gone));
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
        fn message(event: &Event) -> (String, bool) {
            match event {
                Event::Message { text, failed, .. } => (text.clone(), *failed),
                other => panic!("no message: {other:?}"),
            }
        }
        assert!(
            message(first).0.contains("pulled out") && message(first).1,
            "the loss is reported"
        );
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
}
