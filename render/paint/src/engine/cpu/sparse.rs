//! A dry layer that takes memory only where it has paint.

use crate::layer::Layer;
use graphics::field::Field;
use graphics::tile::{Rect, TILE, Tile, TileSet};

/// A layer stored by tiles; tiles without paint are not stored.
#[derive(Debug, Clone)]
pub(super) struct SparseLayer {
    bounds: Rect,
    /// Number of tiles in a row of tiles.
    tile_columns: usize,
    /// Row by row; `None` without paint.
    tiles: Vec<Option<Layer>>,
}

impl SparseLayer {
    /// A layer without paint over `bounds`.
    pub(super) fn empty(bounds: Rect) -> Self {
        let tile_columns = bounds.width.div_ceil(TILE);
        let tiles = vec![None; tile_columns * bounds.height.div_ceil(TILE)];
        Self { bounds, tile_columns, tiles }
    }

    pub(super) fn from_layer(layer: &Layer) -> Self {
        let mut sparse = Self::empty(layer.vehicle.bounds());
        for tile in TileSet::all(sparse.bounds).iter() {
            sparse.set_tile(tile, layer.part(tile.rect(sparse.bounds)));
        }
        sparse
    }

    /// The paint in `rect`, which must lie within the bounds.
    pub(super) fn part(&self, rect: Rect) -> Layer {
        let mut layer = Layer::empty(rect.width, rect.height);
        let mut covered = TileSet::default();
        covered.insert(rect);
        for tile in covered.iter() {
            let (whole, Some(part)) = (tile.rect(self.bounds), self.tile(tile)) else { continue };
            let both = whole.intersection(rect);
            let inside = Rect { x: both.x - whole.x, y: both.y - whole.y, ..both };
            layer.put((both.x - rect.x, both.y - rect.y), &part.part(inside));
        }
        layer
    }

    /// The tiles that have paint, row by row.
    pub(super) fn tiles(&self) -> impl Iterator<Item = (Tile, &Layer)> {
        self.tiles.iter().enumerate().filter_map(|(index, part)| {
            let tile = Tile { row: index / self.tile_columns, column: index % self.tile_columns };
            Some((tile, part.as_ref()?))
        })
    }

    /// The paint of one tile; `None` if the tile has no paint.
    pub(super) fn tile(&self, tile: Tile) -> Option<&Layer> {
        self.tiles[tile.row * self.tile_columns + tile.column].as_ref()
    }

    /// Stores `part` as the paint of `tile`, or nothing if `part` is empty.
    pub(super) fn set_tile(&mut self, tile: Tile, part: Layer) {
        let painted = part.totals().iter().any(|&total| total > 0);
        self.tiles[tile.row * self.tile_columns + tile.column] = painted.then_some(part);
    }

    /// Sets each cell of `heights` to `change(height, volume)`, with the volume of
    /// this layer's paint in that cell. Cells of tiles without paint are left alone.
    pub(super) fn for_each_column(
        &self,
        heights: &mut Field<i32>,
        change: impl Fn(i32, u32) -> i32,
    ) {
        for (tile, part) in self.tiles() {
            let rect = tile.rect(self.bounds);
            for y in 0..rect.height {
                for (x, cell) in
                    heights.row_mut(rect.y + y, rect.x, rect.width).iter_mut().enumerate()
                {
                    *cell = change(*cell, part.cell(y * rect.width + x).volume());
                }
            }
        }
    }
}
