//! Runs that write the maps of a surveyed scan to the disk, shard by shard.

use std::ops::ControlFlow;
use std::path::Path;

use crate::blocks::{MapOutcome, MapProgress, PixelCounts, RunError, map_cube, map_shard};
use crate::map_error::MapError;
use crate::store::{MapStore, StoreError, StoreMode};
use crate::surveyed::SurveyedScan;

impl SurveyedScan {
    /// Begins or resumes the maps at `path`.
    ///
    /// # Errors
    /// [`StoreError`] if the folder holds anything else than maps of this run, or cannot be written.
    pub fn store(&self, path: impl AsRef<Path>, mode: StoreMode) -> Result<MapStore, StoreError> {
        MapStore::create(path, self.about(), mode)
    }

    /// Maps every shard that is not finished, on all cores and in bounded memory. `progress` is called after
    /// each block; if it breaks, the run ends, and the shard under way is not written.
    ///
    /// # Errors
    /// [`RunError`] if the scan cannot be read or the maps not be written.
    pub fn map(
        &self,
        store: &MapStore,
        progress: impl FnMut(MapProgress) -> ControlFlow<()>,
    ) -> Result<MapOutcome, RunError<MapError>> {
        map_cube(self.cube(), store, |block| self.map_block(block), progress)
    }

    /// Maps the shard at `place` in the order of the store, unless it is finished. `None` if it was, or if
    /// `progress`, called after each block with the number of finished pixels, broke.
    ///
    /// # Errors
    /// [`RunError`] if the scan cannot be read or the shard not be written.
    pub fn map_shard(
        &self,
        store: &MapStore,
        place: usize,
        progress: impl FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Option<PixelCounts>, RunError<MapError>> {
        match store.shards().get(place) {
            Some(shard) if !store.is_finished(shard) => {
                map_shard(self.cube(), store, shard, |block| self.map_block(block), progress)
            }
            _ => Ok(None),
        }
    }
}
