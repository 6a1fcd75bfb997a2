//! Creates or resumes a store, and writes it shard by shard.
//!
//! A shard collects its maps row by row and packs them chunk by chunk.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::arrays::{MapArray, Shard, StoreError, Tiles};
use crate::pixel_maps::{BlockMaps, MapsAbout};
use crate::zarr::{ArrayDocument, ShardBuilder, group_document, packed};
use documents::file::{FileAction, FileError, write_whole};

/// Whether you begin or resume a store.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoreMode {
    /// Begin. The folder must not exist, or must be empty.
    New,
    /// Resume a store of the same run if there is one. Its content stays.
    Resume,
}

/// A store of maps during writing.
#[derive(Debug, Clone)]
pub struct MapStore {
    path: PathBuf,
    pigments: usize,
    tiles: Tiles,
    shards: Vec<Shard>,
}

pub(crate) const GROUP: &str = "zarr.json";

impl MapStore {
    /// Begins or resumes the store at `path`. This writes the descriptions of the arrays at once.
    ///
    /// # Errors
    /// [`StoreError`] if the folder holds anything but maps of this run, or we cannot write it.
    pub fn create(
        path: impl AsRef<Path>,
        about: &MapsAbout,
        mode: StoreMode,
    ) -> Result<Self, StoreError> {
        let path = path.as_ref();
        check(path, about)?;
        let tiles = Tiles::new(about.rows.len(), about.columns.len());
        let documents = documents(about, tiles);
        let group = group_document(about.attributes(), documents.iter().cloned());
        let store = Self {
            path: path.to_owned(),
            pigments: about.pigments.len(),
            tiles,
            shards: tiles.shards((about.rows.start, about.columns.start)),
        };
        if store.is_there(&group, mode)? {
            return Ok(store);
        }
        for (name, document) in &documents {
            write(&path.join(name).join(GROUP), &text(document))?;
        }
        write(&path.join("y/c/0"), &numbers(&about.rows))?;
        write(&path.join("x/c/0"), &numbers(&about.columns))?;
        write(&path.join("pigment/c/0"), &names(&about.pigments))?;
        // Last, so that a store that has it is whole but for its shards.
        write(&path.join(GROUP), &text(&group))?;
        Ok(store)
    }

    /// Whether the folder is already a store of this run. This fails if it holds anything else.
    fn is_there(&self, group: &Value, mode: StoreMode) -> Result<bool, StoreError> {
        if !self.path.exists() {
            return Ok(false);
        }
        let held = entries(&self.path)?;
        if held.is_empty() {
            return Ok(false);
        }
        let place = self.path.join(GROUP);
        let is_group = held.contains(GROUP);
        let own: BTreeSet<String> = own_names();
        let is_begun = held.iter().all(|name| own.contains(name) || name.starts_with(".impasto-"));
        let exists = |holds: &str, is_maps| StoreError::Exists {
            path: self.path.clone(),
            holds: holds.to_owned(),
            is_maps,
        };
        match (is_group, mode) {
            (false, StoreMode::Resume) if is_begun => Ok(false),
            (false, StoreMode::New) if is_begun => Err(exists("holds maps that were begun", true)),
            (false, _) => Err(exists("holds other files", false)),
            (true, _) => {
                let bytes = documents::file::read(&place)?;
                let found: Value = serde_json::from_slice(&bytes).map_err(|error| {
                    StoreError::Damaged { path: place, problem: format!("is not JSON: {error}") }
                })?;
                if found["attributes"]["title"] != group["attributes"]["title"] {
                    return Err(exists("holds other data", false));
                }
                match (mode, self.difference(&found, group)) {
                    (StoreMode::New, _) => Err(exists("holds maps", true)),
                    (StoreMode::Resume, None) => Ok(true),
                    (StoreMode::Resume, Some(error)) => Err(error),
                }
            }
        }
    }

    /// Finds the first attribute or array in which two descriptions differ.
    fn difference(&self, found: &Value, expected: &Value) -> Option<StoreError> {
        let nothing = Map::new();
        let parts = ["/attributes", "/consolidated_metadata/metadata"];
        for part in parts {
            let [found, expected] = [found, expected]
                .map(|of| of.pointer(part).and_then(Value::as_object).unwrap_or(&nothing));
            let keys: BTreeSet<&String> = found.keys().chain(expected.keys()).collect();
            for key in keys {
                if found.get(key) != expected.get(key) {
                    let [found, expected] = [found, expected].map(|of| {
                        let text =
                            of.get(key).map_or_else(|| "missing".to_owned(), Value::to_string);
                        text.chars().take(200).collect()
                    });
                    let path = self.path.clone();
                    return Some(StoreError::OtherRun { path, key: key.clone(), found, expected });
                }
            }
        }
        None
    }

    /// Path of the store.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of pigments or groups.
    #[must_use]
    pub fn pigments(&self) -> usize {
        self.pigments
    }

    /// All shards, from left to right, then down.
    #[must_use]
    pub fn shards(&self) -> &[Shard] {
        &self.shards
    }

    /// Whether the shard is written.
    #[must_use]
    pub fn is_finished(&self, shard: &Shard) -> bool {
        self.file(MapArray::Mask, shard).is_file()
    }

    pub(crate) fn tiles(&self) -> Tiles {
        self.tiles
    }

    pub(crate) fn file(&self, array: MapArray, shard: &Shard) -> PathBuf {
        shard_file(&self.path, array, shard)
    }
}

fn numbers(range: &Range<usize>) -> Vec<u8> {
    range.clone().flat_map(|at| (at as i64).to_le_bytes()).collect()
}

/// File of a shard of an array of the store at `path`.
pub(crate) fn shard_file(path: &Path, array: MapArray, shard: &Shard) -> PathBuf {
    let (row, column) = shard.at;
    let mut file = path.join(array.name());
    file.push("c");
    file.push(row.to_string());
    file.push(column.to_string());
    if array.is_of_pigments() {
        file.push("0");
    }
    file
}

fn check(path: &Path, about: &MapsAbout) -> Result<(), StoreError> {
    let names: BTreeSet<&String> = about.pigments.iter().collect();
    let count = about.pigments.len();
    let most = BlockMaps::MOST_PIGMENTS;
    let problem = if count == 0 || count > most || names.len() < count {
        format!("maps need 1 to {most} pigments of different names, found {count}")
    } else if about.rows.is_empty() || about.columns.is_empty() {
        "maps need at least one row and one column".to_owned()
    } else {
        return Ok(());
    };
    Err(StoreError::Maps { path: path.to_owned(), problem })
}

fn own_names() -> BTreeSet<String> {
    let arrays = MapArray::ALL.into_iter().map(MapArray::name);
    arrays.chain([GROUP, "y", "x", "pigment"]).map(str::to_owned).collect()
}

pub(crate) fn entries(folder: &Path) -> Result<BTreeSet<String>, StoreError> {
    let reading = |reason| FileError::reading(folder, reason);
    let mut names = BTreeSet::new();
    for entry in std::fs::read_dir(folder).map_err(reading)? {
        names.insert(entry.map_err(reading)?.file_name().to_string_lossy().into_owned());
    }
    Ok(names)
}

/// Writes a file, and makes the folders that it needs.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|reason| FileError {
            path: path.to_owned(),
            action: FileAction::Write,
            reason: std::sync::Arc::new(reason),
        })?;
    }
    write_whole(path, bytes)
}

pub(crate) fn text(document: &Value) -> Vec<u8> {
    format!("{document:#}\n").into_bytes()
}

/// Encodes texts with the codec `vlen-utf8`.
pub(crate) fn names(names: &[String]) -> Vec<u8> {
    let mut bytes = length(names.len()).to_vec();
    for name in names {
        bytes.extend(length(name.len()));
        bytes.extend(name.as_bytes());
    }
    bytes
}

fn length(length: usize) -> [u8; 4] {
    u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes()
}

fn documents(about: &MapsAbout, tiles: Tiles) -> Vec<(String, Value)> {
    let count = about.pigments.len();
    let mut documents = Vec::new();
    for array in MapArray::ALL {
        let sizes = |down: usize, across: usize| match array.is_of_pigments() {
            true => vec![down, across, count],
            false => vec![down, across],
        };
        let document = ArrayDocument {
            shape: &sizes(tiles.down.length, tiles.across.length),
            data_type: array.data_type(),
            outer: &sizes(tiles.down.shard(), tiles.across.shard()),
            inner: Some(&sizes(tiles.down.chunk, tiles.across.chunk)),
            fill: array.fill(),
            dimensions: if array.is_of_pigments() { &["y", "x", "pigment"] } else { &["y", "x"] },
            attributes: array.attributes(),
        };
        documents.push((array.name().to_owned(), document.json()));
    }
    for (name, length, data_type, words) in [
        ("y", tiles.down.length, "int64", "row of the scan"),
        ("x", tiles.across.length, "int64", "column of the scan"),
        ("pigment", count, "string", "pigment or group of pigments"),
    ] {
        let mut attributes = Map::new();
        attributes.insert("long_name".to_owned(), json!(words));
        let document = ArrayDocument::coordinate(&name, &length, data_type, attributes);
        documents.push((name.to_owned(), document.json()));
    }
    documents
}

/// A row of chunks of one array that we are filling, and the shard that they go to.
#[derive(Debug)]
struct Row {
    array: MapArray,
    chunks: Vec<Vec<u8>>,
    shard: ShardBuilder,
}

/// Writes a shard. You need memory for one row of chunks and for the packed chunks.
#[derive(Debug)]
pub struct ShardWriter<'s> {
    store: &'s MapStore,
    shard: Shard,
    rows: Vec<Row>,
    /// Next row of the scan.
    next: usize,
}

impl MapStore {
    /// Begins a shard. Nothing is on the disk until you finish it.
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
    /// [`StoreError::Maps`] if the rows do not follow the last ones, or sizes do not fit.
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

    /// Puts rows of `maps` into the chunks, from row `top` of the chunks on.
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

    /// Packs the row of chunks with the index `down`.
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
    /// [`StoreError::Shard`] if we cannot write a file, [`StoreError::Maps`] if rows are missing.
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
