//! Commands carried out, in their order.

use std::sync::Arc;

use spectra::hint::Hint;

use render::layer::SLOTS;
use render::paint::session::{Outcome, PaintingSession, SessionError};
use render::paint::strokes::{Action, Load, Squeeze, SurfaceId};

use super::command::{Command, PenSample};
use super::event::{Event, Picked, Snapshot};
use super::free_space::roomiest;
use super::pick::{Place, picked};
use super::report::WorkerStatus;
use super::state::PaintingState;
use super::stroke::LiveStroke;
use super::worker::{OpenPainting, WorkerLoop};

/// What the stage always has.
const PALETTE: &str = "every painting has a palette beside it";

impl WorkerLoop<'_> {
    /// Does the next thing: plays a slice of a stroke, or a command.
    pub(super) fn work(&mut self) -> Result<(), SessionError> {
        if self.playing.is_some() {
            for question in self.inbox.take_questions() {
                self.answer(question)?;
            }
            self.play()
        } else if self.live.is_some() {
            self.paint()
        } else if let Some(command) = self.inbox.next() {
            self.act_on(command)
        } else {
            Ok(())
        }
    }

    /// A stroke goes on: all samples there are, then a slice of its paint.
    fn paint(&mut self) -> Result<(), SessionError> {
        while let Some(Command::PenMove(samples)) =
            self.inbox.next_if(|command| matches!(command, Command::PenMove(_)))
        {
            self.extend(&samples)?;
        }
        let is_question = |command: &Command| {
            matches!(
                command,
                Command::Snapshot(_)
                    | Command::Recording(_)
                    | Command::Pick { .. }
                    | Command::SetUndoBytes(_)
                    | Command::EndAdjustment
            )
        };
        if self.live.as_ref().is_some_and(|live| live.waiting == 0)
            && let Some(question) = self.inbox.next_if(is_question)
        {
            return self.answer(question);
        }
        if self.inbox.next_if(|command| matches!(command, Command::PenUp)).is_some()
            || self.inbox.next_is(|command| !is_question(command))
        {
            // Whatever else comes ends the stroke first.
            self.lift()?;
        }
        self.slice()
    }

    fn extend(&mut self, samples: &[PenSample]) -> Result<(), SessionError> {
        let (Some(live), Some(stage)) = (&mut self.live, &mut self.stage) else { return Ok(()) };
        if live.lifted {
            return Ok(());
        }
        for PenSample { sample, arrived } in samples {
            if let Err(error) = live.extend(&mut stage.opened.session, sample, *arrived)
                && !std::mem::replace(&mut live.refused, true)
            {
                let hint = Some(Hint::new("the stroke goes on without it"));
                (self.tell)(Event::Message { text: error.to_string(), hint, failed: true });
            }
        }
        live.know(&mut stage.opened.session)
    }

    /// No more samples come to the stroke.
    pub(super) fn lift(&mut self) -> Result<(), SessionError> {
        match (&mut self.live, &mut self.stage) {
            (Some(live), Some(stage)) => live.lift(&mut stage.opened.session),
            _ => Ok(()),
        }
    }

    /// Paints on for a slice; closes the stroke once all is painted.
    pub(super) fn slice(&mut self) -> Result<(), SessionError> {
        let (Some(live), Some(stage)) = (&mut self.live, &mut self.stage) else { return Ok(()) };
        let session = &mut stage.opened.session;
        let painted = live.slice(session, &mut self.meter, &mut self.outbox)?;
        self.unseen |= painted;
        self.revision += u64::from(painted);
        if live.is_over() {
            let brush = live.brush().to_owned();
            self.live = None;
            session.end_stroke()?;
            stage.teller.brushes.remove(&brush);
            (self.unseen, self.stale) = (true, true);
        }
        Ok(())
    }

    /// Carries out one command; no stroke is open, nothing is played.
    fn act_on(&mut self, command: Command) -> Result<(), SessionError> {
        match command {
            Command::Open(origin) => self.open(origin),
            Command::Replay { script, library, pace } => self.replay(*script, &library, pace),
            Command::SetUndoBytes(bytes) => {
                self.undo_bytes = bytes;
                if let Some(stage) = &mut self.stage {
                    stage.opened.session.set_undo_bytes(bytes);
                    self.stale = true;
                }
            }
            // Of a stroke that ended before the pen was lifted.
            Command::PenMove(_) | Command::PenUp | Command::Cancel | Command::Quit => {}
            command if self.stage.is_some() => return self.change(command),
            command => {
                let text = format!("no painting is open for {}", command.name());
                self.say(text, Some(Hint::new("open one, or begin a new one")), true);
            }
        }
        Ok(())
    }

    /// What needs a painting.
    fn change(&mut self, command: Command) -> Result<(), SessionError> {
        match command {
            Command::PenDown { surface, brush } => {
                let begun = LiveStroke::begin(self.session(), surface, &brush)?;
                self.live = Some(begun);
                self.stale = true;
                Ok(())
            }
            Command::SetBrush { name, spec } => {
                self.session().set_brush(&name, &spec)?;
                self.brush_changed(&name);
                Ok(())
            }
            Command::Apply(action) => self.apply(&action),
            Command::Adjust(action) => {
                self.session().adjust(&action)?;
                self.changed();
                Ok(())
            }
            Command::GoTo(done) => {
                let travelled = self.session().go_to(done);
                self.all_changed();
                travelled
            }
            Command::SetSecondLight(lighting) => {
                self.session().canvas_mut().set_second_light(lighting)?;
                (self.unseen, self.stale) = (true, true);
                Ok(())
            }
            Command::LoadPicked { brush, picked, amount_mm } => {
                self.load_picked(brush, &picked, amount_mm)
            }
            Command::SqueezeInFreeSpace { recipe, vehicle, volume_mm3, places, reach_mm } => {
                let palette = self.session().painting_mut(SurfaceId::Palette).expect(PALETTE);
                let Some([x_mm, y_mm]) = roomiest(palette, &places, reach_mm)? else {
                    let hint = "squeeze it out of the tubes";
                    let text = "there is no place for it on the palette";
                    self.say(text.to_owned(), Some(Hint::new(hint)), true);
                    return Ok(());
                };
                let on = SurfaceId::Palette;
                let heap = Squeeze { on, recipe, vehicle, x_mm, y_mm, volume_mm3 };
                self.apply(&Action::Squeeze(heap))
            }
            question => self.answer(question),
        }
    }

    fn apply(&mut self, action: &Action) -> Result<(), SessionError> {
        let outcome = self.session().apply(action)?;
        match action {
            Action::Load(Load { brush, .. })
            | Action::Wipe { brush, .. }
            | Action::Wash { brush } => self.brush_changed(brush),
            action if outcome == Outcome::Nothing => {
                let text = match action {
                    Action::Dry { .. } => "there is no wet paint to dry",
                    Action::Undo {} => "there is nothing to undo",
                    Action::Redo {} => "there is nothing to redo",
                    _ => "there is nothing to do",
                };
                self.say(text.to_owned(), None, false);
            }
            _ => self.all_changed(),
        }
        Ok(())
    }

    /// Puts what was picked on a brush, in place of what it holds.
    fn load_picked(
        &mut self,
        brush: String,
        picked: &Picked,
        amount_mm: f64,
    ) -> Result<(), SessionError> {
        let library = Arc::clone(&self.stage_mut().opened.library);
        let wet = picked.layers.last();
        let amounts = wet.map_or([0.0; SLOTS + 1], |wet| wet.amounts_mm);
        let total: f64 = amounts.iter().sum();
        if total <= 0.0 {
            let hint = "dry paint stays where it is; its recipe can be loaded from the tubes";
            self.say("there was no wet paint".to_owned(), Some(Hint::new(hint)), true);
            return Ok(());
        }
        let slots = wet.map_or([None; SLOTS], |wet| wet.slots);
        let named = slots.iter().zip(amounts).filter(|(_, amount)| *amount > 0.0);
        let recipe = named.filter_map(|(slot, amount)| {
            Some((library.pigments[(*slot)?].name.clone(), amount / total))
        });
        let load = Load {
            brush: brush.clone(),
            recipe: recipe.collect(),
            vehicle: amounts[SLOTS] / total,
            amount_mm,
        };
        self.session().apply(&Action::Wash { brush: brush.clone() })?;
        self.brush_changed(&brush);
        self.session().apply(&Action::Load(load))?;
        Ok(())
    }

    /// Answers what changes nothing.
    pub(super) fn answer(&mut self, question: Command) -> Result<(), SessionError> {
        if self.stage.is_none() {
            return Ok(());
        }
        match question {
            Command::Snapshot(number) => {
                let revision = self.revision;
                let (canvas, palette) = self.session().documents()?;
                let (canvas, palette) = (Arc::new(canvas), Arc::new(palette.expect(PALETTE)));
                let snapshot = Snapshot { number, canvas, palette, revision };
                self.keep(&snapshot);
                (self.tell)(Event::Snapshot(snapshot));
            }
            Command::Recording(number) => match self.session().recording().cloned() {
                Some(script) => {
                    (self.tell)(Event::Recording { number, script: Arc::new(script) });
                }
                None => {
                    let text = "a painting that was recovered has no recording";
                    self.say(text.to_owned(), Some(Hint::new("save the painting itself")), true);
                }
            },
            Command::Pick { surface, x_mm, y_mm, radius_mm } => {
                let place = Place { surface, x_mm, y_mm, radius_mm };
                let painting = self.session().painting_mut(surface).expect(PALETTE);
                if let Some(picked) = picked(painting, place)? {
                    (self.tell)(Event::Picked(Arc::new(picked)));
                }
            }
            Command::SetUndoBytes(bytes) => {
                self.undo_bytes = bytes;
                self.session().set_undo_bytes(bytes);
                self.stale = true;
            }
            Command::EndAdjustment => {
                self.session().end_adjustment();
                self.stale = true;
            }
            other => unreachable!("{} is no question", other.name()),
        }
        Ok(())
    }

    /// Everything about the painting but its pixels.
    pub(super) fn state(&mut self) -> Result<Option<Arc<PaintingState>>, SessionError> {
        let Some(OpenPainting { opened, teller }) = &mut self.stage else { return Ok(None) };
        let beside = WorkerStatus { revision: self.revision, stroke_open: self.live.is_some() };
        Ok(Some(Arc::new(teller.state(opened, &beside, self.outbox.bytes())?)))
    }

    /// The session of the painting that is known to be open.
    pub(super) fn session(&mut self) -> &mut PaintingSession {
        &mut self.stage_mut().opened.session
    }

    pub(super) fn stage_mut(&mut self) -> &mut OpenPainting {
        self.stage.as_mut().expect("a painting is open, as the caller saw")
    }

    fn brush_changed(&mut self, brush: &str) {
        self.stage_mut().teller.brushes.remove(brush);
        self.stale = true;
    }

    fn changed(&mut self) {
        self.revision += 1;
        (self.unseen, self.stale) = (true, true);
    }

    pub(super) fn all_changed(&mut self) {
        self.stage_mut().teller.brushes.clear();
        self.changed();
    }
}
