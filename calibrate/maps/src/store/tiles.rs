//! Division of the maps into shards and chunks.

use std::fmt;
use std::ops::Range;

/// Pixels of a chunk along each side.
const CHUNK: usize = 256;
/// Chunks of a shard along each side.
const CHUNKS: usize = 8;

/// A rectangle of pixels that is written at once.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shard {
    /// Number of the shard: from left to right, then down.
    pub index: usize,
    /// Rows of the scan.
    pub rows: Range<usize>,
    /// Columns of the scan.
    pub columns: Range<usize>,
    /// Row and column among the shards.
    pub(crate) at: (usize, usize),
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = &self.rows;
        let columns = &self.columns;
        write!(
            f,
            "rows {} to {} and columns {} to {}",
            rows.start,
            rows.end - 1,
            columns.start,
            columns.end - 1
        )
    }
}

/// Division of one axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Axis {
    pub(crate) length: usize,
    /// Pixels of a chunk.
    pub(crate) chunk: usize,
    /// Chunks of a shard.
    pub(crate) chunks: usize,
}

impl Axis {
    /// Divides `length` pixels.
    pub(crate) fn new(length: usize) -> Self {
        let chunk = CHUNK.min(length).max(1);
        Self { length, chunk, chunks: length.div_ceil(chunk).clamp(1, CHUNKS) }
    }

    /// Pixels of a shard.
    pub(crate) fn shard(self) -> usize {
        self.chunk * self.chunks
    }

    fn shards(self) -> usize {
        self.length.div_ceil(self.shard())
    }

    fn range(self, shard: usize, start: usize) -> Range<usize> {
        let end = ((shard + 1) * self.shard()).min(self.length);
        start + shard * self.shard()..start + end
    }
}

/// Division of the maps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Tiles {
    pub(crate) down: Axis,
    pub(crate) across: Axis,
}

impl Tiles {
    /// Divides maps of `rows` x `columns` pixels.
    pub(crate) fn new(rows: usize, columns: usize) -> Self {
        Self { down: Axis::new(rows), across: Axis::new(columns) }
    }

    /// All shards, of maps that begin at this row and column of the scan.
    pub(crate) fn shards(&self, (row, column): (usize, usize)) -> Vec<Shard> {
        let across = self.across.shards();
        (0..self.down.shards() * across)
            .map(|index: usize| {
                let at = (index / across, index % across);
                let rows = self.down.range(at.0, row);
                Shard { index, rows, columns: self.across.range(at.1, column), at }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_cover_every_pixel_once() {
        for (rows, columns) in [(1, 1), (255, 257), (2048, 2049), (5000, 300)] {
            let tiles = Tiles::new(rows, columns);
            let shards = tiles.shards((10, 20));
            let pixels: usize = shards.iter().map(|s| s.rows.len() * s.columns.len()).sum();
            assert_eq!(pixels, rows * columns, "{rows} x {columns}");
            let last = &shards[shards.len() - 1];
            assert_eq!((last.rows.end, last.columns.end), (rows + 10, columns + 20));
            assert!(shards.iter().enumerate().all(|(at, shard)| shard.index == at), "numbers");
            assert!(tiles.down.shard() <= 2048 && tiles.across.shard() <= 2048, "shards too large");
        }
    }

    #[test]
    fn small_maps_have_small_shards() {
        let tiles = Tiles::new(100, 300);
        assert_eq!((tiles.down.shard(), tiles.across.shard()), (100, 512));
        let shards = Tiles::new(5000, 2048).shards((0, 0));
        assert_eq!(shards[2].to_string(), "rows 4096 to 4999 and columns 0 to 2047");
    }
}
