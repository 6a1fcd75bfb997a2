//! Internal reflectance of ground and dry layers, stored where there is dry paint: everywhere else
//! it is that of the ground.

use rayon::prelude::*;

use super::sparse::SparseLayer;
use crate::composite::composite_row;
use crate::optics::{NODES, Scene};
use graphics::tile::{Rect, TILE, Tile, TileSet};

/// Reflectances of one tile, row by row.
type TileReflectance = Vec<[f32; NODES]>;

/// Baked reflectances by tile.
#[derive(Debug, Default)]
pub(super) struct BakedTiles {
    /// Width of the canvas in cells.
    width: usize,
    /// Number of tiles in a row of tiles.
    tile_columns: usize,
    /// Row by row; `None` without dry paint.
    tiles: Vec<Option<TileReflectance>>,
}

impl BakedTiles {
    /// Bakes `tiles` of a canvas of `bounds` anew.
    pub(super) fn bake(
        &mut self,
        scene: &Scene,
        dry: &[SparseLayer],
        bounds: Rect,
        tiles: &TileSet,
    ) {
        self.width = bounds.width;
        self.tile_columns = bounds.width.div_ceil(TILE);
        self.tiles.resize_with(self.tile_columns * bounds.height.div_ceil(TILE), || None);
        let tiles: Vec<Tile> = tiles.iter().collect();
        let bake = |&tile: &Tile| (tile, baked(scene, dry, tile, tile.rect(bounds)));
        let baked: Vec<_> = tiles.par_iter().map(bake).collect();
        for (tile, reflectance) in baked {
            self.tiles[tile.row * self.tile_columns + tile.column] = reflectance;
        }
    }

    /// Copies the reflectances of row `y` from column `x` on to `row`, where there is dry paint.
    /// Other cells of `row` are left alone.
    pub(super) fn copy_row(&self, y: usize, x: usize, row: &mut [[f32; NODES]]) {
        let end = x + row.len();
        for column in x / TILE..end.div_ceil(TILE) {
            let tile = self.tiles.get((y / TILE) * self.tile_columns + column);
            let Some(Some(tile)) = tile else { continue };
            let left = column * TILE;
            let right = ((column + 1) * TILE).min(self.width);
            let from = left.max(x);
            let to = right.min(end);
            let first = (y % TILE) * (right - left) + from - left;
            row[from - x..to - x].copy_from_slice(&tile[first..][..to - from]);
        }
    }
}

/// Internal reflectance of ground and dry layers in `tile`, which covers `rect`; `None` if no
/// layer has paint there.
fn baked(scene: &Scene, dry: &[SparseLayer], tile: Tile, rect: Rect) -> Option<TileReflectance> {
    let mut backing: Option<TileReflectance> = None;
    for (layer, optics) in dry.iter().zip(&scene.dry) {
        let Some(part) = layer.tile(tile) else { continue };
        let backing = backing.get_or_insert_with(|| vec![scene.ground; rect.width * rect.height]);
        for (y, row) in backing.chunks_mut(rect.width).enumerate() {
            composite_row(optics, part.pigments.row(y, 0, rect.width), row);
        }
    }
    backing
}
