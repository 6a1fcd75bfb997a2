//! The light of a painting: reflectances of what is dry, baked, and the picture
//! of the wet paint over them.

use std::ops::Range;

use rayon::prelude::*;

use super::columns::Columns;
use super::sparse::SparseLayer;
use crate::composite::lay_over;
use crate::optics::{NODES, Scene};
use crate::shade::{Relief, shade_row};
use graphics::field::Field;
use graphics::tile::{Rect, TILE, Tile, TileSet};

/// What is lit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Painting<'a> {
    /// Height of the ground alone.
    pub(super) ground: &'a Field<i32>,
    /// Height of ground and dry paint.
    pub(super) floor: &'a Field<i32>,
    pub(super) wet: &'a Columns,
    pub(super) dry: &'a [SparseLayer],
}

/// What was computed last; takes no memory before it is asked for.
#[derive(Debug)]
pub(super) struct Lit {
    baked: Field<[f32; NODES]>,
    picture: Field<[f32; 4]>,
}

impl Default for Lit {
    fn default() -> Self {
        Self { baked: Field::filled(0, 0, [0.0; NODES]), picture: Field::filled(0, 0, DARK) }
    }
}

const DARK: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

impl Lit {
    /// The picture as last computed; dark where it never was.
    pub(super) fn picture(&mut self, bounds: Rect) -> &Field<[f32; 4]> {
        if self.picture.bounds() != bounds {
            self.picture = Field::filled(bounds.width, bounds.height, DARK);
        }
        &self.picture
    }

    /// Bakes and shows `baked` tiles, shows `shown` ones, by rows on all cores.
    pub(super) fn light(
        &mut self,
        scene: &Scene,
        painting: &Painting<'_>,
        baked: &TileSet,
        shown: &TileSet,
    ) {
        let layers = painting.dry.len();
        assert_eq!(scene.dry.len(), layers, "dry layers that the scene has a coat for");
        let bounds = painting.floor.bounds();
        if bounds.is_empty() {
            return;
        }
        self.picture(bounds);
        if self.baked.bounds() != bounds {
            self.baked = Field::filled(bounds.width, bounds.height, scene.ground);
        }
        let mut both = shown.clone();
        for tile in baked.iter() {
            both.insert_tile(tile);
        }
        let (Some(highest), Some(lowest)) = (both.iter().next(), both.iter().last()) else {
            return;
        };
        // Rows beyond these are not even looked at.
        let first = highest.row * TILE;
        let cells =
            first * bounds.width..((lowest.row + 1) * TILE).min(bounds.height) * bounds.width;
        let (baked_spans, shown_spans) = (spans(baked, bounds), spans(&both, bounds));
        let baked = self.baked.values_mut()[cells.clone()].par_chunks_mut(bounds.width);
        let picture = self.picture.values_mut()[cells].par_chunks_mut(bounds.width);
        let rows = baked.zip(picture).enumerate();
        rows.for_each_init(Buffers::default, |buffers, (row, (baked, picture))| {
            let y = first + row;
            for span in &baked_spans[y / TILE] {
                bake(scene, painting, y, span, baked);
            }
            for span in &shown_spans[y / TILE] {
                show(scene, painting, y, span, baked, picture, buffers);
            }
        });
    }
}

/// For each row of tiles, the columns of cells that `tiles` cover.
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

/// The reflectances of ground and dry layers.
fn bake(
    scene: &Scene,
    painting: &Painting<'_>,
    y: usize,
    span: &Range<usize>,
    baked: &mut [[f32; NODES]],
) {
    baked[span.clone()].fill(scene.ground);
    for (layer, coat) in painting.dry.iter().zip(&scene.dry) {
        for column in span.start / TILE..span.end.div_ceil(TILE) {
            let Some(part) = layer.tile(Tile { row: y / TILE, column }) else { continue };
            let backing = &mut baked[column * TILE..][..part.width()];
            lay_over(coat, part.pigments.row(y % TILE, 0, part.width()), backing);
        }
    }
}

/// What one thread needs for a row.
#[derive(Debug, Default)]
struct Buffers {
    internal: Vec<[f32; NODES]>,
    bare: Vec<u8>,
    tops: [Vec<i32>; 3],
}

/// The wet paint over what is baked, and the light on it.
fn show(
    scene: &Scene,
    painting: &Painting<'_>,
    y: usize,
    span: &Range<usize>,
    baked: &[[f32; NODES]],
    picture: &mut [[f32; 4]],
    buffers: &mut Buffers,
) {
    let Painting { ground, floor, wet, .. } = *painting;
    let Buffers { internal, bare, tops } = buffers;
    let (width, last_row) = (floor.width(), floor.height() - 1);
    internal.clear();
    internal.extend_from_slice(&baked[span.clone()]);
    lay_over(&scene.wet, wet.layer().pigments.row(y, span.start, span.len()), internal);
    bare.clear();
    bare.extend(span.clone().map(|x| match wet.volume()[y * width + x] {
        0 if floor[(x, y)] == ground[(x, y)] => BARE,
        0 => DRY,
        _ => WET,
    }));
    for (tops, y) in tops.iter_mut().zip([y.saturating_sub(1), y, (y + 1).min(last_row)]) {
        let top = |x: usize| floor[(x, y)] + wet.volume()[y * width + x] as i32;
        tops.clear();
        tops.push(top(span.start.saturating_sub(1)));
        tops.extend(span.clone().map(top));
        tops.push(top(span.end.min(width - 1)));
    }
    let relief = Relief { above: &tops[0], here: &tops[1], below: &tops[2] };
    shade_row(scene, &relief, internal, bare, &mut picture[span.clone()]);
}

const WET: u8 = 0;
const DRY: u8 = 1;
const BARE: u8 = 2;
