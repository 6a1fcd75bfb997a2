//! Undo and redo over both surfaces.

use super::failure::SessionError;
use super::history::Entry;
use super::state::PaintingSession;
use crate::painting::Painting;
use crate::strokes::{Action, SurfaceId};

impl PaintingSession {
    /// Takes the last action back, on whichever surface it was; whether there was
    /// one. What is open ends first, and is what is taken back.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn undo(&mut self) -> Result<bool, SessionError> {
        self.finish_open()?;
        let Some(entry) = self.history.done.pop() else { return Ok(false) };
        let exchanged = self.exchange(&entry, Painting::undo);
        self.followed(exchanged)?;
        if let Some(carried) = entry.carried {
            self.brushes.tools[carried.tool].at = carried.from;
        }
        self.history.undone.push(entry);
        self.follow();
        self.note(Action::Undo {});
        Ok(true)
    }

    /// Does again what was taken back last; whether there was something.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn redo(&mut self) -> Result<bool, SessionError> {
        self.finish_open()?;
        let Some(entry) = self.history.undone.pop() else { return Ok(false) };
        let exchanged = self.exchange(&entry, Painting::redo);
        self.followed(exchanged)?;
        if let Some(carried) = entry.carried {
            self.brushes.tools[carried.tool].at = carried.to;
        }
        self.history.done.push(entry);
        self.follow();
        self.note(Action::Redo {});
        Ok(true)
    }

    /// Goes to where `done` of the actions of [`PaintingSession::history`] are done, or as
    /// near as can be reached.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn go_to(&mut self, done: usize) -> Result<(), SessionError> {
        self.finish_open()?;
        let (_, now) = self.history();
        for _ in done..now {
            self.undo()?;
        }
        for _ in now..done {
            if !self.redo()? {
                break;
            }
        }
        Ok(())
    }

    /// What was done, the oldest first, and how many of it are done now; the rest
    /// was taken back. What can no longer be reached is left out.
    #[must_use]
    pub fn history(&self) -> (Vec<&str>, usize) {
        (self.history.labels(), self.history.done.len())
    }

    /// The memory that undo takes now, and may take, in bytes of both paintings.
    #[must_use]
    pub fn undo_bytes(&self) -> (u64, u64) {
        let (used, limit) = self.canvas.undo_bytes();
        let beside = self.palette.as_ref().map_or((0, 0), Painting::undo_bytes);
        (used + beside.0, limit + beside.1)
    }

    /// Changes the memory that undo may take, in bytes: three quarters for the
    /// canvas and a quarter for the palette, where there is one. What does not
    /// fit is forgotten.
    pub fn set_undo_bytes(&mut self, bytes: u64) {
        let beside = if self.palette.is_some() { bytes / 4 } else { 0 };
        self.canvas.set_undo_bytes(bytes - beside);
        if let Some(palette) = &mut self.palette {
            palette.set_undo_bytes(beside);
        }
        self.follow();
    }

    /// After something was done, taken back or forgotten.
    pub(super) fn follow(&mut self) {
        let beside = self.palette.as_ref();
        let undo = beside.map_or(0, Painting::undo_count);
        let redo = beside.map_or(0, Painting::redo_count);
        let (canvas_undo, canvas_redo) = (self.canvas.undo_count(), self.canvas.redo_count());
        self.history.follow([canvas_undo, undo], [canvas_redo, redo]);
    }

    /// Undo or redo of an action on the surfaces that it is of.
    fn exchange(
        &mut self,
        entry: &Entry,
        exchange: impl Fn(&mut Painting) -> Result<bool, crate::painting::PaintingError>,
    ) -> Result<(), SessionError> {
        for surface in [SurfaceId::Canvas, SurfaceId::Palette] {
            if entry.on[surface as usize] {
                let done = exchange(self.surface_mut(surface)?)?;
                assert!(done, "the painting knows `{}`, as its history was followed", entry.label);
            }
        }
        Ok(())
    }
}
