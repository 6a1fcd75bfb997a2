//! Reads truth from the disk.

use std::ops::Range;
use std::path::{Path, PathBuf};

use documents::file::FileError;
use serde_json::{Map, Value};

use super::arrays::{TITLE, TruthArray};
use super::error::TruthError;
use super::paint_class::PaintClass;
use super::seen::TruthRows;
use crate::numbers::ByteOrder;
use crate::store::GROUP;
use crate::zarr::{ChunkError, ZarrArray};

/// Truth of a simulated scan on the disk.
#[derive(Debug)]
pub struct Truth {
    path: PathBuf,
    lines: usize,
    samples: usize,
    pigments: Vec<String>,
    settings: Map<String, Value>,
    arrays: Vec<(TruthArray, ZarrArray)>,
    /// Rows of a chunk.
    rows: usize,
}

/// Whether the folder holds truth.
pub(super) fn is_truth(path: &Path) -> bool {
    let bytes = std::fs::read(path.join(GROUP)).unwrap_or_default();
    let group: Value = serde_json::from_slice(&bytes).unwrap_or_default();
    group["attributes"]["title"] == TITLE
}

impl Truth {
    /// Opens the truth in the folder `path`.
    ///
    /// # Errors
    /// [`TruthError`] if it holds none, or damaged truth.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, TruthError> {
        let path = path.as_ref();
        let file = path.join(GROUP);
        let damaged = |problem: String| TruthError::Damaged { path: file.clone(), problem };
        let bytes = documents::file::read(&file)?;
        let group: Value = serde_json::from_slice(&bytes)
            .map_err(|error| damaged(format!("is no JSON: {error}")))?;
        let attributes = &group["attributes"];
        let names = attributes["pigments"].as_array().filter(|_| attributes["title"] == TITLE);
        let Some(names) = names else {
            return Err(damaged("describes no truth of a simulated scan".to_owned()));
        };
        let pigments: Vec<String> =
            names.iter().map(|name| name.as_str().unwrap_or_default().to_owned()).collect();
        let mut arrays: Vec<(TruthArray, ZarrArray)> = Vec::new();
        for array in TruthArray::ALL {
            let about = &group["consolidated_metadata"]["metadata"][array.name()];
            let opened = ZarrArray::new(&path.join(array.name()), about)
                .map_err(|fault| damaged(format!("`{}` {}", array.name(), fault.problem)))?;
            let shape = &opened.about.shape;
            let chunk = &opened.about.chunk;
            let first = arrays.first().map_or(&opened, |(_, first)| first);
            let (Some(&lines), Some(&samples)) =
                (first.about.shape.first(), first.about.shape.get(1))
            else {
                return Err(damaged(format!("`{}` has the shape {shape:?}", array.name())));
            };
            let expected = array.sizes(lines, samples, pigments.len());
            let expected_chunk = array.sizes(first.about.chunk[0], samples, pigments.len());
            if *shape != expected
                || *chunk != expected_chunk
                || opened.about.number_type.bytes() != array.bytes()
                || opened.about.chain.transpose.is_some()
                || opened.about.chain.byte_order != ByteOrder::Little
            {
                let name = array.name();
                let problem = format!(
                    "`{name}` has the shape {shape:?} and chunks of {chunk:?}, expected {expected:?} and {expected_chunk:?}"
                );
                return Err(damaged(problem));
            }
            arrays.push((array, opened));
        }
        let about = &arrays[0].1.about;
        Ok(Self {
            path: path.to_owned(),
            lines: about.shape[0],
            samples: about.shape[1],
            rows: about.chunk[0],
            pigments,
            settings: attributes["settings"].as_object().cloned().unwrap_or_default(),
            arrays,
        })
    }

    /// Path of the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of rows.
    #[must_use]
    pub fn lines(&self) -> usize {
        self.lines
    }

    /// Number of columns.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Names of the pigments.
    #[must_use]
    pub fn pigments(&self) -> &[String] {
        &self.pigments
    }

    /// Settings of the simulation.
    #[must_use]
    pub fn settings(&self) -> &Map<String, Value> {
        &self.settings
    }

    /// Blocks of rows that are stored together, which are best read one after another.
    pub fn blocks(&self) -> impl Iterator<Item = Range<usize>> {
        let lines = self.lines;
        let rows = self.rows;
        (0..lines.div_ceil(rows)).map(move |at| at * rows..((at + 1) * rows).min(lines))
    }

    /// Reads the block of rows at `place` in the order of [`Truth::blocks`].
    ///
    /// # Errors
    /// [`TruthError`] if the block is missing or damaged.
    pub fn block(&self, place: usize) -> Result<TruthRows, TruthError> {
        let rows = self.rows.min(self.lines.saturating_sub(place * self.rows));
        let pixels = rows * self.samples;
        let mut truth = TruthRows { pigments: self.pigments.len(), ..TruthRows::default() };
        for (array, opened) in &self.arrays {
            let damaged =
                |problem: String| TruthError::Damaged { path: opened.folder.clone(), problem };
            let at: &[usize] =
                if *array == TruthArray::Share { &[place, 0, 0] } else { &[place, 0] };
            let bytes = match opened.chunk(at) {
                Ok(Some(bytes)) => bytes,
                Ok(None) => return Err(damaged(format!("the chunk {place}, 0 is missing"))),
                Err(ChunkError::Io(path, reason)) => {
                    return Err(FileError::reading(&path, reason).into());
                }
                Err(ChunkError::Fault(path, fault)) => {
                    return Err(TruthError::Damaged { path, problem: fault.problem });
                }
            };
            let singles = |count: usize| -> Vec<f32> {
                bytes
                    .as_chunks::<4>()
                    .0
                    .iter()
                    .take(count)
                    .map(|&v| f32::from_le_bytes(v))
                    .collect()
            };
            match array {
                TruthArray::Share => truth.share = singles(pixels * self.pigments.len()),
                TruthArray::Ground => truth.ground = singles(pixels),
                TruthArray::MeanReflectance => truth.mean_reflectance = singles(pixels),
                TruthArray::Class => {
                    truth.class = bytes
                        .iter()
                        .take(pixels)
                        .map(|code: &u8| {
                            PaintClass::from_code(*code).ok_or_else(|| {
                                damaged(format!("holds the class `{code}`, which has no meaning"))
                            })
                        })
                        .collect::<Result<_, _>>()?;
                }
            }
        }
        Ok(truth)
    }
}
