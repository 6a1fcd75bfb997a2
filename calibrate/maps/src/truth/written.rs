//! Writes truth as a Zarr group, a block of rows at a time.

use std::path::{Path, PathBuf};

use documents::file::{FileAction, FileError};
use serde_json::{Map, Value, json};

use super::arrays::{TITLE, TruthArray};
use super::error::TruthError;
use super::seen::TruthRows;
use super::stored::is_truth;
use crate::store::{GROUP, entries, names, text, write};
use crate::zarr::{ArrayDocument, ShardBuilder, group_document, packed};

/// Numbers of a chunk that should not be exceeded.
const CHUNK_NUMBERS: usize = 1 << 20;
/// Most rows of a chunk.
const MOST_ROWS: usize = 64;

/// Truth to be written.
#[derive(Debug, Clone, PartialEq)]
pub struct TruthAbout {
    /// Number of rows.
    pub lines: usize,
    /// Number of columns.
    pub samples: usize,
    /// Names of the pigments.
    pub pigments: Vec<String>,
    /// Settings of the simulation, which are stored.
    pub settings: Map<String, Value>,
}

/// Truth that is being written. The description of the group comes last: a folder with one is whole.
#[derive(Debug)]
pub struct TruthWriter {
    path: PathBuf,
    about: TruthAbout,
    rows: usize,
    next: usize,
}

impl TruthWriter {
    /// Begins truth in the folder `path`. Truth that is there already is replaced.
    ///
    /// # Errors
    /// [`TruthError`] if the folder holds anything else, or cannot be written.
    pub fn create(path: &Path, about: TruthAbout) -> Result<Self, TruthError> {
        check(path)?;
        if about.lines == 0 || about.samples == 0 || about.pigments.is_empty() {
            let TruthAbout { lines, samples, pigments, .. } = about;
            let count = pigments.len();
            let problem =
                format!("truth of {lines} x {samples} pixels and {count} pigments is empty");
            return Err(TruthError::Rows { path: path.to_owned(), problem });
        }
        let group = path.join(GROUP);
        if group.exists() {
            std::fs::remove_file(&group).map_err(|reason| FileError {
                path: group.clone(),
                action: FileAction::Write,
                reason: std::sync::Arc::new(reason),
            })?;
        }
        let row = about.samples.saturating_mul(about.pigments.len());
        let rows = (CHUNK_NUMBERS / row).clamp(1, MOST_ROWS).min(about.lines);
        Ok(Self { path: path.to_owned(), about, rows, next: 0 })
    }

    /// Rows of a block, which is written as one chunk. The last block may be shorter.
    #[must_use]
    pub fn block_rows(&self) -> usize {
        self.rows
    }

    /// Writes the next block of rows.
    ///
    /// # Errors
    /// [`TruthError`] if the rows are no block of this truth, or cannot be written.
    pub fn add(&mut self, rows: &TruthRows) -> Result<(), TruthError> {
        let TruthAbout { lines, samples, pigments, .. } = &self.about;
        let expected = self.rows.min(lines - self.next);
        let pixels = expected * samples;
        let lengths = [rows.ground.len(), rows.mean_reflectance.len(), rows.class.len()];
        let count = pigments.len();
        if expected == 0
            || lengths != [pixels; 3]
            || rows.pigments != count
            || rows.share.len() != pixels * count
        {
            return Err(TruthError::Rows {
                path: self.path.clone(),
                problem: format!(
                    "truth of {} pixels and {} pigments does not fit row {} on, expected {expected} rows of {samples} pixels and {count} pigments",
                    rows.ground.len(),
                    rows.pigments,
                    self.next
                ),
            });
        }
        for array in TruthArray::ALL {
            let singles = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect();
            let mut bytes: Vec<u8> = match array {
                TruthArray::Share => singles(&rows.share),
                TruthArray::Ground => singles(&rows.ground),
                TruthArray::MeanReflectance => singles(&rows.mean_reflectance),
                TruthArray::Class => rows.class.iter().map(|class| class.code()).collect(),
            };
            // Chunks at the end are as large as all others.
            let whole: usize = array.sizes(self.rows, *samples, count).iter().product();
            bytes.resize(whole * array.bytes(), 0);
            let mut file = self.path.join(array.name()).join("c");
            file.push((self.next / self.rows).to_string());
            file.push("0");
            if array == TruthArray::Share {
                file.push("0");
            }
            let packed = packed(&bytes).map_err(|error| TruthError::Rows {
                path: file.clone(),
                problem: format!("rows cannot be packed: {error}"),
            })?;
            let mut shard = ShardBuilder::new(1);
            shard.add(0, &packed);
            write(&file, &shard.finish())?;
        }
        self.next += expected;
        Ok(())
    }

    /// Ends the truth.
    ///
    /// # Errors
    /// [`TruthError`] if rows are missing, or a file cannot be written.
    pub fn finish(self) -> Result<(), TruthError> {
        let TruthAbout { lines, samples, pigments, settings } = &self.about;
        if self.next != *lines {
            let problem = format!("the truth ends after row {} of {lines}", self.next);
            return Err(TruthError::Rows { path: self.path.clone(), problem });
        }
        let documents = self.documents();
        for (name, document) in &documents {
            write(&self.path.join(name).join(GROUP), &text(document))?;
        }
        let numbers =
            |count: usize| -> Vec<u8> { (0..count as i64).flat_map(i64::to_le_bytes).collect() };
        write(&self.path.join("y/c/0"), &numbers(*lines))?;
        write(&self.path.join("x/c/0"), &numbers(*samples))?;
        write(&self.path.join("pigment/c/0"), &names(pigments))?;
        let about = json!({
            "title": TITLE,
            "impasto_version": env!("CARGO_PKG_VERSION"),
            "pigments": pigments,
            "settings": settings,
        });
        let attributes = match about {
            Value::Object(map) => map,
            _ => Map::new(),
        };
        write(&self.path.join(GROUP), &text(&group_document(attributes, documents)))?;
        Ok(())
    }

    /// Descriptions of all arrays, with their names.
    fn documents(&self) -> Vec<(String, Value)> {
        let TruthAbout { lines, samples, pigments, .. } = &self.about;
        let count = pigments.len();
        let mut documents = Vec::new();
        for array in TruthArray::ALL {
            let chunk = array.sizes(self.rows, *samples, count);
            let document = ArrayDocument {
                shape: &array.sizes(*lines, *samples, count),
                data_type: array.data_type(),
                outer: &chunk,
                inner: Some(&chunk),
                fill: json!(0),
                dimensions: array.dimensions(),
                attributes: array.attributes(),
            };
            documents.push((array.name().to_owned(), document.json()));
        }
        for (name, length, data_type) in
            [("y", *lines, "int64"), ("x", *samples, "int64"), ("pigment", count, "string")]
        {
            let document = ArrayDocument::coordinate(&name, &length, data_type, Map::new());
            documents.push((name.to_owned(), document.json()));
        }
        documents
    }
}

/// Refuses a folder that holds anything else than truth.
fn check(path: &Path) -> Result<(), TruthError> {
    if !path.exists() {
        return Ok(());
    }
    let exists = || TruthError::Exists { path: path.to_owned() };
    let held = entries(path).map_err(|_| exists())?;
    let arrays = TruthArray::ALL.map(TruthArray::name);
    let is_other = held.contains(GROUP) && !is_truth(path);
    if is_other
        || !held.iter().all(|name: &String| {
            let own =
                arrays.contains(&name.as_str()) || ["y", "x", "pigment"].contains(&name.as_str());
            own || name == GROUP || name.starts_with(".impasto-")
        })
    {
        Err(exists())
    } else {
        Ok(())
    }
}
