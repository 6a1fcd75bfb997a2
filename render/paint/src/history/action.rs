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
    /// Whether dry layers were added or removed, which changes the floor too.
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
    /// A layer was added on top; the engine holds it.
    Pushed,
    /// This layer was removed from the top.
    Popped(Layer),
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
            DryChange::Popped(layer) => Some(layer),
            DryChange::Pushed => None,
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
                DryChange::Pushed => DryChange::Popped(engine.pop_dry_layer()?),
                DryChange::Popped(layer) => {
                    engine.push_dry_layer(layer)?;
                    DryChange::Pushed
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
