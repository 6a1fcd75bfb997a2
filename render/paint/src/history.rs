//! Undo and redo by tiles.
//!
//! Before an action changes paint, the history saves what it is about to change: the wet paint of
//! each tile concerned (in the engine's memory), the paint of brushes, removed dry layers, and a
//! value of the caller's. Undo swaps all of this with the present state. Redo is another such swap.
//! Both are exact to the bit.
//!
//! Memory: [`TILE_BYTES`] per tile, 36 bytes per cell of brushes and of films of dry layers. All of this counts
//! towards the limit, which we exceed at most during one call.

use std::collections::{BTreeMap, VecDeque};

use graphics::gpu::DeviceError;
use graphics::tile::{Rect, TILE, Tile, TileSet};

use crate::engine::{BrushId, PaintEngine, UndoSlot};
use crate::layer::{Layer, SLOTS};

/// Memory of a saved tile in bytes: 288 KiB, body and skin. The processor takes less, as it leaves out
/// pigments without paint.
pub const TILE_BYTES: u64 = 2 * (TILE * TILE) as u64 * CELL_BYTES;

const CELL_BYTES: u64 = 4 * (SLOTS as u64 + 1);

/// The effect of an undo or redo.
#[derive(Debug, Clone, PartialEq)]
pub struct Restored<T> {
    /// The caller's value that belongs to the restored state. You passed this to
    /// [`History::begin`], [`History::undo`] or [`History::redo`].
    pub caller: T,
    /// Tiles whose wet paint changed.
    pub tiles: TileSet,
    /// Whether dry layers were added, removed or moved.
    pub dry_changed: bool,
}

/// The state before an action (or after it, once undone).
#[derive(Debug)]
struct Action<T> {
    caller: T,
    tiles: BTreeMap<Tile, UndoSlot>,
    brushes: BTreeMap<BrushId, Layer>,
    /// Changes of the stack of dry layers, in order.
    dry: Vec<DryChange>,
}

#[derive(Debug)]
enum DryChange {
    /// A layer was added at this index. The engine holds it.
    Inserted(usize),
    /// This layer was removed from this index.
    Removed(usize, Layer),
    /// A layer was moved from one index to another.
    Moved { from: usize, to: usize },
}

impl<T> Action<T> {
    fn new(caller: T) -> Self {
        let (tiles, brushes, dry) = Default::default();
        Self { caller, tiles, brushes, dry }
    }

    fn bytes(&self) -> u64 {
        let brushes = self.brushes.values();
        let dry = self.dry.iter().filter_map(|change| match change {
            DryChange::Removed(_, layer) => Some(layer),
            DryChange::Inserted(_) | DryChange::Moved { .. } => None,
        });
        self.tiles.len() as u64 * TILE_BYTES + brushes.chain(dry).map(bytes_of).sum::<u64>()
    }

    /// Swaps the saved state with the engine's, and the caller's value with
    /// `current`.
    fn swap(&mut self, engine: &mut PaintEngine, current: T) -> Result<Restored<T>, DeviceError> {
        let mut tiles = TileSet::default();
        for (&tile, &slot) in &self.tiles {
            engine.swap_tile(tile, slot)?;
            tiles.insert_tile(tile);
        }
        for (&brush, paint) in &mut self.brushes {
            let present = engine.brush_paint(brush)?;
            engine.set_brush_paint(brush, paint)?;
            *paint = present;
        }
        self.dry.reverse();
        for change in &mut self.dry {
            *change = match change {
                DryChange::Inserted(index) => {
                    DryChange::Removed(*index, engine.remove_dry_layer(*index)?)
                }
                DryChange::Removed(index, layer) => {
                    engine.insert_dry_layer(*index, layer)?;
                    DryChange::Inserted(*index)
                }
                DryChange::Moved { from, to } => {
                    engine.move_dry_layer(*to, *from);
                    DryChange::Moved { from: *to, to: *from }
                }
            };
        }
        let caller = std::mem::replace(&mut self.caller, current);
        Ok(Restored { caller, tiles, dry_changed: !self.dry.is_empty() })
    }
}

fn bytes_of(layer: &Layer) -> u64 {
    layer.single_films().count() as u64 * layer.vehicle.values().len() as u64 * CELL_BYTES
}

const OPEN: &str = "an action must be open";

const NOT_OPEN: &str = "no action may be open";

/// Message of the panic for an action that was within the limit a moment ago.
const FITS: &str = "the action fits the limit of memory";

/// Actions that you can undo and redo. `T` is a value that you get back with each, for example a
/// document's metadata.
///
/// You open an action by [`begin`](History::begin). Then you save what it is about to change
/// ([`save_tiles`](History::save_tiles), [`save_brush`](History::save_brush)) or change dry layers
/// through the history. You close it by [`commit`](History::commit).
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
    /// Number of slots ever used. The engine holds memory for each.
    slot_count: usize,
}

#[derive(Debug)]
enum OpenAction<T> {
    Saved(Action<T>),
    /// The action alone exceeds the limit, so we dropped its saved state.
    TooLarge,
}

/// Tells you whether you can undo a committed action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CommitOutcome {
    /// The action can be undone.
    Undoable,
    /// The action needs more memory than the limit. Its changes stay, and you can undo neither this
    /// action nor any before it.
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

    /// Opens an action and drops all that you could redo. If you undo this action, you get `before`
    /// back.
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

    /// Saves the wet paint of the tiles that `rect` overlaps. Call this before they change. It
    /// skips tiles that this action has saved before.
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

    /// Saves the paint of a brush. Call this before the paint changes.
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

    /// Dries a share of the wet paint, in parts of 65536, as part of the open action. See
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

    /// Closes the open action and drops its saved state. You cannot undo its changes.
    ///
    /// # Panics
    /// If no action is open.
    pub fn abandon(&mut self) {
        if let OpenAction::Saved(action) = self.open.take().expect(OPEN) {
            self.forget(action);
        }
    }

    /// Restores the state before the last action. You get `None` if there is none to undo. A redo
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

    /// Restores the state after the action that you undid last. You get `None` if there is none to
    /// redo. If you undo it again, you get `current`.
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

    /// Number of actions that you can undo.
    #[must_use]
    pub fn undo_count(&self) -> usize {
        self.done.len()
    }

    /// Number of actions that you can redo.
    #[must_use]
    pub fn redo_count(&self) -> usize {
        self.undone.len()
    }

    /// Memory of the saved paint in bytes. This does not count free slots, which the engine keeps
    /// allocated.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Limit of the memory of saved paint in bytes.
    #[must_use]
    pub fn limit_bytes(&self) -> u64 {
        self.limit_bytes
    }

    /// Sets the limit of memory. This forgets the actions farthest from the present until the rest
    /// fits.
    pub fn set_limit_bytes(&mut self, limit_bytes: u64) {
        self.limit_bytes = limit_bytes;
        self.shrink();
    }

    /// Forgets all but the last `undo` actions that you can undo, and all but the next `redo` that
    /// you can redo.
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

    /// The open action. If it exceeds the limit, this is `None`.
    fn open_action(&mut self) -> Option<&mut Action<T>> {
        match self.open.as_mut().expect(OPEN) {
            OpenAction::Saved(action) => Some(action),
            OpenAction::TooLarge => None,
        }
    }

    /// Counts `more` bytes for the open action and forgets the oldest actions until they fit.
    /// Returns whether they fit. If not, this drops the open action's saved state.
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

    /// Forgets the actions farthest from the present until the rest fits. For example, an undo
    /// needs this when it saves the dry layers that it removes.
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

#[cfg(test)]
mod tests {
    //! Tests of undo and redo with random actions on the CPU, and of the memory limit.

    use super::{CommitOutcome, History, TILE_BYTES};
    use crate::contact::{Contact, ExchangeRates, Touch, Wicking};
    use crate::engine::{BrushId, PaintEngine};
    use crate::layer::{Cell, Layer, SLOTS};
    use crate::motion::MotionConstants;
    use graphics::field::Field;
    use graphics::tile::Rect;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// Size of the canvas in cells: six tiles, smaller ones at the right and lower edges.
    const WIDTH: usize = 150;
    const HEIGHT: usize = 100;
    const SIZE: usize = 30;

    /// The wet layer, brushes, dry layers and floor of an engine, and the caller's value.
    type State = (Layer, Vec<Layer>, Vec<Layer>, Field<i32>, usize);

    fn state(engine: &mut PaintEngine, caller: usize) -> State {
        let brushes = [0, 1].map(|i| engine.brush_paint(BrushId(i)).unwrap()).to_vec();
        let dry = (0..engine.dry_layer_count()).map(|i| engine.dry_layer(i).unwrap()).collect();
        (engine.wet().unwrap(), brushes, dry, engine.floor().unwrap(), caller)
    }

    fn painted(width: usize, height: usize, random: &mut ChaCha8Rng) -> Layer {
        let mut layer = Layer::empty(width, height);
        for index in 0..width * height {
            let [pigments @ .., vehicle]: [u32; SLOTS + 1] =
                std::array::from_fn(|_| random.random_range(0..400_000));
            layer.set_cell(index, Cell { pigments, vehicle });
        }
        layer
    }

    fn engine(random: &mut ChaCha8Rng) -> PaintEngine {
        let mut engine = PaintEngine::on_cpu(Field::filled(WIDTH, HEIGHT, 1000));
        engine.set_wet(&painted(WIDTH, HEIGHT, random)).unwrap();
        for _ in 0..2 {
            let brush = engine.add_brush(SIZE, SIZE).unwrap();
            engine.set_brush_paint(brush, &painted(SIZE, SIZE, random)).unwrap();
        }
        engine
    }

    fn stroke(history: &mut History<usize>, engine: &mut PaintEngine, random: &mut ChaCha8Rng) {
        let brush = BrushId(random.random_range(0..2));
        history.save_brush(engine, brush).unwrap();
        for _ in 0..random.random_range(1..4) {
            let x = random.random_range(0..=WIDTH - SIZE);
            let y = random.random_range(0..=HEIGHT - SIZE);
            let rect = Rect { x, y, width: SIZE, height: SIZE };
            let reach = rect.grown(2, engine.bounds());
            history.save_tiles(engine, reach).unwrap();
            let velocity = (random.random_range(-256..=256), random.random_range(-256..=256));
            let touches = (0..SIZE * SIZE).map(|i| Touch::new(900_000, i as u32, velocity, 256, 1));
            let rates = ExchangeRates {
                release: 20_000,
                deposit: 6000,
                pick_up: 6000,
                mixing: 900,
                ..ExchangeRates::default()
            };
            let wicking = Wicking { share: 9000, ..Wicking::default() };
            let contact = Contact { rect, touches: touches.collect(), rates, wicking };
            engine.apply_contacts(brush, &MotionConstants::new(0.1, 0.7), &[contact]).unwrap();
        }
    }

    /// One action: a stroke, a new dry layer, drying with a layer moved, or a dry layer replaced by
    /// another.
    fn act(
        history: &mut History<usize>,
        engine: &mut PaintEngine,
        random: &mut ChaCha8Rng,
        turn: usize,
    ) {
        match turn % 5 {
            1 => {
                let layer = painted(WIDTH, HEIGHT, random);
                let index = random.random_range(0..=engine.dry_layer_count());
                history.insert_dry_layer(engine, index, &layer).unwrap();
            }
            2 => {
                history.dry(engine, random.random_range(0..=65536)).unwrap();
                let count = engine.dry_layer_count();
                let from = random.random_range(0..count);
                let to = random.random_range(0..count);
                history.move_dry_layer(engine, from, to);
            }
            4 => {
                stroke(history, engine, random);
                let index = random.random_range(0..engine.dry_layer_count());
                history.remove_dry_layer(engine, index).unwrap();
                history.dry(engine, 30_000).unwrap();
            }
            _ => stroke(history, engine, random),
        }
    }

    #[test]
    fn undo_and_redo_walk_the_same_states_to_the_bit() {
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        let mut engine = engine(random);
        let mut history = History::new(u64::MAX);
        let mut states = vec![state(&mut engine, 0)];
        for now in 0..25 {
            history.begin(now);
            act(&mut history, &mut engine, random, now);
            assert_eq!(history.commit(), CommitOutcome::Undoable);
            states.push(state(&mut engine, now + 1));
        }
        let mut at = 25;
        for step in 0..80 {
            // Undoes every action, redoes every action, then either at random.
            let back = match step {
                0..25 => true,
                25..50 => false,
                _ => random.random_range(0..2) == 0,
            };
            let caller = states[at].4;
            let restored = if back {
                history.undo(&mut engine, caller)
            } else {
                history.redo(&mut engine, caller)
            };
            let Some(restored) = restored.unwrap() else { continue };
            at = if back { at - 1 } else { at + 1 };
            assert!(state(&mut engine, restored.caller) == states[at], "step {step}, state {at}");
        }
        assert_eq!(history.undo_count() + history.redo_count(), 25);
    }

    #[test]
    fn memory_stays_within_its_limit_and_slots_are_used_again() {
        let random = &mut ChaCha8Rng::seed_from_u64(2);
        let mut engine = engine(random);
        let limit = 12 * TILE_BYTES;
        let mut history = History::new(limit);
        let mut most = 0;
        let mut states = Vec::new();
        for now in 0..60 {
            states.push(state(&mut engine, now));
            history.begin(now);
            stroke(&mut history, &mut engine, random);
            assert_eq!(history.commit(), CommitOutcome::Undoable, "action {now}");
            assert!(history.bytes() <= limit, "{} of {limit} bytes", history.bytes());
            most = most.max(history.bytes());
        }
        assert!(most > limit / 2, "{most} of {limit} bytes");
        assert!(history.slot_count <= 12, "{} slots", history.slot_count);
        assert!((1..60).contains(&history.undo_count()), "{} kept", history.undo_count());
        let mut now = 60;
        while let Some(restored) = history.undo(&mut engine, now).unwrap() {
            now -= 1;
            assert!(state(&mut engine, restored.caller) == states[now], "state {now}");
            assert!(history.bytes() <= limit, "{} of {limit} bytes", history.bytes());
        }
        history.begin(now);
        assert_eq!((history.redo_count(), history.bytes()), (0, 0));
    }

    #[test]
    fn an_action_beyond_the_limit_stays_done_and_cannot_be_undone() {
        let random = &mut ChaCha8Rng::seed_from_u64(3);
        let mut engine = engine(random);
        let mut history = History::new(5 * TILE_BYTES);
        let one_tile = Rect { x: 0, y: 0, width: 64, height: 64 };
        history.begin(0);
        history.save_tiles(&mut engine, one_tile).unwrap();
        assert_eq!(history.commit(), CommitOutcome::Undoable);
        let mut other = PaintEngine::on_cpu(engine.floor().unwrap());
        other.set_wet(&engine.wet().unwrap()).unwrap();
        other.dry(1000).unwrap();
        history.begin(1);
        // Drying saves all six tiles, but the limit is five.
        history.dry(&mut engine, 1000).unwrap();
        assert_eq!(history.commit(), CommitOutcome::TooLarge);
        assert!(engine.wet().unwrap() == other.wet().unwrap(), "drying differs without undo");
        assert!(history.undo(&mut engine, 2).unwrap().is_none(), "undone beyond the limit");
        assert_eq!(history.bytes(), 0);
        history.begin(2);
        history.save_tiles(&mut engine, one_tile).unwrap();
        assert_eq!(history.commit(), CommitOutcome::Undoable);
    }

    #[test]
    fn actions_that_nothing_reaches_give_their_memory_back() {
        let random = &mut ChaCha8Rng::seed_from_u64(4);
        let mut engine = engine(random);
        let mut history = History::new(u64::MAX);
        for now in 0..6 {
            history.begin(now);
            stroke(&mut history, &mut engine, random);
            history.commit();
        }
        history.undo(&mut engine, 6).unwrap();
        history.undo(&mut engine, 5).unwrap();
        let before = history.bytes();
        history.keep_only(1, 1);
        assert_eq!((history.undo_count(), history.redo_count()), (1, 1));
        assert!(history.bytes() < before, "{} of {before} bytes", history.bytes());
        let next = history.redo(&mut engine, 4).unwrap().unwrap();
        assert_eq!(next.caller, 5, "the next redo is kept, not the last");
    }
}
