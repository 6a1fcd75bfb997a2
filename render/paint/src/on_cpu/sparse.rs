//! A dry layer that takes memory only where it has paint.

use crate::layer::Layer;
use graphics::field::Field;
use graphics::tile::{Rect, TILE, Tile, TileSet};

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
            sparse.set_tile(tile, layer.part(tile.rect(sparse.bounds)));
        }
        sparse
    }

    /// Its paint in `rect`, which lies within its bounds.
    pub(super) fn part(&self, rect: Rect) -> Layer {
        let mut layer = Layer::empty(rect.width, rect.height);
        let mut reached = TileSet::default();
        reached.insert(rect);
        for tile in reached.iter() {
            let (whole, Some(part)) = (tile.rect(self.bounds), self.tile(tile)) else { continue };
            let both = whole.intersection(rect);
            let inside = Rect { x: both.x - whole.x, y: both.y - whole.y, ..both };
            layer.put((both.x - rect.x, both.y - rect.y), &part.part(inside));
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
