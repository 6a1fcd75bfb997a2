//! Paintings that come: opened, played from a recording, or taken up again.

use std::time::Instant;

use pigment::library::PigmentLibrary;
use render::paint::session::SessionError;
use render::paint::strokes::StrokeScript;
use spectra::hint::{Explain, Hint};

use super::command::{Origin, Pace};
use super::event::{Event, Snapshot};
use super::prepare::{OpenError, PreparedPainting, from_script, opened};
use super::replay::{Replay, Step};
use super::report::Reporter;
use super::worker::{OpenPainting, WorkerLoop};

impl WorkerLoop<'_> {
    /// Takes up a painting in place of the one there is, which stays if that
    /// fails.
    pub(super) fn open(&mut self, origin: Origin) {
        let opened = opened(origin, &mut self.backend, self.undo_bytes);
        self.put_up(opened);
    }

    /// Puts a painting on the stage; whether there was one.
    fn put_up(&mut self, opened: Result<PreparedPainting, OpenError>) -> bool {
        let mut opened = match opened {
            Ok(opened) => opened,
            Err(error) => {
                self.say(error.to_string(), error.hint(), true);
                return false;
            }
        };
        for remark in std::mem::take(&mut opened.remarks) {
            self.say(remark, None, false);
        }
        let teller = Reporter::new(&opened);
        self.stage = Some(OpenPainting { opened, teller });
        self.live = None;
        self.kept = None;
        self.revision += 1;
        self.outbox.clear();
        (self.unseen, self.stale) = (true, false);
        match self.state() {
            Ok(Some(state)) => (self.tell)(Event::Opened(state)),
            Ok(None) => {}
            Err(error) => self.failed(&error),
        }
        true
    }

    /// Begins to play a script on the painting that it describes.
    pub(super) fn replay(&mut self, script: StrokeScript, library: &PigmentLibrary, pace: Pace) {
        // Before anything is taken away; what a painting of its own has for
        // pigments is known only with that painting.
        if script.start.is_none()
            && let Err(error) = script.resolve(library)
        {
            return self.say(error.to_string(), error.hint(), true);
        }
        let opened = from_script(&script, library, &mut self.backend, self.undo_bytes);
        if self.put_up(opened) {
            self.playing = Some(Replay::new(script, pace));
        }
    }

    /// Plays on for a moment.
    pub(super) fn play(&mut self) -> Result<(), SessionError> {
        let (Some(playing), Some(stage)) = (&mut self.playing, &mut self.stage) else {
            return Ok(());
        };
        let session = &mut stage.opened.session;
        let step = match &mut self.live {
            Some(live) => playing.feed(session, live),
            None => playing.go(session, &mut self.live),
        };
        self.pause = None;
        match step {
            Ok(Step::Paint) => {
                self.slice()?;
                if self.live.is_none()
                    && let Some(playing) = &mut self.playing
                {
                    playing.next += 1;
                }
            }
            Ok(Step::Wait(then)) => self.pause = Some(then),
            Ok(Step::Go) => self.all_changed(),
            Ok(Step::Over) => return self.end_replay(),
            Err(error) => {
                let text = format!("the recording ends at {}: {error}", playing.place());
                self.say(text, error.hint(), true);
                return self.end_replay();
            }
        }
        if let Some(event) = self.playing.as_mut().and_then(|p| p.progress(Instant::now())) {
            (self.tell)(event);
        }
        Ok(())
    }

    /// Ends a replay where it is; the painting stays as far as it came.
    pub(super) fn cancel(&mut self) {
        if self.playing.is_some()
            && let Err(error) = self.end_replay()
        {
            self.failed(&error);
        }
    }

    fn end_replay(&mut self) -> Result<(), SessionError> {
        self.pause = None;
        let Some(playing) = self.playing.take() else { return Ok(()) };
        // What its stroke was told is painted by and by, as after any pen.
        self.lift()?;
        (self.tell)(playing.progress_now());
        if playing.unsaved > 0 {
            let text =
                format!("{} files that the recording saves were not written", playing.unsaved);
            self.say(text, Some(Hint::new("save the painting yourself")), false);
        }
        self.stale = true;
        (self.tell)(Event::Replayed);
        Ok(())
    }

    /// Keeps what was last told whole, to go on with if the device is lost.
    pub(super) fn keep(&mut self, snapshot: &Snapshot) {
        if self.backend.is_device() {
            self.kept = Some(snapshot.clone());
        }
    }

    /// The device was lost, and all that was on it: goes on with what was last
    /// told whole, on the processor.
    pub(super) fn recover(&mut self) {
        (self.stage, self.live, self.playing, self.pause) = (None, None, None, None);
        self.backend.fall_back();
        let Some(Snapshot { canvas, palette, .. }) = self.kept.take() else {
            let hint = "open the painting again; what was saved by itself can be recovered";
            let text = "the painting was on the device, and is lost".to_owned();
            return self.say(text, Some(Hint::new(hint)), true);
        };
        let session = Origin::Recovered {
            canvas: Box::new((*canvas).clone()),
            palette: Box::new((*palette).clone()),
        };
        self.open(session);
        let text = "the painting was taken up on the processor as it was last saved".to_owned();
        self.say(text, None, false);
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::sync::Arc;
    use std::sync::mpsc::channel;

    use render::gpu::BackendChoice;
    use render::gpu::DeviceError;
    use render::paint::painting::PaintingError;
    use render::paint::strokes::{Action, Squeeze, SurfaceId};

    use super::super::backend::Backend;
    use pigment::library::PigmentLibrary;

    use super::super::defaults::blank_canvas;
    use super::super::inbox::Inbox;
    use super::*;

    /// Paints, loses the device, and gives what was told since; `saved` if a
    /// snapshot was told before.
    fn lost(saved: bool) -> (Option<Snapshot>, Vec<Event>) {
        let told = RefCell::new(Vec::new());
        let tell = |event| told.borrow_mut().push(event);
        let (_say, heard) = channel();
        let backend = Backend::new(BackendChoice::Cpu);
        let mut workshop = WorkerLoop::new(Inbox::new(heard), backend, 1 << 24, &tell);
        workshop.open(blank_canvas(PigmentLibrary::van_gogh_oils(), 6.0, 5.0, 0.1));
        let heap = Action::Squeeze(Squeeze {
            on: SurfaceId::Canvas,
            recipe: [("Vermilion".to_owned(), 1.0)].into(),
            vehicle: 0.0,
            x_mm: 3.0,
            y_mm: 2.0,
            volume_mm3: 2.0,
        });
        workshop.session().apply(&heap).unwrap();
        let (canvas, palette) = workshop.session().documents().unwrap();
        let (canvas, palette) = (Arc::new(canvas), Arc::new(palette.unwrap()));
        let snapshot = Snapshot { number: 1, canvas, palette, revision: 1 };
        // As on a device.
        workshop.kept = saved.then(|| snapshot.clone());
        told.borrow_mut().clear();
        let gone = DeviceError::Lost { reason: "it was pulled out".to_owned() };
        workshop.failed(&SessionError::Painting(PaintingError::Engine(gone)));
        let found = workshop.stage.as_mut().map(|stage| stage.opened.session.documents().unwrap());
        if let Some((canvas, palette)) = found {
            assert!(canvas == *snapshot.canvas, "the canvas as it was saved");
            assert_eq!(palette.as_ref(), Some(&*snapshot.palette), "the palette as well");
            assert!(canvas.wet.totals()[3] > 0, "there is paint on it");
        }
        let kept = workshop.stage.is_some().then_some(snapshot);
        (kept, told.take())
    }

    #[test]
    fn a_device_that_is_lost_takes_no_more_than_what_came_since_the_last_save() {
        let (kept, told) = lost(true);
        assert!(kept.is_some(), "one can paint on");
        let [first, Event::Opened(_), last] = &told[..] else { panic!("three events: {told:?}") };
        let said = |event: &Event| match event {
            Event::Message { text, failed, .. } => (text.clone(), *failed),
            other => panic!("no message: {other:?}"),
        };
        assert!(said(first).0.contains("pulled out") && said(first).1, "the loss is told");
        assert!(said(last).0.contains("processor") && !said(last).1, "and the way on");
    }

    #[test]
    fn a_device_that_is_lost_before_any_save_is_told_of() {
        let (kept, told) = lost(false);
        assert!(kept.is_none(), "there is no painting");
        let Some(Event::Message { hint: Some(hint), failed: true, .. }) = told.last() else {
            panic!("a message with a hint: {told:?}");
        };
        assert!(hint.to_string().contains("recovered"), "{hint}");
    }
}
