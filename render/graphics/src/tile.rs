//! Rectangles of cells, and the tiles of 64 x 64 cells by which we save and relight a canvas.

use std::collections::BTreeSet;

/// The width and height of a tile, in cells.
pub const TILE: usize = 64;

/// A rectangle of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Rect {
    /// The leftmost column, from 0.
    pub x: usize,
    /// The topmost row, from 0.
    pub y: usize,
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
}

impl Rect {
    /// Whether the rectangle has no cell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.width == 0 || self.height == 0
    }

    /// This rectangle with `margin` more cells on every side, clipped to `bounds`.
    #[must_use]
    pub fn grown(&self, margin: usize, bounds: Self) -> Self {
        let x = self.x.saturating_sub(margin).max(bounds.x);
        let y = self.y.saturating_sub(margin).max(bounds.y);
        let right = (self.x + self.width + margin).min(bounds.x + bounds.width);
        let bottom = (self.y + self.height + margin).min(bounds.y + bounds.height);
        Self { x, y, width: right.saturating_sub(x), height: bottom.saturating_sub(y) }
    }

    /// The cells that lie in both rectangles.
    #[must_use]
    pub fn intersection(&self, other: Self) -> Self {
        self.grown(0, other)
    }
}

/// A tile, given by its row and column in the grid of tiles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Tile {
    /// Row of the tile, from 0.
    pub row: usize,
    /// Column of the tile, from 0.
    pub column: usize,
}

impl Tile {
    /// The cells of the tile on a canvas of `bounds`. Tiles at the right and lower edge may be
    /// smaller than the others.
    #[must_use]
    pub fn rect(&self, bounds: Rect) -> Rect {
        let whole = Rect { x: self.column * TILE, y: self.row * TILE, width: TILE, height: TILE };
        whole.intersection(bounds)
    }
}

/// A set of tiles, in rows from the top.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TileSet {
    tiles: BTreeSet<Tile>,
}

impl TileSet {
    /// Every tile that a canvas of `bounds` has.
    #[must_use]
    pub fn all(bounds: Rect) -> Self {
        let mut set = Self::default();
        set.insert(bounds);
        set
    }

    /// The tiles of a canvas of `bounds` that contain a cell for which `has` is true. This passes
    /// `has` the index of a cell, counted row by row.
    #[must_use]
    pub fn with(bounds: Rect, has: impl Fn(usize) -> bool) -> Self {
        Self {
            tiles: Self::all(bounds)
                .tiles
                .into_iter()
                .filter(|tile: &Tile| {
                    let rect = tile.rect(bounds);
                    let rows = (rect.y..rect.y + rect.height).map(|y| y * bounds.width + rect.x);
                    rows.into_iter().any(|first| (first..first + rect.width).any(&has))
                })
                .collect(),
        }
    }

    /// Adds the tiles that `rect` touches.
    pub fn insert(&mut self, rect: Rect) {
        if rect.is_empty() {
            return;
        }
        for row in rect.y / TILE..=(rect.y + rect.height - 1) / TILE {
            for column in rect.x / TILE..=(rect.x + rect.width - 1) / TILE {
                self.tiles.insert(Tile { row, column });
            }
        }
    }

    /// Whether a tile under `rect` belongs to the set.
    #[must_use]
    pub fn meets(&self, rect: Rect) -> bool {
        let mut tiles = Self::default();
        tiles.insert(rect);
        tiles.iter().any(|tile| self.tiles.contains(&tile))
    }

    /// Adds one tile. Returns whether it was new.
    pub fn insert_tile(&mut self, tile: Tile) -> bool {
        self.tiles.insert(tile)
    }

    /// The tiles, in rows from the top.
    pub fn iter(&self) -> impl Iterator<Item = Tile> + '_ {
        self.tiles.iter().copied()
    }

    /// The smallest rectangle that contains all tiles, clipped to a canvas of `bounds`. This is
    /// empty if there is no tile.
    #[must_use]
    pub fn extent(&self, bounds: Rect) -> Rect {
        let tiles = self.tiles.iter().map(|tile| tile.rect(bounds));
        let whole = tiles.reduce(|a, b| {
            let x = a.x.min(b.x);
            let y = a.y.min(b.y);
            let right = (a.x + a.width).max(b.x + b.width);
            let bottom = (a.y + a.height).max(b.y + b.height);
            Rect { x, y, width: right - x, height: bottom - y }
        });
        whole.unwrap_or_default()
    }

    /// Number of tiles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.tiles.len()
    }

    /// Whether the set has no tile.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tiles.is_empty()
    }

    /// Removes all tiles and returns them.
    pub fn take(&mut self) -> Self {
        std::mem::take(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rect = Rect { x: 0, y: 0, width: 100, height: 70 };

    #[test]
    fn tiles_cover_a_canvas_once() {
        let set = TileSet::all(BOUNDS);
        let cells: usize =
            set.iter().map(|tile| tile.rect(BOUNDS)).map(|r| r.width * r.height).sum();
        assert_eq!((set.len(), cells), (4, 7000));
    }

    #[test]
    fn tiles_with_something_are_found_by_their_cells() {
        let set = TileSet::with(BOUNDS, |index| index == 63 * 100 + 64 || index == 69 * 100);
        let tiles: Vec<_> = set.iter().map(|tile| (tile.row, tile.column)).collect();
        assert_eq!(tiles, [(0, 1), (1, 0)]);
        assert_eq!(set.extent(BOUNDS), BOUNDS);
        assert!(TileSet::default().extent(BOUNDS).is_empty());
    }

    #[test]
    fn growth_stays_within_bounds() {
        let rect = Rect { x: 1, y: 60, width: 10, height: 5 };
        assert_eq!(rect.grown(8, BOUNDS), Rect { x: 0, y: 52, width: 19, height: 18 });
        assert!(rect.intersection(Rect { x: 50, y: 0, width: 5, height: 5 }).is_empty());
    }
}
