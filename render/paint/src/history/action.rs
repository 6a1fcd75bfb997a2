//! What one action keeps, and its exchange with what is there.

use graphics::gpu::DeviceError;
use std::collections::BTreeMap;

use crate::engine::{BrushId, Engine, Slot};
use crate::layer::{Layer, SLOTS};
use graphics::tile::{TILE, Tile, TileSet};

/// What a tile takes, in bytes: 144 KiB.
pub const TILE_BYTES: u64 = (TILE * TILE) as u64 * CELL_BYTES;

const CELL_BYTES: u64 = 4 * (SLOTS as u64 + 1);

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

/// What is exchanged with the engine to undo, and again to redo.
#[derive(Debug)]
pub(super) struct Action<T> {
    caller: T,
    pub(super) tiles: BTreeMap<Tile, Slot>,
    pub(super) brushes: BTreeMap<BrushId, Layer>,
    /// In the order in which they were done.
    pub(super) dry: Vec<DryChange>,
}

#[derive(Debug)]
pub(super) enum DryChange {
    /// A layer was put on top, and is in the engine.
    Pushed,
    /// The topmost layer was taken away.
    Popped(Layer),
}

impl<T> Action<T> {
    pub(super) fn new(caller: T) -> Self {
        let (tiles, brushes, dry) = Default::default();
        Self { caller, tiles, brushes, dry }
    }

    /// The memory of the paint it keeps.
    pub(super) fn bytes(&self) -> u64 {
        let brushes = self.brushes.values();
        let dry = self.dry.iter().filter_map(|change| match change {
            DryChange::Popped(layer) => Some(layer),
            DryChange::Pushed => None,
        });
        self.tiles.len() as u64 * TILE_BYTES + brushes.chain(dry).map(bytes_of).sum::<u64>()
    }

    /// Exchanges all that it keeps with what is there.
    pub(super) fn exchange(
        &mut self,
        engine: &mut dyn Engine,
        current: T,
    ) -> Result<Restored<T>, DeviceError> {
        let mut tiles = TileSet::default();
        for (&tile, &slot) in &self.tiles {
            engine.swap(tile, slot)?;
            tiles.insert_tile(tile);
        }
        for (&brush, paint) in &mut self.brushes {
            let now = engine.brush(brush)?;
            engine.set_brush(brush, paint)?;
            *paint = now;
        }
        self.dry.reverse();
        for change in &mut self.dry {
            *change = match change {
                DryChange::Pushed => DryChange::Popped(engine.pop_dry()?),
                DryChange::Popped(layer) => {
                    engine.push_dry(layer)?;
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
