//! A dry layer that takes memory only where it has paint.

use crate::field::Field;
use crate::layer::Layer;
use crate::tile::{Rect, TILE, Tile, TileSet};

/// A layer by tiles; those without paint are not kept.
#[derive(Debug, Clone)]
pub(super) struct SparseLayer {
    bounds: Rect,
    columns: usize,
    tiles: Vec<Option<Layer>>,
}

impl SparseLayer {
    /// No paint over `bounds`.
    pub(super) fn empty(bounds: Rect) -> Self {
        let columns = bounds.width.div_ceil(TILE);
        let tiles = vec![None; columns * bounds.height.div_ceil(TILE)];
        Self { bounds, columns, tiles }
    }

    pub(super) fn from_layer(layer: &Layer) -> Self {
        let mut sparse = Self::empty(layer.vehicle.bounds());
        for tile in TileSet::all(sparse.bounds).iter() {
            sparse.set_tile(tile, copied(layer, tile.rect(sparse.bounds)));
        }
        sparse
    }

    pub(super) fn to_layer(&self) -> Layer {
        let mut layer = Layer::empty(self.bounds.width, self.bounds.height);
        for (tile, part) in self.tiles() {
            paste(part, &mut layer, tile.rect(self.bounds));
        }
        layer
    }

    /// The tiles that have paint.
    pub(super) fn tiles(&self) -> impl Iterator<Item = (Tile, &Layer)> {
        self.tiles.iter().enumerate().filter_map(|(index, part)| {
            let tile = Tile { row: index / self.columns, column: index % self.columns };
            Some((tile, part.as_ref()?))
        })
    }

    /// The paint of one tile, if it has any.
    pub(super) fn tile(&self, tile: Tile) -> Option<&Layer> {
        self.tiles[tile.row * self.columns + tile.column].as_ref()
    }

    /// Keeps `part` as the paint of `tile`, if it is any.
    pub(super) fn set_tile(&mut self, tile: Tile, part: Layer) {
        let painted = part.totals().iter().any(|&total| total > 0);
        self.tiles[tile.row * self.columns + tile.column] = painted.then_some(part);
    }

    /// `change` with the height of every column of paint, and of the cell of
    /// `floor` below it.
    pub(super) fn on_floor(&self, floor: &mut Field<i32>, change: impl Fn(i32, u32) -> i32) {
        for (tile, part) in self.tiles() {
            let rect = tile.rect(self.bounds);
            for y in 0..rect.height {
                for (x, cell) in
                    floor.row_mut(rect.y + y, rect.x, rect.width).iter_mut().enumerate()
                {
                    *cell = change(*cell, part.cell(y * rect.width + x).volume());
                }
            }
        }
    }
}

/// The part of `layer` in `rect`.
pub(super) fn copied(layer: &Layer, rect: Rect) -> Layer {
    let mut part = Layer::empty(rect.width, rect.height);
    for y in 0..rect.height {
        let from = layer.pigments.row(rect.y + y, rect.x, rect.width);
        part.pigments.row_mut(y, 0, rect.width).copy_from_slice(from);
        let from = layer.vehicle.row(rect.y + y, rect.x, rect.width);
        part.vehicle.row_mut(y, 0, rect.width).copy_from_slice(from);
    }
    part
}

/// Puts `part` into `layer` at `rect`.
fn paste(part: &Layer, layer: &mut Layer, rect: Rect) {
    for y in 0..rect.height {
        let to = layer.pigments.row_mut(rect.y + y, rect.x, rect.width);
        to.copy_from_slice(part.pigments.row(y, 0, rect.width));
        let to = layer.vehicle.row_mut(rect.y + y, rect.x, rect.width);
        to.copy_from_slice(part.vehicle.row(y, 0, rect.width));
    }
}
