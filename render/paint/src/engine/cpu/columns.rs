//! The processor stores paint here: columns with their volume beside them, sparse dry layers, tiles
//! saved for undo, and the paint on a head.
//!
//! We store the volume of every cell, so that the penetration of the head need not sum the
//! pigments.

use graphics::field::Field;
use graphics::tile::{Rect, TILE, Tile, TileSet};

use crate::layer::{Cell, Layer, SLOTS};

/// A layer and the volume of each of its cells. 40 bytes a cell.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    layer: Layer,
    volume: Vec<u32>,
}

impl Columns {
    pub(super) fn new(layer: Layer) -> Self {
        // The system only takes memory of zeros where we write to it.
        let mut volume = vec![0; layer.vehicle.values().len()];
        for (index, volume) in volume.iter_mut().enumerate() {
            let found = layer.cell(index).volume();
            if found > 0 {
                *volume = found;
            }
        }
        Self { layer, volume }
    }

    pub(super) fn layer(&self) -> &Layer {
        &self.layer
    }

    pub(super) fn width(&self) -> usize {
        self.layer.width()
    }

    /// Copies the paint in `rect`. We do not copy tiles without paint, so that the memory of a
    /// large canvas with little paint stays small.
    ///
    /// # Panics
    /// If `rect` reaches beyond the canvas.
    pub(super) fn part(&self, rect: Rect) -> Layer {
        let bounds = self.layer.vehicle.bounds();
        assert_eq!(rect.intersection(bounds), rect, "a rectangle must lie within {bounds:?}");
        let mut part = Layer::empty(rect.width, rect.height);
        let mut covered = TileSet::default();
        covered.insert(rect);
        for tile in covered.iter() {
            let inside = tile.rect(bounds).intersection(rect);
            let mut rows = inside.y..inside.y + inside.height;
            if rows.any(|y| {
                self.volume[y * self.width() + inside.x..][..inside.width]
                    .iter()
                    .any(|&volume| volume > 0)
            }) {
                let at = (inside.x - rect.x, inside.y - rect.y);
                part.put(at, &self.layer.part(inside));
            }
        }
        part
    }

    pub(super) fn volume(&self) -> &[u32] {
        &self.volume
    }

    #[inline(always)]
    pub(super) fn cell(&self, index: usize) -> Cell {
        self.layer.cell(index)
    }

    #[inline(always)]
    pub(super) fn set_cell(&mut self, index: usize, cell: Cell) {
        self.layer.set_cell(index, cell);
        self.volume[index] = cell.volume();
    }

    /// Replaces the cells under `part`. Its upper left cell goes to column `x` of row `y`. Where
    /// neither has paint, we write nothing, so that this does not take memory.
    pub(super) fn put(&mut self, (x, y): (usize, usize), part: &Layer) {
        let width = self.layer.width();
        let pigments = self.layer.pigments.values_mut();
        let vehicle = self.layer.vehicle.values_mut();
        for row in 0..part.height() {
            for column in (0..part.width()).step_by(TILE) {
                let count = TILE.min(part.width() - column);
                let first = (y + row) * width + x + column;
                let volume = &mut self.volume[first..][..count];
                let from = row * part.width() + column;
                let found = (from..from + count).map(|index| part.cell(index));
                let bare = volume.iter().all(|&volume| volume == 0);
                if bare && found.clone().all(|cell| cell.volume() == 0) {
                    continue;
                }
                let cells = pigments[first..].iter_mut().zip(&mut vehicle[first..]).zip(volume);
                for (((pigments, vehicle), volume), cell) in cells.zip(found) {
                    (*pigments, *vehicle, *volume) = (cell.pigments, cell.vehicle, cell.volume());
                }
            }
        }
    }

    /// Mutable access to `count` rows from row `first` on.
    pub(super) fn rows(&mut self, first: usize, count: usize) -> Rows<'_> {
        let width = self.layer.width();
        let cells = first * width..(first + count) * width;
        Rows {
            first,
            width,
            pigments: &mut self.layer.pigments.values_mut()[cells.clone()],
            vehicle: &mut self.layer.vehicle.values_mut()[cells.clone()],
            volume: &mut self.volume[cells],
        }
    }
}

/// Consecutive rows of a canvas. One thread changes them.
#[derive(Debug)]
pub(super) struct Rows<'a> {
    first: usize,
    width: usize,
    pigments: &'a mut [[u32; SLOTS]],
    vehicle: &'a mut [u32],
    volume: &'a mut [u32],
}

impl Rows<'_> {
    /// Splits into the rows above row `y` and the rest.
    pub(super) fn split(&mut self, y: usize) -> (Rows<'_>, Rows<'_>) {
        let cells = (y - self.first) * self.width;
        let (pigments, pigments_below) = self.pigments.split_at_mut(cells);
        let (vehicle, vehicle_below) = self.vehicle.split_at_mut(cells);
        let (volume, volume_below) = self.volume.split_at_mut(cells);
        let Self { first, width, .. } = *self;
        let above = Rows { first, width, pigments, vehicle, volume };
        let below = Rows {
            first: y,
            width,
            pigments: pigments_below,
            vehicle: vehicle_below,
            volume: volume_below,
        };
        (above, below)
    }

    /// The cells `x..x + width` of row `y`.
    #[inline(always)]
    pub(super) fn row(&mut self, y: usize, x: usize, width: usize) -> Row<'_> {
        let start = (y - self.first) * self.width + x;
        Row {
            pigments: &mut self.pigments[start..][..width],
            vehicle: &mut self.vehicle[start..][..width],
            volume: &mut self.volume[start..][..width],
        }
    }
}

/// Consecutive cells of one row. The three slices have the same length.
#[derive(Debug)]
pub(super) struct Row<'a> {
    pub(super) pigments: &'a mut [[u32; SLOTS]],
    pub(super) vehicle: &'a mut [u32],
    pub(super) volume: &'a mut [u32],
}

/// A layer stored by tiles. We do not store tiles without paint.
#[derive(Debug, Clone)]
pub(super) struct SparseLayer {
    bounds: Rect,
    tile_columns: usize,
    /// Row by row. `None` without paint.
    tiles: Vec<Option<Layer>>,
}

impl SparseLayer {
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

    /// The paint of one tile. `None` if the tile has no paint.
    pub(super) fn tile(&self, tile: Tile) -> Option<&Layer> {
        self.tiles[tile.row * self.tile_columns + tile.column].as_ref()
    }

    /// Stores `part` as the paint of `tile`, or nothing if `part` is empty.
    pub(super) fn set_tile(&mut self, tile: Tile, part: Layer) {
        let painted = part.totals().iter().any(|&total| total > 0);
        self.tiles[tile.row * self.tile_columns + tile.column] = painted.then_some(part);
    }

    /// Sets each cell of `heights` to `change(height, volume)`, with the volume of this layer's
    /// paint in that cell. We leave cells of tiles without paint alone.
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

/// Paint of a tile, one list of amounts for each slot and, last, for the vehicle. We leave out a
/// list without paint.
#[derive(Debug, Clone)]
pub(super) struct SavedTile {
    width: usize,
    height: usize,
    amounts: [Option<Box<[u32]>>; SLOTS + 1],
}

impl SavedTile {
    pub(super) fn of(paint: &Layer) -> Self {
        let totals = paint.totals();
        let amounts = std::array::from_fn(|slot| {
            (totals[slot] > 0).then(|| match slot {
                SLOTS => paint.vehicle.values().into(),
                _ => paint.pigments.values().iter().map(|cell| cell[slot]).collect(),
            })
        });
        Self { width: paint.width(), height: paint.height(), amounts }
    }

    pub(super) fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    pub(super) fn cell(&self, index: usize) -> Cell {
        let [pigments @ .., vehicle] =
            self.amounts.each_ref().map(|list| list.as_ref().map_or(0, |list| list[index]));
        Cell { pigments, vehicle }
    }
}

/// Paint on a head, and the means that its coat follows.
#[derive(Debug, Clone)]
pub(super) struct HeadPaint {
    pub(super) cells: Columns,
    /// For each cell, the mean volume in quanta of its hair when paint last flowed along it.
    pub(super) means: Vec<u32>,
}

impl HeadPaint {
    pub(super) fn new(layer: Layer) -> Self {
        let cells = Columns::new(layer);
        Self { means: vec![0; cells.volume().len()], cells }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_replaces_paint_by_paint_and_by_bare_canvas() {
        let paint = Cell { pigments: [3; SLOTS], vehicle: 5 };
        let mut full = Layer::empty(200, 3);
        let mut part = Layer::empty(150, 2);
        (0..600).for_each(|index| full.set_cell(index, paint));
        let alone = Cell { pigments: [0; SLOTS], vehicle: 7 };
        part.set_cell(149, alone);
        for before in [full, Layer::empty(200, 3)] {
            let mut columns = Columns::new(before.clone());
            columns.put((40, 1), &part);
            for index in 0..600 {
                let x = index % 200;
                let y = index / 200;
                let inside = (40..190).contains(&x) && y >= 1;
                let wanted = match (x, y) {
                    (189, 1) => alone,
                    _ if inside => Cell::default(),
                    _ => before.cell(index),
                };
                assert_eq!(columns.cell(index), wanted, "({x}, {y})");
                assert_eq!(columns.volume()[index], wanted.volume(), "({x}, {y})");
            }
        }
    }

    #[test]
    fn a_saved_tile_has_every_amount_and_no_list_without_paint() {
        let mut paint = Layer::empty(5, 3);
        for index in 0..15 {
            let mut cell = Cell { vehicle: index as u32, ..Cell::default() };
            cell.pigments[2] = 7 * index as u32;
            cell.pigments[7] = u32::from(index == 14);
            paint.set_cell(index, cell);
        }
        let saved = SavedTile::of(&paint);
        assert_eq!(saved.size(), (5, 3));
        for index in 0..15 {
            assert_eq!(saved.cell(index), paint.cell(index), "cell {index}");
        }
        let lists = saved.amounts.iter().filter(|list| list.is_some()).count();
        assert_eq!(lists, 3, "two pigments and the vehicle");
    }
}
