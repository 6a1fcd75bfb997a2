//! The actions that can be undone and redone, within a limit of memory.

use graphics::gpu::DeviceError;
use std::collections::VecDeque;

use super::action::{Action, DryChange, Restored, TILE_BYTES, bytes_of};
use crate::engine::{BrushId, PaintEngine, UndoSlot};
use crate::layer::Layer;
use graphics::tile::{Rect, TileSet};

/// Message of the panic when an action must be open.
const OPEN: &str = "an action must be open";

/// Message of the panic when no action may be open.
const NOT_OPEN: &str = "no action may be open";

/// Message of the panic for an action that was within the limit a moment ago.
const FITS: &str = "the action fits the limit of memory";

/// Actions that can be undone and redone. `T` is a value that the caller gets back with
/// each, such as a document's metadata.
///
/// An action is opened by [`begin`](History::begin), saves what it is about to change
/// ([`save_tiles`](History::save_tiles), [`save_brush`](History::save_brush)) or changes
/// dry layers through the history, and is closed by [`commit`](History::commit).
#[derive(Debug)]
pub struct History<T> {
    limit_bytes: u64,
    bytes: u64,
    /// Actions that can be undone, the oldest first.
    done: VecDeque<Action<T>>,
    /// Actions that can be redone, the next last.
    undone: Vec<Action<T>>,
    open: Option<OpenAction<T>>,
    free_slots: Vec<UndoSlot>,
    /// Number of slots ever used; the engine holds memory for each.
    pub(super) slot_count: usize,
}

#[derive(Debug)]
enum OpenAction<T> {
    Saved(Action<T>),
    /// It exceeds the limit by itself, so its saved state was dropped.
    TooLarge,
}

/// Whether a committed action can be undone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CommitOutcome {
    /// The action can be undone.
    Undoable,
    /// The action needs more memory than the limit. Its changes stay, and neither it nor
    /// any action before it can be undone.
    TooLarge,
}

impl<T> History<T> {
    /// An empty history that uses at most `limit_bytes` of memory for saved paint.
    #[must_use]
    pub fn new(limit_bytes: u64) -> Self {
        Self {
            limit_bytes,
            bytes: 0,
            done: VecDeque::new(),
            undone: Vec::new(),
            open: None,
            free_slots: Vec::new(),
            slot_count: 0,
        }
    }

    /// Opens an action and drops all that could be redone. An undo of the action returns
    /// `before`.
    ///
    /// # Panics
    /// If an action is open.
    pub fn begin(&mut self, before: T) {
        assert!(self.open.is_none(), "{NOT_OPEN}");
        while let Some(action) = self.undone.pop() {
            self.forget(action);
        }
        self.open = Some(OpenAction::Saved(Action::new(before)));
    }

    /// Saves the wet paint of the tiles that `rect` overlaps; call it before they change.
    /// Tiles that this action has saved before are skipped.
    ///
    /// # Errors
    /// [`DeviceError`] if the engine has no memory left.
    ///
    /// # Panics
    /// If no action is open.
    pub fn save_tiles(&mut self, engine: &mut PaintEngine, rect: Rect) -> Result<(), DeviceError> {
        let mut tiles = TileSet::default();
        tiles.insert(rect.intersection(engine.bounds()));
        for tile in tiles.iter() {
            let known = self.open_action().is_none_or(|action| action.tiles.contains_key(&tile));
            if known || !self.reserve(TILE_BYTES) {
                continue;
            }
            let slot = self.free_slots.pop().unwrap_or(UndoSlot(self.slot_count));
            self.slot_count = self.slot_count.max(slot.0 + 1);
            if let Err(error) = engine.save_tile(tile, slot) {
                self.free_slots.push(slot);
                self.bytes -= TILE_BYTES;
                return Err(error);
            }
            self.open_action().expect(FITS).tiles.insert(tile, slot);
        }
        Ok(())
    }

    /// Saves the paint of a brush; call it before the paint changes.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    ///
    /// # Panics
    /// If no action is open.
    pub fn save_brush(
        &mut self,
        engine: &mut PaintEngine,
        brush: BrushId,
    ) -> Result<(), DeviceError> {
        if self.open_action().is_none_or(|action| action.brushes.contains_key(&brush)) {
            return Ok(());
        }
        let paint = engine.brush_paint(brush)?;
        if self.reserve(bytes_of(&paint)) {
            self.open_action().expect(FITS).brushes.insert(brush, paint);
        }
        Ok(())
    }

    /// Dries a share of the wet paint, in parts of 65536, as part of the open action; see
    /// [`PaintEngine::dry`].
    ///
    /// # Errors
    /// [`DeviceError`] if the engine has no memory left.
    ///
    /// # Panics
    /// If no action is open.
    pub fn dry(&mut self, engine: &mut PaintEngine, share: u32) -> Result<(), DeviceError> {
        let bounds = engine.bounds();
        for tile in engine.wet_tiles()?.iter() {
            self.save_tiles(engine, tile.rect(bounds))?;
        }
        let index = engine.dry_layer_count();
        engine.dry(share)?;
        self.note_dry(DryChange::Inserted(index));
        Ok(())
    }

    /// Adds a dry layer at `index` as part of the open action.
    ///
    /// # Errors
    /// [`DeviceError`] if the engine has no memory left.
    ///
    /// # Panics
    /// If no action is open.
    pub fn insert_dry_layer(
        &mut self,
        engine: &mut PaintEngine,
        index: usize,
        layer: &Layer,
    ) -> Result<(), DeviceError> {
        engine.insert_dry_layer(index, layer)?;
        self.note_dry(DryChange::Inserted(index));
        Ok(())
    }

    /// Removes the dry layer `index` as part of the open action.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    ///
    /// # Panics
    /// If no action is open.
    pub fn remove_dry_layer(
        &mut self,
        engine: &mut PaintEngine,
        index: usize,
    ) -> Result<(), DeviceError> {
        let layer = engine.remove_dry_layer(index)?;
        if self.open_action().is_some() && self.reserve(bytes_of(&layer)) {
            self.note_dry(DryChange::Removed(index, layer));
        }
        Ok(())
    }

    /// Moves a dry layer from one index to another as part of the open action, which takes no
    /// memory.
    ///
    /// # Panics
    /// If no action is open.
    pub fn move_dry_layer(&mut self, engine: &mut PaintEngine, from: usize, to: usize) {
        engine.move_dry_layer(from, to);
        self.note_dry(DryChange::Moved { from, to });
    }

    /// Closes the open action.
    ///
    /// # Panics
    /// If no action is open.
    pub fn commit(&mut self) -> CommitOutcome {
        match self.open.take().expect(OPEN) {
            OpenAction::Saved(action) => {
                self.done.push_back(action);
                CommitOutcome::Undoable
            }
            OpenAction::TooLarge => CommitOutcome::TooLarge,
        }
    }

    /// Closes the open action and drops its saved state; its changes stay.
    ///
    /// # Panics
    /// If no action is open.
    pub fn abandon(&mut self) {
        if let OpenAction::Saved(action) = self.open.take().expect(OPEN) {
            self.forget(action);
        }
    }

    /// Restores the state before the last action; `None` if there is none to undo. A redo
    /// returns `current`.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost, and all paint with it.
    ///
    /// # Panics
    /// If an action is open.
    pub fn undo(
        &mut self,
        engine: &mut PaintEngine,
        current: T,
    ) -> Result<Option<Restored<T>>, DeviceError> {
        assert!(self.open.is_none(), "{NOT_OPEN}");
        let Some(mut action) = self.done.pop_back() else { return Ok(None) };
        self.bytes -= action.bytes();
        let restored = action.swap(engine, current)?;
        self.bytes += action.bytes();
        self.undone.push(action);
        self.shrink();
        Ok(Some(restored))
    }

    /// Restores the state after the action undone last; `None` if there is none to redo.
    /// Its undo returns `current`.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost, and all paint with it.
    ///
    /// # Panics
    /// If an action is open.
    pub fn redo(
        &mut self,
        engine: &mut PaintEngine,
        current: T,
    ) -> Result<Option<Restored<T>>, DeviceError> {
        assert!(self.open.is_none(), "{NOT_OPEN}");
        let Some(mut action) = self.undone.pop() else { return Ok(None) };
        self.bytes -= action.bytes();
        let restored = action.swap(engine, current)?;
        self.bytes += action.bytes();
        self.done.push_back(action);
        self.shrink();
        Ok(Some(restored))
    }

    /// Number of actions that can be undone.
    #[must_use]
    pub fn undo_count(&self) -> usize {
        self.done.len()
    }

    /// Number of actions that can be redone.
    #[must_use]
    pub fn redo_count(&self) -> usize {
        self.undone.len()
    }

    /// Memory of the saved paint in bytes. Free slots, which the engine keeps allocated,
    /// do not count.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Limit of the memory of saved paint in bytes.
    #[must_use]
    pub fn limit_bytes(&self) -> u64 {
        self.limit_bytes
    }

    /// Sets the limit of memory. Actions farthest from the present are forgotten until the
    /// rest fits.
    pub fn set_limit_bytes(&mut self, limit_bytes: u64) {
        self.limit_bytes = limit_bytes;
        self.shrink();
    }

    /// Forgets all but the last `undo` actions that can be undone, and all but the next `redo`
    /// that can be redone.
    pub fn keep_only(&mut self, undo: usize, redo: usize) {
        while self.done.len() > undo {
            self.done.pop_front().into_iter().for_each(|oldest| self.forget(oldest));
        }
        while self.undone.len() > redo {
            let farthest = self.undone.remove(0);
            self.forget(farthest);
        }
    }

    fn note_dry(&mut self, change: DryChange) {
        if let Some(action) = self.open_action() {
            action.dry.push(change);
        }
    }

    /// The open action; `None` if it exceeds the limit.
    fn open_action(&mut self) -> Option<&mut Action<T>> {
        match self.open.as_mut().expect(OPEN) {
            OpenAction::Saved(action) => Some(action),
            OpenAction::TooLarge => None,
        }
    }

    /// Counts `more` bytes for the open action and forgets the oldest actions until they
    /// fit. Returns whether they fit; if not, the open action's saved state is dropped.
    fn reserve(&mut self, more: u64) -> bool {
        while self.bytes + more > self.limit_bytes {
            if let Some(oldest) = self.done.pop_front() {
                self.forget(oldest);
                continue;
            }
            if let Some(OpenAction::Saved(action)) = self.open.replace(OpenAction::TooLarge) {
                self.forget(action);
            }
            return false;
        }
        self.bytes += more;
        true
    }

    /// Forgets the actions farthest from the present until the rest fits. An undo can need
    /// this, as it saves the dry layers that it removes.
    fn shrink(&mut self) {
        while self.bytes > self.limit_bytes {
            if self.undone.is_empty() {
                let Some(oldest) = self.done.pop_front() else { return };
                self.forget(oldest);
            } else {
                let farthest = self.undone.remove(0);
                self.forget(farthest);
            }
        }
    }

    fn forget(&mut self, action: Action<T>) {
        self.bytes -= action.bytes();
        self.free_slots.extend(action.tiles.into_values());
    }
}
