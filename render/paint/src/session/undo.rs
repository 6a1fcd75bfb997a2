//! Undo and redo over both surfaces.

use super::failure::SessionError;
use super::history::Entry;
use super::state::PaintingSession;
use crate::painting::Painting;
use crate::strokes::{Action, PerSurface, SurfaceId};

impl PaintingSession {
    /// Undoes the last action on either surface; returns whether there was one. An open stroke
    /// or adjustment is finished first, and is then the last action.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn undo(&mut self) -> Result<bool, SessionError> {
        self.finish_open()?;
        let Some(entry) = self.history.done.pop() else { return Ok(false) };
        let exchanged = self.exchange(&entry, Painting::undo);
        self.follow_failure(exchanged)?;
        if let Some(carried) = entry.carried {
            self.brushes.tools[carried.tool].at = carried.from;
        }
        self.history.undone.push(entry);
        self.limit_history();
        self.note(Action::Undo {});
        Ok(true)
    }

    /// Repeats the action that was undone last; returns whether there was one.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn redo(&mut self) -> Result<bool, SessionError> {
        self.finish_open()?;
        let Some(entry) = self.history.undone.pop() else { return Ok(false) };
        let exchanged = self.exchange(&entry, Painting::redo);
        self.follow_failure(exchanged)?;
        if let Some(carried) = entry.carried {
            self.brushes.tools[carried.tool].at = carried.to;
        }
        self.history.done.push(entry);
        self.limit_history();
        self.note(Action::Redo {});
        Ok(true)
    }

    /// Undoes or repeats actions until `done` of those of [`PaintingSession::history`] are done,
    /// or as near as can be reached.
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

    /// Labels of all actions, the oldest first, and the number of those that are done; the
    /// others were undone. Actions that can no longer be reached are left out.
    #[must_use]
    pub fn history(&self) -> (Vec<&str>, usize) {
        (self.history.labels(), self.history.done.len())
    }

    /// Memory that undo takes now, and its limit, both in bytes for both surfaces.
    #[must_use]
    pub fn undo_bytes(&self) -> (u64, u64) {
        let (used, limit) = self.canvas.undo_bytes();
        let palette = self.palette.as_ref().map_or((0, 0), Painting::undo_bytes);
        (used + palette.0, limit + palette.1)
    }

    /// Sets the limit of the memory for undo, in bytes: three quarters for the canvas and a
    /// quarter for the palette, if there is one. Actions that do not fit are dropped.
    pub fn set_undo_bytes(&mut self, bytes: u64) {
        let palette_bytes = if self.palette.is_some() { bytes / 4 } else { 0 };
        self.canvas.set_undo_bytes(bytes - palette_bytes);
        if let Some(palette) = &mut self.palette {
            palette.set_undo_bytes(palette_bytes);
        }
        self.limit_history();
    }

    /// Drops the actions of the history that a painting has dropped.
    pub(super) fn limit_history(&mut self) {
        let count = |of: fn(&Painting) -> usize| {
            PerSurface::from_fn(|surface| self.painting(surface).map_or(0, of))
        };
        let (undo, redo) = (count(Painting::undo_count), count(Painting::redo_count));
        self.history.limit_to(undo, redo);
    }

    /// Undoes or repeats an action on the surfaces whose histories have it.
    fn exchange(
        &mut self,
        entry: &Entry,
        exchange: impl Fn(&mut Painting) -> Result<bool, crate::painting::PaintingError>,
    ) -> Result<(), SessionError> {
        for surface in SurfaceId::ALL {
            if entry.on[surface] {
                let done = exchange(self.surface_mut(surface)?)?;
                assert!(done, "the history of the painting has `{}`", entry.label);
            }
        }
        Ok(())
    }
}
