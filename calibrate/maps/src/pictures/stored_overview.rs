//! Overviews of maps on the disk.

use super::overview::{Overview, OverviewSums};
use crate::store::{StoreError, StoredMaps};

/// Rows and columns that are read at once, so that wide scans take no more memory than others.
const ROWS: usize = 256;
const COLUMNS: usize = 2048;

impl Overview {
    /// Reads all of `maps`, with at most `longest` squares along the longer side.
    ///
    /// # Errors
    /// [`StoreError`] if a shard cannot be read.
    pub fn of(maps: &StoredMaps, longest: usize) -> Result<Self, StoreError> {
        let rows = maps.rows();
        let columns = maps.columns();
        let mut sums = OverviewSums::new(maps.pigments(), (rows.len(), columns.len()), longest);
        for start in rows.clone().step_by(ROWS) {
            let end = (start + ROWS).min(rows.end);
            for left in columns.clone().step_by(COLUMNS) {
                let right = (left + COLUMNS).min(columns.end);
                let block = maps.read(start..end, left..right)?;
                let inside = |from: usize, to: usize, first: usize| from - first..to - first;
                let across = inside(left, right, columns.start);
                sums.add(inside(start, end, rows.start), across, &block);
            }
        }
        Ok(sums.finish())
    }
}
