//! Collects the maps of a shard row after row, packs them chunk by chunk, and writes the shard.

use std::ops::Range;

use rayon::prelude::*;

use super::arrays::MapArray;
use super::create::{MapStore, write};
use super::error::StoreError;
use super::tiles::Shard;
use crate::pixel_maps::BlockMaps;
use crate::zarr::{ShardBuilder, packed};

/// Chunks of one array that stand beside each other and are being filled.
#[derive(Debug)]
struct Row {
    array: MapArray,
    /// Bytes of each chunk.
    chunks: Vec<Vec<u8>>,
    shard: ShardBuilder,
}

/// A shard that is being made. Memory is that of one row of chunks and of the packed chunks.
#[derive(Debug)]
pub struct ShardWriter<'s> {
    store: &'s MapStore,
    shard: Shard,
    rows: Vec<Row>,
    /// Next row of the scan.
    next: usize,
}

impl MapStore {
    /// Begins a shard, which is written when it is finished.
    #[must_use]
    pub fn writer(&self, shard: &Shard) -> ShardWriter<'_> {
        let tiles = self.tiles();
        let chunks = tiles.down.chunks * tiles.across.chunks;
        let rows = MapArray::ALL
            .map(|array| Row { array, chunks: Vec::new(), shard: ShardBuilder::new(chunks) })
            .into_iter()
            .collect();
        ShardWriter { store: self, shard: shard.clone(), rows, next: shard.rows.start }
    }
}

impl ShardWriter<'_> {
    /// Adds the maps of the next rows, over all columns of the shard.
    ///
    /// # Errors
    /// [`StoreError::Maps`] if the rows do not follow the rows before, or sizes do not fit.
    pub fn add(&mut self, rows: Range<usize>, maps: &BlockMaps) -> Result<(), StoreError> {
        let width = self.shard.columns.len();
        let fits = maps.is_consistent()
            && maps.pigments == self.store.pigments()
            && maps.pixels() == rows.len() * width;
        if !fits || rows.start != self.next || rows.end > self.shard.rows.end {
            return Err(self.fault(format!(
                "maps of rows {} to {} hold {} pixels and {} pigments, expected {width} pixels a row from row {} on and {} pigments",
                rows.start,
                rows.end,
                maps.pixels(),
                maps.pigments,
                self.next,
                self.store.pigments()
            )));
        }
        let chunk = self.store.tiles().down.chunk;
        let mut start = rows.start;
        while start < rows.end {
            // Rows up to the end of this row of chunks.
            let inside = start - self.shard.rows.start;
            let end = (start + chunk - inside % chunk).min(rows.end);
            self.fill(inside % chunk, maps, (start - rows.start)..(end - rows.start));
            if (end - self.shard.rows.start).is_multiple_of(chunk) || end == self.shard.rows.end {
                self.pack(inside / chunk)?;
            }
            start = end;
        }
        self.next = rows.end;
        Ok(())
    }

    /// Puts rows of `maps` into the chunks, from their row `top` on.
    fn fill(&mut self, top: usize, maps: &BlockMaps, rows: Range<usize>) {
        let across = self.store.tiles().across;
        let down = self.store.tiles().down;
        let width = self.shard.columns.len();
        let count = width.div_ceil(across.chunk);
        let pigments = maps.pigments;
        self.rows.par_iter_mut().for_each(|row| {
            let array = row.array;
            let numbers = if array.is_of_pigments() { pigments } else { 1 };
            let pixel = numbers * array.bytes();
            if row.chunks.is_empty() {
                let fill = array.fill_bytes().repeat(across.chunk * down.chunk * numbers);
                row.chunks = vec![fill; count];
            }
            for line in rows.clone() {
                let top = top + line - rows.start;
                for (at, chunk) in row.chunks.iter_mut().enumerate() {
                    let columns = at * across.chunk..((at + 1) * across.chunk).min(width);
                    let pixels = line * width + columns.start..line * width + columns.end;
                    let stored = &mut chunk[top * across.chunk * pixel..][..pixels.len() * pixel];
                    array.store(maps, pixels, stored);
                }
            }
        });
    }

    /// Packs the chunks of the row `down` of chunks.
    fn pack(&mut self, down: usize) -> Result<(), StoreError> {
        let across = self.store.tiles().across.chunks;
        let results: Vec<std::io::Result<()>> = self
            .rows
            .par_iter_mut()
            .map(|row| {
                let chunks = std::mem::take(&mut row.chunks);
                let stored: Vec<_> = chunks.par_iter().map(|chunk| packed(chunk)).collect();
                for (at, chunk) in stored.into_iter().enumerate() {
                    row.shard.add(down * across + at, &chunk?);
                }
                Ok(())
            })
            .collect();
        let result: std::io::Result<()> = results.into_iter().collect();
        result.map_err(|error| self.fault(format!("maps cannot be packed: {error}")))
    }

    /// Writes the shard, the mask last.
    ///
    /// # Errors
    /// [`StoreError::Shard`] if a file cannot be written, [`StoreError::Maps`] if rows are missing.
    pub fn finish(self) -> Result<(), StoreError> {
        if self.next != self.shard.rows.end {
            return Err(
                self.fault(format!("the maps of {} end before row {}", self.shard, self.next))
            );
        }
        for row in self.rows {
            let file = self.store.file(row.array, &self.shard);
            write(&file, &row.shard.finish()).map_err(|source| StoreError::Shard {
                path: self.store.path().to_owned(),
                shard: self.shard.clone(),
                source,
            })?;
        }
        Ok(())
    }

    fn fault(&self, problem: String) -> StoreError {
        StoreError::Maps { path: self.store.path().to_owned(), problem }
    }
}
