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

use std::collections::{BTreeMap, VecDeque};

use super::engine::{BrushId, Engine, EngineError, Slot};
use crate::layer::{Layer, SLOTS};
use crate::tile::{Rect, TILE, Tile, TileSet};

/// What a tile takes, in bytes: 144 KiB.
pub const TILE_BYTES: u64 = (TILE * TILE) as u64 * CELL_BYTES;

const CELL_BYTES: u64 = 4 * (SLOTS as u64 + 1);

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

/// What is exchanged with the engine to undo, and again to redo.
#[derive(Debug)]
struct Action<T> {
    caller: T,
    tiles: BTreeMap<Tile, Slot>,
    brushes: BTreeMap<BrushId, Layer>,
    /// In the order in which they were done.
    dry: Vec<DryChange>,
}

#[derive(Debug)]
enum DryChange {
    /// A layer was put on top, and is in the engine.
    Pushed,
    /// The topmost layer was taken away.
    Popped(Layer),
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

/// What an undo or redo brought back.
#[derive(Debug, Clone, PartialEq)]
pub struct Restored<T> {
    /// What the caller had kept.
    pub caller: T,
    /// Tiles whose wet paint changed.
    pub tiles: TileSet,
    /// Whether dry layers came or went, and with them the floor.
    pub dry_changed: bool,
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
        let (tiles, brushes, dry) = Default::default();
        self.open = Some(Open::Kept(Action { caller: before, tiles, brushes, dry }));
    }

    /// Keeps the wet paint of the tiles that `rect` touches, before they change.
    /// Those kept already in this action cost nothing.
    ///
    /// # Errors
    /// [`EngineError`] if the engine has no memory for it.
    ///
    /// # Panics
    /// If no action is open.
    pub fn touch(&mut self, engine: &mut dyn Engine, rect: Rect) -> Result<(), EngineError> {
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
    /// [`EngineError`] if the device was lost.
    ///
    /// # Panics
    /// If no action is open.
    pub fn touch_brush(
        &mut self,
        engine: &mut dyn Engine,
        brush: BrushId,
    ) -> Result<(), EngineError> {
        if self.kept().is_none_or(|action| action.brushes.contains_key(&brush)) {
            return Ok(());
        }
        let paint = engine.brush(brush)?;
        if self.make_room(bytes_of(&paint)) {
            self.kept().expect("there was room").brushes.insert(brush, paint);
        }
        Ok(())
    }

    /// [`Engine::dry`] as part of the open action.
    ///
    /// # Errors
    /// [`EngineError`] if there is no memory for it.
    ///
    /// # Panics
    /// If no action is open.
    pub fn dry(&mut self, engine: &mut dyn Engine, share: u32) -> Result<(), EngineError> {
        let all = engine.bounds();
        self.touch(engine, all)?;
        engine.dry(share)?;
        self.kept().into_iter().for_each(|action| action.dry.push(DryChange::Pushed));
        Ok(())
    }

    /// [`Engine::push_dry`] as part of the open action.
    ///
    /// # Errors
    /// [`EngineError`] if there is no memory for it.
    ///
    /// # Panics
    /// If no action is open.
    pub fn push_dry(&mut self, engine: &mut dyn Engine, layer: &Layer) -> Result<(), EngineError> {
        engine.push_dry(layer)?;
        self.kept().into_iter().for_each(|action| action.dry.push(DryChange::Pushed));
        Ok(())
    }

    /// [`Engine::pop_dry`] as part of the open action.
    ///
    /// # Errors
    /// [`EngineError`] if the device was lost.
    ///
    /// # Panics
    /// If no action is open.
    pub fn pop_dry(&mut self, engine: &mut dyn Engine) -> Result<(), EngineError> {
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

    /// Brings back what was before the last action; `current` is what a redo
    /// gives back. Nothing if there is none.
    ///
    /// # Errors
    /// [`EngineError`] if the device was lost, and all paint with it.
    ///
    /// # Panics
    /// If an action is open.
    pub fn undo(
        &mut self,
        engine: &mut dyn Engine,
        current: T,
    ) -> Result<Option<Restored<T>>, EngineError> {
        assert!(self.open.is_none(), "an action is open");
        let Some(action) = self.done.pop_back() else { return Ok(None) };
        let (action, restored) = self.exchange(action, engine, current)?;
        self.undone.push(action);
        self.shrink();
        Ok(Some(restored))
    }

    /// Does the last undone action again; `current` is what its undo gives back.
    /// Nothing if there is none.
    ///
    /// # Errors
    /// [`EngineError`] if the device was lost, and all paint with it.
    ///
    /// # Panics
    /// If an action is open.
    pub fn redo(
        &mut self,
        engine: &mut dyn Engine,
        current: T,
    ) -> Result<Option<Restored<T>>, EngineError> {
        assert!(self.open.is_none(), "an action is open");
        let Some(action) = self.undone.pop() else { return Ok(None) };
        let (action, restored) = self.exchange(action, engine, current)?;
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

    /// Exchanges all that `action` keeps with what is there.
    fn exchange(
        &mut self,
        mut action: Action<T>,
        engine: &mut dyn Engine,
        current: T,
    ) -> Result<(Action<T>, Restored<T>), EngineError> {
        self.bytes -= action.bytes();
        let mut tiles = TileSet::default();
        for (&tile, &slot) in &action.tiles {
            engine.swap(tile, slot)?;
            tiles.insert_tile(tile);
        }
        for (&brush, paint) in &mut action.brushes {
            let now = engine.brush(brush)?;
            engine.set_brush(brush, paint)?;
            *paint = now;
        }
        action.dry.reverse();
        for change in &mut action.dry {
            *change = match change {
                DryChange::Pushed => DryChange::Popped(engine.pop_dry()?),
                DryChange::Popped(layer) => {
                    engine.push_dry(layer)?;
                    DryChange::Pushed
                }
            };
        }
        let caller = std::mem::replace(&mut action.caller, current);
        self.bytes += action.bytes();
        let dry_changed = !action.dry.is_empty();
        Ok((action, Restored { caller, tiles, dry_changed }))
    }
}

impl<T> Action<T> {
    fn bytes(&self) -> u64 {
        let brushes = self.brushes.values();
        let dry = self.dry.iter().filter_map(|change| match change {
            DryChange::Popped(layer) => Some(layer),
            DryChange::Pushed => None,
        });
        self.tiles.len() as u64 * TILE_BYTES + brushes.chain(dry).map(bytes_of).sum::<u64>()
    }
}

fn bytes_of(layer: &Layer) -> u64 {
    layer.vehicle.values().len() as u64 * CELL_BYTES
}
