//! Rendering on the processor. We bake the reflectance of ground and dry layers. When you read a
//! picture, we composite the wet paint over this and shade it.
//!
//! We store the baked reflectance only where there is dry paint. Everywhere else it is the
//! ground's.

use std::ops::Range;

use graphics::field::Field;
use graphics::tile::{Rect, TILE, Tile, TileSet};
use rayon::prelude::*;

use super::columns::{Columns, SparseLayer};
use crate::composite::{composite_layer_row, composite_row};
use crate::optics::{NODES, Scene};
use crate::shade::{TopMaterial, Tops, shade_row};

/// The layers to be rendered.
#[derive(Debug, Clone, Copy)]
pub(super) struct PaintLayers<'a> {
    /// Height of the ground alone, in quanta.
    pub(super) ground: &'a Field<i32>,
    /// Height of ground and dry paint, in quanta.
    pub(super) floor: &'a Field<i32>,
    pub(super) wet: &'a Columns,
    pub(super) dry: &'a [SparseLayer],
}

/// Data from which a view computes its picture. The picture itself is not kept, as it would take
/// 16 bytes a cell and is read once after it changed. Allocated when first rendered.
#[derive(Debug, Default)]
pub(super) struct RenderedView {
    /// The scene of the last rendering. `None` before the first.
    scene: Option<Scene>,
    baked: BakedTiles,
    tops: Tops,
}

const BLACK: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

impl RenderedView {
    /// Bakes the tiles of `baked`, and updates the heights of the surface in these tiles and in
    /// `shown`. This uses all cores.
    pub(super) fn render(
        &mut self,
        scene: &Scene,
        layers: &PaintLayers<'_>,
        baked: &TileSet,
        shown: &TileSet,
    ) {
        let count = layers.dry.len();
        assert_eq!(scene.dry.len(), count, "the scene must describe each dry layer");
        let bounds = layers.floor.bounds();
        if bounds.is_empty() {
            return;
        }
        if self.tops.size() != (bounds.width, bounds.height) {
            self.tops = Tops::level(bounds.width, bounds.height);
        }
        self.scene = Some(scene.clone());
        self.baked.bake(scene, layers.dry, bounds, baked);
        let mut both = shown.clone();
        for tile in baked.iter() {
            both.insert_tile(tile);
        }
        let (Some(highest), Some(lowest)) = (both.iter().next(), both.iter().last()) else {
            return;
        };
        // We visit only rows between the first and the last tile.
        let first = highest.row * TILE;
        let end = ((lowest.row + 1) * TILE).min(bounds.height);
        let spans = spans(&both, bounds);
        let PaintLayers { floor, wet, .. } = *layers;
        self.tops.set(
            first..end,
            |y| &spans[y / TILE],
            |x, y| floor[(x, y)] + wet.volume()[y * bounds.width + x] as i32,
        );
    }

    /// The picture in `rect`: linear sRGB, with 1 as the fourth component. Before the first
    /// rendering it is black. This distributes rows over all cores.
    pub(super) fn picture_in(&self, layers: &PaintLayers<'_>, rect: Rect) -> Field<[f32; 4]> {
        let mut picture = Field::filled(rect.width, rect.height, BLACK);
        let Some(scene) = self.scene.as_ref().filter(|_| !rect.is_empty()) else { return picture };
        let rows = picture.values_mut().par_chunks_mut(rect.width).enumerate();
        rows.for_each_init(Buffers::default, |buffers, (row, picture)| {
            let y = rect.y + row;
            let span = rect.x..rect.x + rect.width;
            self.shade(scene, layers, y, span, picture, buffers);
        });
        picture
    }

    /// Composites the wet paint over the baked reflectance in `span` of row `y`, and shades it.
    fn shade(
        &self,
        scene: &Scene,
        layers: &PaintLayers<'_>,
        y: usize,
        span: Range<usize>,
        picture: &mut [[f32; 4]],
        buffers: &mut Buffers,
    ) {
        let PaintLayers { ground, floor, wet, .. } = *layers;
        let Buffers { internal, materials } = buffers;
        let width = floor.width();
        internal.clear();
        internal.resize(span.len(), scene.ground);
        self.baked.copy_row(y, span.start, internal);
        let body = wet.layer().row(y, span.start, span.len());
        composite_row(&scene.wet, body, None, internal);
        if let Some(skin) = wet.skin_row(y, span.start, span.len()) {
            composite_row(&scene.wet, skin, Some(body), internal);
        }
        materials.clear();
        materials.extend(span.clone().map(|x| match wet.volume()[y * width + x] {
            0 if floor[(x, y)] == ground[(x, y)] => TopMaterial::Ground,
            0 => TopMaterial::Dry,
            _ => TopMaterial::Wet,
        }));
        shade_row(scene, (&self.tops, (span.start, y)), internal, materials, picture);
    }
}

/// The ranges of cell columns that `tiles` cover, for each row of tiles. We merge adjacent tiles.
fn spans(tiles: &TileSet, bounds: Rect) -> Vec<Vec<Range<usize>>> {
    let mut rows: Vec<Vec<Range<usize>>> = vec![Vec::new(); bounds.height.div_ceil(TILE)];
    for tile in tiles.iter() {
        let rect = tile.rect(bounds);
        let row = &mut rows[tile.row];
        match row.last_mut() {
            Some(span) if span.end == rect.x => span.end += rect.width,
            _ => row.push(rect.x..rect.x + rect.width),
        }
    }
    rows
}

/// Buffers of one thread for one row.
#[derive(Debug, Default)]
struct Buffers {
    internal: Vec<[f32; NODES]>,
    materials: Vec<TopMaterial>,
}

/// Reflectances of one tile, row by row.
type TileReflectance = Vec<[f32; NODES]>;

/// Baked reflectances by tile.
#[derive(Debug, Default)]
pub(super) struct BakedTiles {
    width: usize,
    tile_columns: usize,
    /// Row by row. `None` without dry paint.
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
        let baked: Vec<_> = tiles
            .par_iter()
            .map(|&tile: &Tile| (tile, baked(scene, dry, tile, tile.rect(bounds))))
            .collect();
        for (tile, reflectance) in baked {
            self.tiles[tile.row * self.tile_columns + tile.column] = reflectance;
        }
    }

    /// Copies the reflectances of row `y` from column `x` on to `row`, where there is dry paint.
    /// This leaves other cells of `row` alone.
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

/// Internal reflectance of ground and dry layers in `tile`, which covers `rect`. `None` if no
/// layer has paint there.
fn baked(scene: &Scene, dry: &[SparseLayer], tile: Tile, rect: Rect) -> Option<TileReflectance> {
    let mut backing: Option<TileReflectance> = None;
    for (layer, optics) in dry.iter().zip(&scene.dry) {
        let Some(part) = layer.tile(tile) else { continue };
        let backing = backing.get_or_insert_with(|| vec![scene.ground; rect.width * rect.height]);
        for (y, row) in backing.chunks_mut(rect.width).enumerate() {
            composite_layer_row(optics, part, (0, y), row);
        }
    }
    backing
}
