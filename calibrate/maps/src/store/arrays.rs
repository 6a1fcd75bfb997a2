//! The arrays of stored maps: names, types, bytes, and how we divide them into shards and chunks.

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

use documents::file::FileError;
use documents::hint::{Explain, Hint};
use half::f16;
use serde_json::{Map, Value, json};

use crate::pixel_maps::{BlockMaps, Mask, NO_PRESENCE, PRESENCE_ONE, code_of, half_of};

/// Mask of a pixel that no run has mapped yet.
pub(crate) const NOT_YET: u8 = 255;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MapArray {
    Share,
    ShareSd,
    Presence,
    Chi2,
    Rms,
    Second,
    Mask,
}

impl MapArray {
    /// All arrays in the order in which a shard writes them. The mask comes last, so if you find
    /// it, the others are there too.
    pub(crate) const ALL: [Self; 7] = [
        Self::Share,
        Self::ShareSd,
        Self::Presence,
        Self::Chi2,
        Self::Rms,
        Self::Second,
        Self::Mask,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Share => "share",
            Self::ShareSd => "share_sd",
            Self::Presence => "presence",
            Self::Chi2 => "chi2",
            Self::Rms => "rms",
            Self::Second => "second",
            Self::Mask => "mask",
        }
    }

    /// Whether the array has a number for each pigment.
    pub(crate) const fn is_of_pigments(self) -> bool {
        matches!(self, Self::Share | Self::ShareSd | Self::Presence)
    }

    pub(crate) const fn data_type(self) -> &'static str {
        match self {
            Self::Share | Self::ShareSd => "float16",
            Self::Presence | Self::Mask => "uint8",
            Self::Chi2 | Self::Rms => "float32",
            Self::Second => "uint64",
        }
    }

    pub(crate) const fn bytes(self) -> usize {
        match self {
            Self::Presence | Self::Mask => 1,
            Self::Share | Self::ShareSd => 2,
            Self::Chi2 | Self::Rms => 4,
            Self::Second => 8,
        }
    }

    pub(crate) fn fill(self) -> Value {
        match self {
            Self::Presence => json!(NO_PRESENCE),
            Self::Mask => json!(NOT_YET),
            Self::Second => json!(0),
            _ => json!("NaN"),
        }
    }

    pub(crate) fn attributes(self) -> Map<String, Value> {
        let attributes = match self {
            Self::Share => json!({"long_name": "share of the pigment", "units": "1"}),
            Self::ShareSd => {
                json!({"long_name": "standard deviation of the share", "units": "1"})
            }
            Self::Presence => json!({
                "long_name": "probability that the pigment is present",
                "units": "1",
                "scale_factor": 1.0 / f64::from(PRESENCE_ONE),
                "_FillValue": NO_PRESENCE
            }),
            Self::Chi2 => json!({"long_name": "chi-square per degree of freedom", "units": "1"}),
            Self::Rms => {
                json!({"long_name": "root mean square residual in reflectance", "units": "1"})
            }
            Self::Second => json!({
                "long_name": "second-best set of pigments: bit i is the pigment i, 0 is none"
            }),
            Self::Mask => {
                let names = Mask::ALL.map(|mask| mask.name().replace(' ', "_")).join(" ");
                let mut values: Vec<u8> = Mask::ALL.iter().map(|mask| mask.code()).collect();
                values.push(NOT_YET);
                json!({
                    "long_name": "whether the pixel is mapped, or why not",
                    "flag_values": values,
                    "flag_meanings": format!("{names} not_yet")
                })
            }
        };
        match attributes {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }

    pub(crate) fn fill_bytes(self) -> Vec<u8> {
        match self {
            Self::Presence => vec![NO_PRESENCE],
            Self::Mask => vec![NOT_YET],
            Self::Second => vec![0; 8],
            Self::Share | Self::ShareSd => f16::NAN.to_le_bytes().to_vec(),
            Self::Chi2 | Self::Rms => f32::NAN.to_le_bytes().to_vec(),
        }
    }

    /// Writes the numbers of the pixels `pixels` of `maps` to `stored`.
    pub(crate) fn store(self, maps: &BlockMaps, pixels: Range<usize>, stored: &mut [u8]) {
        let of_pigments = pixels.start * maps.pigments..pixels.end * maps.pigments;
        match self {
            Self::Share => halves(&maps.share[of_pigments], stored),
            Self::ShareSd => halves(&maps.share_sd[of_pigments], stored),
            Self::Presence => {
                for (byte, value) in stored.iter_mut().zip(&maps.presence[of_pigments]) {
                    *byte = code_of(*value);
                }
            }
            Self::Chi2 => singles(&maps.chi2[pixels], stored),
            Self::Rms => singles(&maps.rms[pixels], stored),
            Self::Second => {
                for (bytes, value) in stored.chunks_exact_mut(8).zip(&maps.second[pixels]) {
                    bytes.copy_from_slice(&value.to_le_bytes());
                }
            }
            Self::Mask => {
                for (byte, mask) in stored.iter_mut().zip(&maps.mask[pixels]) {
                    *byte = mask.code();
                }
            }
        }
    }
}

/// Writes half-precision numbers. Every NaN has the same bits.
fn halves(values: &[f32], stored: &mut [u8]) {
    for (bytes, value) in stored.chunks_exact_mut(2).zip(values) {
        bytes.copy_from_slice(&half_of(*value).to_le_bytes());
    }
}

/// Writes single-precision numbers. Every NaN has the same bits.
fn singles(values: &[f32], stored: &mut [u8]) {
    for (bytes, value) in stored.chunks_exact_mut(4).zip(values) {
        let value = if value.is_nan() { f32::NAN } else { *value };
        bytes.copy_from_slice(&value.to_le_bytes());
    }
}

/// Pixels of a chunk along each side.
const CHUNK: usize = 256;
/// Chunks of a shard along each side.
const CHUNKS: usize = 8;

/// A rectangle of pixels that we write at once.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shard {
    /// Number of the shard. We count from left to right, then down.
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

/// How we divide one axis into shards and chunks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Axis {
    pub(crate) length: usize,
    pub(crate) chunk: usize,
    pub(crate) chunks: usize,
}

impl Axis {
    pub(crate) fn new(length: usize) -> Self {
        let chunk = CHUNK.min(length).max(1);
        Self { length, chunk, chunks: length.div_ceil(chunk).clamp(1, CHUNKS) }
    }

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

/// How we divide the maps into shards and chunks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Tiles {
    pub(crate) down: Axis,
    pub(crate) across: Axis,
}

impl Tiles {
    pub(crate) fn new(rows: usize, columns: usize) -> Self {
        Self { down: Axis::new(rows), across: Axis::new(columns) }
    }

    /// All shards. Pass the row and column of the scan where the maps begin.
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

/// We cannot write or read maps.
#[derive(Debug, thiserror::Error, Explain)]
pub enum StoreError {
    /// We cannot read or write a file of the description.
    #[error(transparent)]
    File(#[from] FileError),
    /// We cannot write a shard. Shards written before are whole.
    #[error("{}: the shard of {shard} cannot be written", path.display())]
    #[hint(
        if source.reason.kind() == std::io::ErrorKind::StorageFull,
        "free space on the disk, then go on with [resume]"
    )]
    #[hint(with = source.hint().or_else(|| Some(Hint::new("go on with [resume] afterwards"))))]
    #[fault(Environment)]
    Shard {
        /// Path of the store.
        path: PathBuf,
        /// The shard that we wanted to write.
        shard: Shard,
        /// The file and the error of the operating system.
        source: FileError,
    },
    /// The output exists, and you did not ask to resume it.
    #[error("{}: exists already and {holds}", path.display())]
    #[hint(if *is_maps, "go on with [resume], or name another folder with [output]")]
    #[hint("name another folder with [output]")]
    #[fault(Setting)]
    Exists {
        /// Path of the store.
        path: PathBuf,
        /// Content of the folder with its verb, such as `holds maps`.
        holds: String,
        /// Whether you can resume it.
        is_maps: bool,
    },
    /// The output belongs to a run of other settings.
    #[error("{}: holds maps of another run: `{key}` is {found}, now {expected}", path.display())]
    #[hint(
        "name another folder with [output], or map with the scan, library and settings of that run"
    )]
    #[fault(Setting)]
    OtherRun {
        /// Path of the store.
        path: PathBuf,
        /// Name of the first attribute or array that differs.
        key: String,
        /// Value of the store.
        found: String,
        /// Value of this run.
        expected: String,
    },
    /// Maps do not fit into the store.
    #[error("{}: {problem}", path.display())]
    Maps {
        /// Path of the store.
        path: PathBuf,
        /// The numbers that disagree.
        problem: String,
    },
    /// Shards are missing.
    #[error("{}: {missing} of {shards} shards are not written yet", path.display())]
    #[hint("go on with [resume]")]
    Unfinished {
        /// Path of the store.
        path: PathBuf,
        /// Number of shards that are missing.
        missing: usize,
        /// Number of all shards.
        shards: usize,
    },
    /// The store is damaged or not a store of maps.
    #[error("{}: {problem}", path.display())]
    #[hint("map the scan again into another folder")]
    Damaged {
        /// Path of the file.
        path: PathBuf,
        /// The fault that we found.
        problem: String,
    },
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
