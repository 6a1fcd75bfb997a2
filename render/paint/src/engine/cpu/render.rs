//! Rendering on the processor: the reflectance of ground and dry layers is baked, the
//! wet paint is composited over it and shaded.

use std::ops::Range;

use rayon::prelude::*;

use super::columns::Columns;
use super::sparse::SparseLayer;
use crate::composite::composite_row;
use crate::optics::{NODES, Scene};
use crate::shade::{TopMaterial, Tops, shade_row};
use graphics::field::Field;
use graphics::tile::{Rect, TILE, Tile, TileSet};

/// The layers to be rendered.
#[derive(Debug, Clone, Copy)]
pub(super) struct PaintLayers<'a> {
    /// Height of the ground alone, in quanta.
    pub(super) ground: &'a Field<i32>,
    /// Height of ground and dry paint, in quanta.
    pub(super) floor: &'a Field<i32>,
    pub(super) wet: &'a Columns,
    /// Dry layers, lowest first.
    pub(super) dry: &'a [SparseLayer],
}

/// The last rendered state of a view. Allocated when first rendered or read.
#[derive(Debug)]
pub(super) struct RenderedView {
    /// Internal reflectance of ground and dry layers.
    baked: Field<[f32; NODES]>,
    /// Height of the surface.
    tops: Tops,
    /// Linear sRGB, with 1 as the fourth component.
    picture: Field<[f32; 4]>,
}

impl Default for RenderedView {
    fn default() -> Self {
        Self {
            baked: Field::filled(0, 0, [0.0; NODES]),
            tops: Tops::default(),
            picture: Field::filled(0, 0, BLACK),
        }
    }
}

const BLACK: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

impl RenderedView {
    /// The picture as last rendered; black where it never was.
    pub(super) fn picture(&mut self, bounds: Rect) -> &Field<[f32; 4]> {
        if self.picture.bounds() != bounds {
            self.picture = Field::filled(bounds.width, bounds.height, BLACK);
        }
        &self.picture
    }

    /// Renders the tiles of `shown` and `baked`, after baking those of `baked`. Rows
    /// are distributed over all cores.
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
        self.picture(bounds);
        if self.baked.bounds() != bounds {
            self.baked = Field::filled(bounds.width, bounds.height, scene.ground);
            self.tops = Tops::level(bounds.width, bounds.height);
        }
        let mut both = shown.clone();
        for tile in baked.iter() {
            both.insert_tile(tile);
        }
        let (Some(highest), Some(lowest)) = (both.iter().next(), both.iter().last()) else {
            return;
        };
        // Only rows between the first and the last tile are visited.
        let (first, end) = (highest.row * TILE, ((lowest.row + 1) * TILE).min(bounds.height));
        let cells = first * bounds.width..end * bounds.width;
        let (baked_spans, shown_spans) = (spans(baked, bounds), spans(&both, bounds));
        let PaintLayers { floor, wet, .. } = *layers;
        let top = |x, y| floor[(x, y)] + wet.volume()[y * bounds.width + x] as i32;
        self.tops.set(first..end, |y| &shown_spans[y / TILE], top);
        let tops = &self.tops;
        let baked = self.baked.values_mut()[cells.clone()].par_chunks_mut(bounds.width);
        let picture = self.picture.values_mut()[cells].par_chunks_mut(bounds.width);
        let rows = baked.zip(picture).enumerate();
        rows.for_each_init(Buffers::default, |buffers, (row, (baked, picture))| {
            let y = first + row;
            for span in &baked_spans[y / TILE] {
                bake(scene, layers, y, span, baked);
            }
            for span in &shown_spans[y / TILE] {
                show(scene, layers, (tops, y), span, baked, picture, buffers);
            }
        });
    }
}

/// The ranges of cell columns that `tiles` cover, for each row of tiles; adjacent
/// tiles are merged.
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

/// Computes the internal reflectance of ground and dry layers over `span` of row `y`.
fn bake(
    scene: &Scene,
    layers: &PaintLayers<'_>,
    y: usize,
    span: &Range<usize>,
    baked: &mut [[f32; NODES]],
) {
    baked[span.clone()].fill(scene.ground);
    for (layer, optics) in layers.dry.iter().zip(&scene.dry) {
        for column in span.start / TILE..span.end.div_ceil(TILE) {
            let Some(part) = layer.tile(Tile { row: y / TILE, column }) else { continue };
            let backing = &mut baked[column * TILE..][..part.width()];
            composite_row(optics, part.pigments.row(y % TILE, 0, part.width()), backing);
        }
    }
}

/// Buffers of one thread for one row.
#[derive(Debug, Default)]
struct Buffers {
    internal: Vec<[f32; NODES]>,
    materials: Vec<TopMaterial>,
}

/// Composites the wet paint over the baked reflectance in `span` of row `y`, and
/// shades it.
fn show(
    scene: &Scene,
    layers: &PaintLayers<'_>,
    (tops, y): (&Tops, usize),
    span: &Range<usize>,
    baked: &[[f32; NODES]],
    picture: &mut [[f32; 4]],
    buffers: &mut Buffers,
) {
    let PaintLayers { ground, floor, wet, .. } = *layers;
    let Buffers { internal, materials } = buffers;
    let width = floor.width();
    internal.clear();
    internal.extend_from_slice(&baked[span.clone()]);
    composite_row(&scene.wet, wet.layer().pigments.row(y, span.start, span.len()), internal);
    materials.clear();
    materials.extend(span.clone().map(|x| match wet.volume()[y * width + x] {
        0 if floor[(x, y)] == ground[(x, y)] => TopMaterial::Ground,
        0 => TopMaterial::Dry,
        _ => TopMaterial::Wet,
    }));
    let first = (span.start, y);
    shade_row(scene, (tops, first), internal, materials, &mut picture[span.clone()]);
}
