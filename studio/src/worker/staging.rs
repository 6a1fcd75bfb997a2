//! Paintings that come: opened, played from a recording, or taken up again.

use std::time::Instant;

use calibrate::library::PigmentLibrary;
use render::paint::easel::EaselError;
use render::paint::strokes::Strokes;

use super::command::{Origin, Pace};
use super::event::{Event, Snapshot};
use super::opening::{Opened, OpeningError, from_script, opened};
use super::playing::{Playing, Step};
use super::telling::Teller;
use super::workshop::{Stage, Workshop};

impl Workshop<'_> {
    /// Takes up a painting in place of the one there is, which stays if that
    /// fails.
    pub(super) fn open(&mut self, origin: Origin) {
        let opened = opened(origin, &mut self.backend, self.undo_bytes);
        self.put_up(opened);
    }

    /// Puts a painting on the stage; whether there was one.
    fn put_up(&mut self, opened: Result<Opened, OpeningError>) -> bool {
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
        let teller = Teller::new(&opened);
        self.stage = Some(Stage { opened, teller });
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
    pub(super) fn replay(&mut self, script: Strokes, library: &PigmentLibrary, pace: Pace) {
        // Before anything is taken away; what a painting of its own has for
        // pigments is known only with that painting.
        if script.start.is_none()
            && let Err(error) = script.resolve(library)
        {
            return self.say(error.to_string(), error.hint(), true);
        }
        let opened = from_script(&script, library, &mut self.backend, self.undo_bytes);
        if self.put_up(opened) {
            self.playing = Some(Playing::new(script, pace));
        }
    }

    /// Plays on for a moment.
    pub(super) fn play(&mut self) -> Result<(), EaselError> {
        let (Some(playing), Some(stage)) = (&mut self.playing, &mut self.stage) else {
            return Ok(());
        };
        let easel = &mut stage.opened.easel;
        let step = match &mut self.live {
            Some(live) => playing.feed(easel, live),
            None => playing.go(easel, &mut self.live),
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

    fn end_replay(&mut self) -> Result<(), EaselError> {
        self.pause = None;
        let Some(playing) = self.playing.take() else { return Ok(()) };
        // What its stroke was told is painted by and by, as after any pen.
        self.lift()?;
        (self.tell)(playing.progress_now());
        if playing.unsaved > 0 {
            let text =
                format!("{} files that the recording saves were not written", playing.unsaved);
            self.say(text, Some("save the painting yourself".to_owned()), false);
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
            return self.say(text, Some(hint.to_owned()), true);
        };
        let session = Origin::Session {
            canvas: Box::new((*canvas).clone()),
            palette: Box::new((*palette).clone()),
        };
        self.open(session);
        let text = "the painting was taken up on the processor as it was last saved".to_owned();
        self.say(text, None, false);
    }
}
