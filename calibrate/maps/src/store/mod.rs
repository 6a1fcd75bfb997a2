//! Maps on the disk. They are a Zarr group that you can open with xarray. We write it shard by
//! shard.
//!
//! We write a shard in one piece and its mask last, so a shard with a mask is finished. So you can
//! end a run at any moment and resume it, and several processes can write one store.

mod arrays;
mod create;

use std::ops::Range;
use std::path::{Path, PathBuf};

use documents::file::FileError;
use rayon::prelude::*;
use serde_json::{Map, Value};

use crate::numbers::{ByteOrder, NumberType};
use crate::pixel_maps::{BlockMaps, Mask, presence_of};
use crate::zarr::{ChunkError, ZarrArray};
use arrays::{MapArray, Tiles};
use create::shard_file;

pub use crate::pixel_maps::MapsAbout;
pub use arrays::{Shard, StoreError};
pub(crate) use create::{GROUP, entries, names, text, write};
pub use create::{MapStore, ShardWriter, StoreMode};

/// We accept at most this many shards, 4 Tpixel, so that a description alone cannot take much
/// memory.
const MOST_SHARDS: usize = 1 << 20;
/// Pixels along each side of a shard.
const SIDE: usize = 2048;

/// Finished maps on the disk.
#[derive(Debug)]
pub struct StoredMaps {
    path: PathBuf,
    pigments: Vec<String>,
    rows: Range<usize>,
    columns: Range<usize>,
    attributes: Map<String, Value>,
    arrays: Vec<(MapArray, ZarrArray)>,
}

impl StoredMaps {
    /// Opens the finished maps at `path`.
    ///
    /// # Errors
    /// [`StoreError`] if the folder does not hold maps, or shards are missing.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        let path = path.as_ref();
        let file = path.join(GROUP);
        let damaged = |problem: String| StoreError::Damaged { path: file.clone(), problem };
        let bytes = documents::file::read(&file)?;
        let group: Value = serde_json::from_slice(&bytes)
            .map_err(|error| damaged(format!("is not JSON: {error}")))?;
        let attributes = group["attributes"].as_object().cloned().unwrap_or_default();
        let [rows, columns] = ["rows", "columns"].map(|key| -> Option<Range<usize>> {
            let ends = attributes.get(key)?.as_array()?;
            let [start, end] = [0, 1].map(|at| usize::try_from(ends.get(at)?.as_u64()?).ok());
            Some(start?..end?)
        });
        let names = attributes.get("pigments").and_then(Value::as_array).map(|names| {
            names.iter().map(|name| name.as_str().unwrap_or_default().to_owned()).collect()
        });
        let (Some(pigments), Some(rows), Some(columns)) = (names, rows, columns) else {
            return Err(damaged("describes no pigment maps".to_owned()));
        };
        let pigments: Vec<String> = pigments;
        let mut arrays = Vec::new();
        for array in MapArray::ALL {
            let about = &group["consolidated_metadata"]["metadata"][array.name()];
            let opened = ZarrArray::new(&path.join(array.name()), about)
                .map_err(|fault| damaged(format!("`{}` {}", array.name(), fault.problem)))?;
            let mut shape = vec![rows.len(), columns.len()];
            shape.extend(array.is_of_pigments().then_some(pigments.len()));
            if opened.about.shape != shape || opened.about.number_type.bytes() != array.bytes() {
                let found = &opened.about.shape;
                return Err(damaged(format!(
                    "`{}` has the shape {found:?}, expected {shape:?}",
                    array.name()
                )));
            }
            let chain = &opened.about.chain;
            let is_own = chain.transpose.is_none()
                && chain.byte_order == ByteOrder::Little
                && opened.about.chunk.get(2).is_none_or(|each| *each == pigments.len());
            if !is_own {
                let name = array.name();
                let problem = format!("`{name}` is stored in another order than maps are");
                return Err(damaged(problem));
            }
            arrays.push((array, opened));
        }
        let count = rows.len().div_ceil(SIDE).saturating_mul(columns.len().div_ceil(SIDE));
        if count > MOST_SHARDS {
            let problem = format!("describes {count} shards, more than {MOST_SHARDS}");
            return Err(damaged(problem));
        }
        let shards = Tiles::new(rows.len(), columns.len()).shards((rows.start, columns.start));
        let missing = shards
            .iter()
            .filter(|shard| !shard_file(path, MapArray::Mask, shard).is_file())
            .count();
        if missing > 0 {
            let path = path.to_owned();
            return Err(StoreError::Unfinished { path, missing, shards: shards.len() });
        }
        Ok(Self { path: path.to_owned(), pigments, rows, columns, attributes, arrays })
    }

    /// Path of the store.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the pigments or groups.
    #[must_use]
    pub fn pigments(&self) -> &[String] {
        &self.pigments
    }

    /// Rows of the scan that are mapped.
    #[must_use]
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// Columns of the scan that are mapped.
    #[must_use]
    pub fn columns(&self) -> Range<usize> {
        self.columns.clone()
    }

    /// Attributes of the store: hashes, settings, version.
    #[must_use]
    pub fn attributes(&self) -> &Map<String, Value> {
        &self.attributes
    }

    /// Reads the maps of a rectangle of pixels. Pass rows and columns of the scan.
    ///
    /// # Errors
    /// [`StoreError`] if the rectangle is not mapped, or we cannot read a shard.
    pub fn read(&self, rows: Range<usize>, columns: Range<usize>) -> Result<BlockMaps, StoreError> {
        if !inside(&rows, &self.rows) || !inside(&columns, &self.columns) {
            let problem = format!(
                "rows {} to {} and columns {} to {} are not mapped, only rows {} to {} and columns {} to {}",
                rows.start,
                rows.end,
                columns.start,
                columns.end,
                self.rows.start,
                self.rows.end,
                self.columns.start,
                self.columns.end
            );
            return Err(StoreError::Maps { path: self.path.clone(), problem });
        }
        let pixels = rows.len() * columns.len();
        let mut maps = BlockMaps::without_values(pixels, self.pigments.len(), Mask::Ignored);
        let rows = rows.start - self.rows.start..rows.end - self.rows.start;
        let columns = columns.start - self.columns.start..columns.end - self.columns.start;
        for (array, opened) in &self.arrays {
            let bytes = stored(opened, &rows, &columns)?;
            let floats = |kind: NumberType, values: &mut Vec<f32>| {
                kind.convert(ByteOrder::Little, &bytes, values, 1);
            };
            match array {
                MapArray::Share => floats(NumberType::F16, &mut maps.share),
                MapArray::ShareSd => floats(NumberType::F16, &mut maps.share_sd),
                MapArray::Chi2 => floats(NumberType::F32, &mut maps.chi2),
                MapArray::Rms => floats(NumberType::F32, &mut maps.rms),
                MapArray::Presence => {
                    for (value, byte) in maps.presence.iter_mut().zip(&bytes) {
                        *value = presence_of(*byte);
                    }
                }
                MapArray::Second => {
                    for (value, bytes) in maps.second.iter_mut().zip(bytes.as_chunks().0) {
                        *value = u64::from_le_bytes(*bytes);
                    }
                }
                MapArray::Mask => {
                    for (mask, byte) in maps.mask.iter_mut().zip(&bytes) {
                        *mask = Mask::from_code(*byte).ok_or_else(|| StoreError::Damaged {
                            path: opened.folder.clone(),
                            problem: format!("holds the mask `{byte}`, which has no meaning"),
                        })?;
                    }
                }
            }
        }
        Ok(maps)
    }
}

fn inside(part: &Range<usize>, whole: &Range<usize>) -> bool {
    part.start <= part.end && part.start >= whole.start && part.end <= whole.end
}

/// Reads the bytes of a rectangle of an array.
fn stored(
    array: &ZarrArray,
    rows: &Range<usize>,
    columns: &Range<usize>,
) -> Result<Vec<u8>, StoreError> {
    let about = &array.about;
    let down = about.chunk[0];
    let across = about.chunk[1];
    let numbers = about.chunk.get(2).copied().unwrap_or(1);
    let pixel = numbers * about.number_type.bytes();
    let mut bytes = vec![0; rows.len() * columns.len() * pixel];
    if bytes.is_empty() {
        return Ok(bytes);
    }
    let places: Vec<(usize, usize)> = (rows.start / down..=(rows.end - 1) / down)
        .flat_map(|row| {
            (columns.start / across..=(columns.end - 1) / across).map(move |c| (row, c))
        })
        .collect();
    let chunks: Result<Vec<_>, ChunkError> = places
        .par_iter()
        .map(|&(row, column): &(usize, usize)| {
            let at = [row, column, 0];
            array.chunk(&at[..about.shape.len()]).map(|chunk| ((row, column), chunk))
        })
        .collect();
    for ((row, column), chunk) in chunks.map_err(store_error)? {
        let Some(chunk) = chunk else {
            return Err(StoreError::Damaged {
                path: array.folder.clone(),
                problem: format!("the chunk {row}, {column} is missing"),
            });
        };
        let from = (column * across).max(columns.start);
        let to = ((column + 1) * across).min(columns.end);
        for line in (row * down).max(rows.start)..((row + 1) * down).min(rows.end) {
            let inside = ((line - row * down) * across + from - column * across) * pixel;
            let place = ((line - rows.start) * columns.len() + from - columns.start) * pixel;
            let length = (to - from) * pixel;
            bytes[place..place + length].copy_from_slice(&chunk[inside..inside + length]);
        }
    }
    Ok(bytes)
}

fn store_error(error: ChunkError) -> StoreError {
    match error {
        ChunkError::Io(path, reason) => FileError::reading(&path, reason).into(),
        ChunkError::Fault(path, fault) => StoreError::Damaged { path, problem: fault.problem },
    }
}
