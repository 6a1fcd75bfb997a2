//! The state that one action saved, and its swap with the present state.

use graphics::gpu::DeviceError;
use std::collections::BTreeMap;

use crate::engine::{BrushId, PaintEngine, UndoSlot};
use crate::layer::{Layer, SLOTS};
use graphics::tile::{TILE, Tile, TileSet};

/// Memory of a saved tile in bytes: 144 KiB.
pub const TILE_BYTES: u64 = (TILE * TILE) as u64 * CELL_BYTES;

const CELL_BYTES: u64 = 4 * (SLOTS as u64 + 1);

/// The effect of an undo or redo.
#[derive(Debug, Clone, PartialEq)]
pub struct Restored<T> {
    /// The caller's value that belongs to the restored state.
    pub caller: T,
    /// Tiles whose wet paint changed.
    pub tiles: TileSet,
    /// Whether dry layers were added, removed or moved.
    pub dry_changed: bool,
}

/// The state before an action (or after it, once undone).
#[derive(Debug)]
pub(super) struct Action<T> {
    caller: T,
    pub(super) tiles: BTreeMap<Tile, UndoSlot>,
    pub(super) brushes: BTreeMap<BrushId, Layer>,
    /// Changes of the stack of dry layers, in order.
    pub(super) dry: Vec<DryChange>,
}

#[derive(Debug)]
pub(super) enum DryChange {
    /// A layer was added at this index; the engine holds it.
    Inserted(usize),
    /// This layer was removed from this index.
    Removed(usize, Layer),
    /// A layer was moved from one index to another.
    Moved { from: usize, to: usize },
}

impl<T> Action<T> {
    pub(super) fn new(caller: T) -> Self {
        let (tiles, brushes, dry) = Default::default();
        Self { caller, tiles, brushes, dry }
    }

    /// Memory of the saved paint in bytes.
    pub(super) fn bytes(&self) -> u64 {
        let brushes = self.brushes.values();
        let dry = self.dry.iter().filter_map(|change| match change {
            DryChange::Removed(_, layer) => Some(layer),
            DryChange::Inserted(_) | DryChange::Moved { .. } => None,
        });
        self.tiles.len() as u64 * TILE_BYTES + brushes.chain(dry).map(bytes_of).sum::<u64>()
    }

    /// Swaps the saved state with that of the engine, and the caller's value with
    /// `current`.
    pub(super) fn swap(
        &mut self,
        engine: &mut PaintEngine,
        current: T,
    ) -> Result<Restored<T>, DeviceError> {
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

pub(super) fn bytes_of(layer: &Layer) -> u64 {
    layer.vehicle.values().len() as u64 * CELL_BYTES
}
