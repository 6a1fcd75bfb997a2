//! Maps a cube shard by shard, in bounded memory, and writes the maps to the disk.

use std::error::Error;
use std::path::Path;

use documents::{Task, hint::Explain};

use crate::cube::{Block, Cube, CubeError};
use crate::pixel_maps::{BlockMaps, MapError};
use crate::store::{MapStore, Shard, StoreError, StoreMode};
use crate::surveyed::SurveyedScan;

pub use crate::pixel_maps::PixelCounts;

/// We read this many bytes of values at once. Together with the maps of a shard, a run stays below
/// 1 GB.
const BLOCK_BYTES: usize = 192 << 20;
/// Most pixels that are mapped at once, so that progress is reported often.
const MOST_PIXELS: usize = 256 * 2048;

/// Result of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MapOutcome {
    /// Number of pixels by mask in the shards that this run wrote.
    pub pixels: PixelCounts,
    /// Number of shards that were finished before this run.
    pub kept: usize,
    /// Number of shards that this run wrote.
    pub written: usize,
    /// Whether the run was cancelled.
    pub cancelled: bool,
}

/// A run failed. Shards that it wrote before are whole.
#[derive(Debug, thiserror::Error, Explain)]
pub enum RunError<E: Error + 'static> {
    /// The cube cannot be read.
    #[error(transparent)]
    Cube(#[from] CubeError),
    /// A block cannot be mapped.
    #[error(transparent)]
    Map(E),
    /// The maps cannot be written.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// Maps every shard of `store` that is not finished. `map` maps a block. We call it for one block
/// at a time, and it may use all threads. Its result must depend on each pixel alone, so that the
/// bytes of the store do not depend on the blocks.
///
/// After each block, `task` counts the pixels that are done, including finished shards. If it is
/// cancelled, the run ends after the block under way, and the shard under way is not written.
///
/// # Errors
/// [`RunError`] if the cube cannot be read, a block not mapped or a shard not written.
pub fn map_cube<E: Error + 'static>(
    cube: &Cube,
    store: &MapStore,
    map: impl Fn(&Block) -> Result<BlockMaps, E>,
    task: &Task,
) -> Result<MapOutcome, RunError<E>> {
    let shards = store.shards();
    let all = shards.iter().map(pixels).sum();
    let mut done = 0;
    let mut outcome =
        MapOutcome { pixels: PixelCounts::default(), kept: 0, written: 0, cancelled: false };
    for shard in shards {
        let before = done;
        done += pixels(shard);
        if store.is_finished(shard) {
            outcome.kept += 1;
            continue;
        }
        let found = map_shard_of(cube, store, shard, &map, (before, all), task)?;
        let Some(counts) = found else {
            outcome.cancelled = true;
            return Ok(outcome);
        };
        outcome.pixels.add_all(&counts);
        outcome.written += 1;
    }
    Ok(outcome)
}

fn pixels(shard: &Shard) -> u64 {
    shard.rows.len() as u64 * shard.columns.len() as u64
}

/// Maps one shard and writes it, whether it is finished or not. `task` counts the pixels of the shard that
/// are done after each block. If it is cancelled, nothing is written and the result is `None`.
///
/// # Errors
/// [`RunError`] if the cube cannot be read, a block not mapped or the shard not written.
pub fn map_shard<E: Error + 'static>(
    cube: &Cube,
    store: &MapStore,
    shard: &Shard,
    map: impl Fn(&Block) -> Result<BlockMaps, E>,
    task: &Task,
) -> Result<Option<PixelCounts>, RunError<E>> {
    map_shard_of(cube, store, shard, &map, (0, pixels(shard)), task)
}

/// Maps a shard as [`map_shard`] does. The run has `all` pixels, of which `before` are already done
/// when the shard begins. `task` counts on from there.
fn map_shard_of<E: Error + 'static>(
    cube: &Cube,
    store: &MapStore,
    shard: &Shard,
    map: &impl Fn(&Block) -> Result<BlockMaps, E>,
    (before, all): (u64, u64),
    task: &Task,
) -> Result<Option<PixelCounts>, RunError<E>> {
    let width = shard.columns.len();
    let rows = cube.rows_within(BLOCK_BYTES, width).min((MOST_PIXELS / width).max(1));
    let mut writer = store.writer(shard);
    let mut counts = PixelCounts::default();
    let mut block = Block::default();
    let mut start = shard.rows.start;
    while start < shard.rows.end {
        let end = (start + rows).min(shard.rows.end);
        cube.read_into(start..end, shard.columns.clone(), &mut block)?;
        let maps = map(&block).map_err(RunError::Map)?;
        writer.add(start..end, &maps)?;
        counts.add(&maps.mask);
        start = end;
        let done = (end - shard.rows.start) as u64 * width as u64;
        task.done(before + done, all);
        if task.is_cancelled() {
            return Ok(None);
        }
    }
    // A shard of another scan is never finished.
    cube.check_unchanged()?;
    writer.finish()?;
    Ok(Some(counts))
}

impl SurveyedScan {
    /// Begins or resumes the maps at `path`.
    ///
    /// # Errors
    /// [`StoreError`] if the folder holds anything but maps of this run, or we cannot write it.
    pub fn store(&self, path: impl AsRef<Path>, mode: StoreMode) -> Result<MapStore, StoreError> {
        MapStore::create(path, self.about(), mode)
    }

    /// Maps every shard that is not finished, on all cores and in bounded memory. `task` counts the
    /// pixels that are done. If it is cancelled, the run ends, and the shard under way is not written.
    ///
    /// # Errors
    /// [`RunError`] if the scan cannot be read or the maps not be written.
    pub fn map(&self, store: &MapStore, task: &Task) -> Result<MapOutcome, RunError<MapError>> {
        map_cube(self.cube(), store, |block| self.map_block(block), task)
    }

    /// Maps the shard with the index `place` in the store, unless it is finished. `task` counts the
    /// pixels of the shard that are done. You get `None` if the store has no such shard, it was
    /// finished before, or `task` was cancelled.
    ///
    /// # Errors
    /// [`RunError`] if the scan cannot be read or the shard not be written.
    pub fn map_shard(
        &self,
        store: &MapStore,
        place: usize,
        task: &Task,
    ) -> Result<Option<PixelCounts>, RunError<MapError>> {
        match store.shards().get(place) {
            Some(shard) if !store.is_finished(shard) => {
                map_shard(self.cube(), store, shard, |block| self.map_block(block), task)
            }
            _ => Ok(None),
        }
    }
}
