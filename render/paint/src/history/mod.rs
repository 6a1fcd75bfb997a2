//! Undo and redo, by tiles.
//!
//! An action keeps the wet paint of each tile that it touches, as it was before
//! (in the engine: on the GPU when painting there), the paint of brushes that it
//! changes, dry layers that it takes away, and something of its caller's. To
//! undo it exchanges all of that with what is there now, so that a redo is the
//! same exchange once more, and both are exact to the bit.
//!
//! Memory: [`TILE_BYTES`] for a tile, 36 bytes a cell for brushes and dry
//! layers; all of it is counted, and never passes the limit for longer than
//! one call.

mod action;

#[cfg(test)]
mod laws;

use graphics::gpu::DeviceError;
use std::collections::VecDeque;

use self::action::{Action, DryChange, bytes_of};
pub use self::action::{Restored, TILE_BYTES};
use super::engine::{BrushId, Engine, Slot};
use crate::layer::Layer;
use graphics::tile::{Rect, TileSet};

/// Actions that can be undone and redone. `T` is what the caller wants to have
/// back with each, such as a document's metadata.
#[derive(Debug)]
pub struct History<T> {
    limit_bytes: u64,
    bytes: u64,
    done: VecDeque<Action<T>>,
    undone: Vec<Action<T>>,
    open: Option<Open<T>>,
    free: Vec<Slot>,
    slots: usize,
}

#[derive(Debug)]
enum Open<T> {
    Kept(Action<T>),
    /// It alone passes the limit: nothing is kept.
    TooLarge,
}

/// Whether an action can be undone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kept {
    /// Yes.
    Undoable,
    /// It takes more than all the memory that the history may have. It stays
    /// done, and neither it nor anything before it can be undone.
    TooLarge,
}

impl<T> History<T> {
    /// Nothing done yet, in at most `limit_bytes` of memory for paint.
    #[must_use]
    pub fn new(limit_bytes: u64) -> Self {
        Self {
            limit_bytes,
            bytes: 0,
            done: VecDeque::new(),
            undone: Vec::new(),
            open: None,
            free: Vec::new(),
            slots: 0,
        }
    }

    /// Opens an action; what could be redone no longer can. `before` is what an
    /// undo gives back.
    ///
    /// # Panics
    /// If one is open.
    pub fn begin(&mut self, before: T) {
        assert!(self.open.is_none(), "an action is open");
        while let Some(action) = self.undone.pop() {
            self.forget(action);
        }
        self.open = Some(Open::Kept(Action::new(before)));
    }

    /// Keeps the wet paint of the tiles that `rect` touches, before they change.
    /// Those kept already in this action cost nothing.
    ///
    /// # Errors
    /// [`DeviceError`] if the engine has no memory for it.
    ///
    /// # Panics
    /// If no action is open.
    pub fn touch(&mut self, engine: &mut dyn Engine, rect: Rect) -> Result<(), DeviceError> {
        let mut touched = TileSet::default();
        touched.insert(rect.intersection(engine.bounds()));
        for tile in touched.iter() {
            let known = self.kept().is_none_or(|action| action.tiles.contains_key(&tile));
            if known || !self.make_room(TILE_BYTES) {
                continue;
            }
            let slot = self.free.pop().unwrap_or(Slot(self.slots));
            self.slots = self.slots.max(slot.0 + 1);
            if let Err(error) = engine.save(tile, slot) {
                self.free.push(slot);
                self.bytes -= TILE_BYTES;
                return Err(error);
            }
            self.kept().expect("there was room").tiles.insert(tile, slot);
        }
        Ok(())
    }

    /// Keeps the paint of a brush, before it changes.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    ///
    /// # Panics
    /// If no action is open.
    pub fn touch_brush(
        &mut self,
        engine: &mut dyn Engine,
        brush: BrushId,
    ) -> Result<(), DeviceError> {
        if self.kept().is_none_or(|action| action.brushes.contains_key(&brush)) {
            return Ok(());
        }
        let paint = engine.brush(brush)?;
        if self.make_room(bytes_of(&paint)) {
            self.kept().expect("there was room").brushes.insert(brush, paint);
        }
        Ok(())
    }

    /// [`Engine::dry`] as part of the open action; `wet` are the tiles that hold
    /// wet paint.
    ///
    /// # Errors
    /// [`DeviceError`] if there is no memory for it.
    ///
    /// # Panics
    /// If no action is open.
    pub fn dry(&mut self, engine: &mut dyn Engine, share: u32) -> Result<(), DeviceError> {
        let bounds = engine.bounds();
        for tile in engine.painted()?.iter() {
            self.touch(engine, tile.rect(bounds))?;
        }
        engine.dry(share)?;
        self.kept().into_iter().for_each(|action| action.dry.push(DryChange::Pushed));
        Ok(())
    }

    /// [`Engine::push_dry`] as part of the open action.
    ///
    /// # Errors
    /// [`DeviceError`] if there is no memory for it.
    ///
    /// # Panics
    /// If no action is open.
    pub fn push_dry(&mut self, engine: &mut dyn Engine, layer: &Layer) -> Result<(), DeviceError> {
        engine.push_dry(layer)?;
        self.kept().into_iter().for_each(|action| action.dry.push(DryChange::Pushed));
        Ok(())
    }

    /// [`Engine::pop_dry`] as part of the open action.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    ///
    /// # Panics
    /// If no action is open.
    pub fn pop_dry(&mut self, engine: &mut dyn Engine) -> Result<(), DeviceError> {
        let layer = engine.pop_dry()?;
        if self.kept().is_some() && self.make_room(bytes_of(&layer)) {
            let action = self.kept().expect("there was room");
            action.dry.push(DryChange::Popped(layer));
        }
        Ok(())
    }

    /// Closes the open action.
    ///
    /// # Panics
    /// If none is open.
    pub fn commit(&mut self) -> Kept {
        match self.open.take().expect("an action is open") {
            Open::Kept(action) => {
                self.done.push_back(action);
                Kept::Undoable
            }
            Open::TooLarge => Kept::TooLarge,
        }
    }

    /// Closes the open action as if it had not been one: what it did stays done.
    ///
    /// # Panics
    /// If none is open.
    pub fn abandon(&mut self) {
        if let Open::Kept(action) = self.open.take().expect("an action is open") {
            self.forget(action);
        }
    }

    /// Brings back what was before the last action; `current` is what a redo
    /// gives back. Nothing if there is none.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost, and all paint with it.
    ///
    /// # Panics
    /// If an action is open.
    pub fn undo(
        &mut self,
        engine: &mut dyn Engine,
        current: T,
    ) -> Result<Option<Restored<T>>, DeviceError> {
        assert!(self.open.is_none(), "an action is open");
        let Some(mut action) = self.done.pop_back() else { return Ok(None) };
        self.bytes -= action.bytes();
        let restored = action.exchange(engine, current)?;
        self.bytes += action.bytes();
        self.undone.push(action);
        self.shrink();
        Ok(Some(restored))
    }

    /// Does the last undone action again; `current` is what its undo gives back.
    /// Nothing if there is none.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost, and all paint with it.
    ///
    /// # Panics
    /// If an action is open.
    pub fn redo(
        &mut self,
        engine: &mut dyn Engine,
        current: T,
    ) -> Result<Option<Restored<T>>, DeviceError> {
        assert!(self.open.is_none(), "an action is open");
        let Some(mut action) = self.undone.pop() else { return Ok(None) };
        self.bytes -= action.bytes();
        let restored = action.exchange(engine, current)?;
        self.bytes += action.bytes();
        self.done.push_back(action);
        self.shrink();
        Ok(Some(restored))
    }

    /// How many actions can be undone.
    #[must_use]
    pub fn undo_count(&self) -> usize {
        self.done.len()
    }

    /// How many actions can be redone.
    #[must_use]
    pub fn redo_count(&self) -> usize {
        self.undone.len()
    }

    /// The memory that kept paint takes, in bytes. Slots that are free for reuse
    /// in the engine do not count.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The memory that kept paint may take, in bytes.
    #[must_use]
    pub fn limit(&self) -> u64 {
        self.limit_bytes
    }

    /// Sets it; what is furthest from now is forgotten until the rest fits.
    pub fn set_limit(&mut self, limit_bytes: u64) {
        self.limit_bytes = limit_bytes;
        self.shrink();
    }

    /// The action that is open, unless it is too large.
    fn kept(&mut self) -> Option<&mut Action<T>> {
        match self.open.as_mut().expect("an action is open") {
            Open::Kept(action) => Some(action),
            Open::TooLarge => None,
        }
    }

    /// Counts `more` bytes for the open action, dropping the oldest ones until
    /// they fit; whether they do. If not, nothing is kept any more.
    fn make_room(&mut self, more: u64) -> bool {
        while self.bytes + more > self.limit_bytes {
            if let Some(oldest) = self.done.pop_front() {
                self.forget(oldest);
                continue;
            }
            if let Some(Open::Kept(action)) = self.open.replace(Open::TooLarge) {
                self.forget(action);
            }
            return false;
        }
        self.bytes += more;
        true
    }

    /// Drops what is furthest from now until the rest fits: layers that an undo
    /// took away are kept here from then on.
    fn shrink(&mut self) {
        while self.bytes > self.limit_bytes {
            if self.undone.is_empty() {
                let Some(oldest) = self.done.pop_front() else { return };
                self.forget(oldest);
            } else {
                let furthest = self.undone.remove(0);
                self.forget(furthest);
            }
        }
    }

    fn forget(&mut self, action: Action<T>) {
        self.bytes -= action.bytes();
        self.free.extend(action.tiles.into_values());
    }
}
