//! The processor stores paint here: columns with their volume beside them, sparse dry layers, tiles
//! saved for undo, and the paint on a head.
//!
//! We store the volume of every cell, so that the penetration of the head need not sum the
//! pigments.

use graphics::field::Field;
use graphics::tile::{Rect, TILE, Tile, TileSet};

use crate::layer::{Cell, FilmRow, Layer, SLOTS};

/// A layer and the volume of each of its cells. 40 bytes a cell, 80 with a skin.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    /// Paint of the body.
    layer: Layer,
    /// Volume of body and skin.
    volume: Vec<u32>,
    /// `None` until a cell gets a skin.
    skin: Option<Skin>,
}

/// The skin over the body of all cells. The system only takes memory where there is one.
#[derive(Debug, Clone)]
struct Skin {
    layer: Layer,
    volume: Vec<u32>,
}

impl Skin {
    fn empty((width, height): (usize, usize)) -> Self {
        Self { layer: Layer::empty(width, height), volume: vec![0; width * height] }
    }
}

impl Columns {
    pub(super) fn new(mut layer: Layer) -> Self {
        let skin = layer.skin.take();
        // The system only takes memory of zeros where we write to it.
        let mut volume = vec![0; layer.vehicle.values().len()];
        for (index, volume) in volume.iter_mut().enumerate() {
            let found = layer.cell(index).volume();
            if found > 0 {
                *volume = found;
            }
        }
        let mut columns = Self { layer, volume, skin: None };
        if let Some(skin) = skin.filter(|skin| skin.totals().iter().any(|&total| total > 0)) {
            let size = (skin.width(), skin.height());
            let own = columns.skin.get_or_insert_with(|| Skin::empty(size));
            for index in 0..own.volume.len() {
                let cell = skin.cell(index);
                if cell.volume() > 0 {
                    own.layer.set_cell(index, cell);
                    own.volume[index] = cell.volume();
                    columns.volume[index] += cell.volume();
                }
            }
        }
        columns
    }

    /// The body as a layer.
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
        let mut part = copied(&self.layer, &self.volume, rect);
        if let Some(Skin { layer, volume }) = self.skin.as_ref().filter(|_| self.has_skin(rect)) {
            part.skin = Some(Box::new(copied(layer, volume, rect)));
        }
        part
    }

    /// Volumes of all cells in quanta.
    pub(super) fn volume(&self) -> &[u32] {
        &self.volume
    }

    /// Volumes of the skin of all cells in quanta. `None` if no cell has one.
    pub(super) fn skin_volume(&self) -> Option<&[u32]> {
        self.skin.as_ref().map(|skin| skin.volume.as_slice())
    }

    /// Whether a cell of `rect` has a skin.
    pub(super) fn has_skin(&self, rect: Rect) -> bool {
        self.skin.as_ref().is_some_and(|skin| painted(&skin.volume, self.width(), rect))
    }

    /// The skin of `width` cells from column `x` of row `y`. `None` if they have none.
    pub(super) fn skin_row(&self, y: usize, x: usize, width: usize) -> Option<FilmRow<'_>> {
        let Skin { layer, volume } = self.skin.as_ref()?;
        let here = &volume[y * layer.width() + x..][..width];
        has_paint(here).then(|| layer.row(y, x, width))
    }

    /// The paint of both films of a cell.
    #[inline(always)]
    pub(super) fn cell(&self, index: usize) -> Cell {
        let [body, skin] = self.films(index);
        body.plus(&skin)
    }

    /// The body and the skin of a cell.
    #[inline(always)]
    pub(super) fn films(&self, index: usize) -> [Cell; 2] {
        let skin = self.skin.as_ref().filter(|skin| skin.volume[index] > 0);
        [self.layer.cell(index), skin.map_or_else(Cell::default, |skin| skin.layer.cell(index))]
    }

    /// Replaces the paint of a cell by a body without a skin.
    #[inline(always)]
    pub(super) fn set_cell(&mut self, index: usize, cell: Cell) {
        self.set_films(index, [cell, Cell::default()]);
    }

    #[inline(always)]
    pub(super) fn set_films(&mut self, index: usize, [body, skin]: [Cell; 2]) {
        self.layer.set_cell(index, body);
        let above = skin.volume();
        self.volume[index] = body.volume() + above;
        if above > 0 {
            self.begin_skin();
        }
        if let Some(own) = self.skin.as_mut().filter(|own| above > 0 || own.volume[index] > 0) {
            own.layer.set_cell(index, skin);
            own.volume[index] = above;
        }
    }

    /// Lets all cells have a skin.
    pub(super) fn begin_skin(&mut self) {
        let size = (self.layer.width(), self.layer.height());
        self.skin.get_or_insert_with(|| Skin::empty(size));
    }

    /// Replaces the cells under `part`. Its upper left cell goes to column `x` of row `y`. Where
    /// neither has paint, we write nothing, so that this does not take memory.
    pub(super) fn put(&mut self, (x, y): (usize, usize), part: &Layer) {
        let width = self.layer.width();
        for row in 0..part.height() {
            for column in (0..part.width()).step_by(TILE) {
                let count = TILE.min(part.width() - column);
                let first = (y + row) * width + x + column;
                let from = row * part.width() + column;
                let bare = !has_paint(&self.volume[first..][..count]);
                if bare && (from..from + count).all(|index| part.cell(index).volume() == 0) {
                    continue;
                }
                for offset in 0..count {
                    self.set_films(first + offset, part.films(from + offset));
                }
            }
        }
    }

    /// Mutable access to `count` rows from row `first` on.
    pub(super) fn rows(&mut self, first: usize, count: usize) -> Rows<'_> {
        let width = self.layer.width();
        let cells = first * width..(first + count) * width;
        let Self { layer, volume, skin } = self;
        let body = Planes::of(layer, volume, cells.clone());
        let skin = skin.as_mut().map(|Skin { layer, volume }| Planes::of(layer, volume, cells));
        Rows { first, width, body, skin }
    }
}

/// Whether any of the volumes is above 0.
#[inline(always)]
pub(super) fn has_paint(volumes: &[u32]) -> bool {
    volumes.iter().fold(0, |all, volume| all | volume) > 0
}

/// Whether a cell of `rect` has paint on a canvas `width` cells wide.
fn painted(volume: &[u32], width: usize, rect: Rect) -> bool {
    (rect.y..rect.y + rect.height).any(|y| has_paint(&volume[y * width + rect.x..][..rect.width]))
}

/// Copies the tiles of one film that have paint in `rect`.
fn copied(layer: &Layer, volume: &[u32], rect: Rect) -> Layer {
    let bounds = layer.vehicle.bounds();
    assert_eq!(rect.intersection(bounds), rect, "a rectangle must lie within {bounds:?}");
    let mut part = Layer::empty(rect.width, rect.height);
    let mut covered = TileSet::default();
    covered.insert(rect);
    for tile in covered.iter() {
        let inside = tile.rect(bounds).intersection(rect);
        if painted(volume, bounds.width, inside) {
            part.put((inside.x - rect.x, inside.y - rect.y), &layer.part(inside));
        }
    }
    part
}

/// Consecutive rows of a canvas. One thread changes them.
#[derive(Debug)]
pub(super) struct Rows<'a> {
    first: usize,
    width: usize,
    /// The body, with the volumes of body and skin.
    body: Planes<'a>,
    /// The skin, with its own volumes.
    skin: Option<Planes<'a>>,
}

/// Consecutive cells of a film and their volumes. The slices have one length.
#[derive(Debug)]
pub(super) struct Planes<'a> {
    pub(super) pigments: &'a mut [[u32; SLOTS]],
    pub(super) vehicle: &'a mut [u32],
    pub(super) volume: &'a mut [u32],
}

impl<'a> Planes<'a> {
    fn of(layer: &'a mut Layer, volume: &'a mut [u32], cells: std::ops::Range<usize>) -> Self {
        Self {
            pigments: &mut layer.pigments.values_mut()[cells.clone()],
            vehicle: &mut layer.vehicle.values_mut()[cells.clone()],
            volume: &mut volume[cells],
        }
    }

    fn split(&mut self, cells: usize) -> (Planes<'_>, Planes<'_>) {
        let (pigments, pigments_below) = self.pigments.split_at_mut(cells);
        let (vehicle, vehicle_below) = self.vehicle.split_at_mut(cells);
        let (volume, volume_below) = self.volume.split_at_mut(cells);
        let below =
            Planes { pigments: pigments_below, vehicle: vehicle_below, volume: volume_below };
        (Planes { pigments, vehicle, volume }, below)
    }

    #[inline(always)]
    fn part(&mut self, start: usize, count: usize) -> Planes<'_> {
        Planes {
            pigments: &mut self.pigments[start..][..count],
            vehicle: &mut self.vehicle[start..][..count],
            volume: &mut self.volume[start..][..count],
        }
    }
}

impl Rows<'_> {
    /// Splits into the rows above row `y` and the rest.
    pub(super) fn split(&mut self, y: usize) -> (Rows<'_>, Rows<'_>) {
        let cells = (y - self.first) * self.width;
        let Self { first, width, ref mut body, ref mut skin } = *self;
        let (body, body_below) = body.split(cells);
        let (skin, skin_below) = skin.as_mut().map(|skin| skin.split(cells)).unzip();
        let above = Rows { first, width, body, skin };
        (above, Rows { first: y, width, body: body_below, skin: skin_below })
    }

    /// The cells `x..x + width` of row `y`.
    #[inline(always)]
    pub(super) fn row(&mut self, y: usize, x: usize, width: usize) -> Row<'_> {
        let start = (y - self.first) * self.width + x;
        Row {
            body: self.body.part(start, width),
            skin: self.skin.as_mut().map(
                #[inline(always)]
                |skin| skin.part(start, width),
            ),
        }
    }
}

/// Consecutive cells of one row.
#[derive(Debug)]
pub(super) struct Row<'a> {
    /// The body, with the volumes of body and skin.
    pub(super) body: Planes<'a>,
    /// The skin, with its own volumes. `None` if no cell of the canvas has one.
    pub(super) skin: Option<Planes<'a>>,
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

/// Paint of a tile, one list of amounts for each slot and, last, for the vehicle, of the body and
/// then of the skin. We leave out a list without paint.
#[derive(Debug, Clone)]
pub(super) struct SavedTile {
    width: usize,
    height: usize,
    amounts: [[Option<Box<[u32]>>; SLOTS + 1]; 2],
}

impl SavedTile {
    pub(super) fn of(paint: &Layer) -> Self {
        let mut amounts = [const { [const { None }; SLOTS + 1] }; 2];
        for (amounts, film) in amounts.iter_mut().zip(paint.single_films()) {
            *amounts = lists(film);
        }
        Self { width: paint.width(), height: paint.height(), amounts }
    }

    pub(super) fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    pub(super) fn films(&self, index: usize) -> [Cell; 2] {
        self.amounts.each_ref().map(|film| {
            let [pigments @ .., vehicle] =
                film.each_ref().map(|list| list.as_ref().map_or(0, |list| list[index]));
            Cell { pigments, vehicle }
        })
    }
}

/// Amounts of one film of a layer, one list for each slot that has paint.
fn lists(film: &Layer) -> [Option<Box<[u32]>>; SLOTS + 1] {
    std::array::from_fn(|slot| {
        let list: Box<[u32]> = match slot {
            SLOTS => film.vehicle.values().into(),
            _ => film.pigments.values().iter().map(|cell| cell[slot]).collect(),
        };
        has_paint(&list).then_some(list)
    })
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
            assert_eq!(saved.films(index), paint.films(index), "cell {index}");
        }
        let lists = saved.amounts.iter().flatten().filter(|list| list.is_some()).count();
        assert_eq!(lists, 3, "two pigments and the vehicle");
        let skin = Cell { vehicle: 5, ..Cell::default() };
        paint.set_films(3, [paint.cell(3), skin]);
        assert_eq!(SavedTile::of(&paint).films(3), paint.films(3), "with a skin");
    }
}
