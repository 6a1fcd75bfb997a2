//! Undo and redo over both surfaces.

use super::failure::SessionError;
use super::history::Entry;
use super::state::PaintingSession;
use crate::painting::Painting;
use crate::strokes::{Action, PerSurface, SurfaceId};

/// Share of the memory, as a divisor, that is kept for the surface that uses less.
const RESERVED: u64 = 8;

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

    /// Number of the state before the actions of [`PaintingSession::history`], then of the state
    /// after each. Each action of the session has a number of its own, rising from 1, which it keeps
    /// while others are dropped; the state before the first has 0.
    #[must_use]
    pub fn history_numbers(&self) -> Vec<u64> {
        self.history.numbers()
    }

    /// Memory that undo takes now, and its limit, both in bytes for both surfaces.
    #[must_use]
    pub fn undo_bytes(&self) -> (u64, u64) {
        let used = PerSurface::from_fn(|surface| self.used_bytes(surface));
        (used.iter().sum(), self.undo_limit)
    }

    /// Sets the limit of the memory for undo, in bytes, which canvas and palette share: each may
    /// take what the other leaves, except for an eighth. Actions that do not fit are dropped.
    pub fn set_undo_bytes(&mut self, bytes: u64) {
        self.undo_limit = bytes;
        self.limit_history();
    }

    /// Drops the actions that cannot be reached any more, as a painting has dropped one after them
    /// (or, of undone ones, before them), and shares the memory out anew.
    pub(super) fn limit_history(&mut self) {
        self.drop_unreachable();
        let reserved = if self.palette.is_some() { self.undo_limit / RESERVED } else { 0 };
        let canvas = self.used_bytes(SurfaceId::Canvas);
        let palette = self.used_bytes(SurfaceId::Palette);
        let left = |other: u64| self.undo_limit.saturating_sub(other.max(reserved));
        let for_canvas = left(palette);
        let for_palette = left(canvas);
        self.canvas.set_undo_bytes(for_canvas);
        if let Some(palette) = &mut self.palette {
            palette.set_undo_bytes(for_palette);
        }
        self.drop_unreachable();
    }

    fn drop_unreachable(&mut self) {
        let count = |of: fn(&Painting) -> usize| {
            PerSurface::from_fn(|surface| self.painting(surface).map_or(0, of))
        };
        let undo = count(Painting::undo_count);
        let redo = count(Painting::redo_count);
        self.history.limit_to(undo, redo);
        if self.stroke.is_some() {
            // The move of its brush is in a painting's history already, and in this one later.
            return;
        }
        let (undo, redo) = self.history.counts();
        for surface in SurfaceId::ALL {
            if let Some(painting) = self.painting_mut(surface) {
                painting.keep_actions(undo[surface], redo[surface]);
            }
        }
    }

    fn used_bytes(&self, surface: SurfaceId) -> u64 {
        self.painting(surface).map_or(0, |painting| painting.undo_bytes().0)
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
