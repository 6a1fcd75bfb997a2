//! Truth of a simulated scan: which paint really is at each pixel. We store it as a Zarr group and
//! compare maps with it.

mod seen;

use std::ops::Range;
use std::path::{Path, PathBuf};

use documents::file::{FileAction, FileError};
use serde_json::{Map, Value, json};

use crate::accuracy::{ScoreSums, Scores, Trial, covered, tone};
use crate::films::bands::Ground;
use crate::numbers::ByteOrder;
use crate::pixel_maps::Mask;
use crate::store::{GROUP, StoredMaps, entries, names, text, write};
use crate::zarr::{ArrayDocument, ChunkError, ShardBuilder, ZarrArray, group_document, packed};
use seen::{TITLE, TruthArray};

pub use seen::{PaintClass, TruthError, TruthParts, TruthRows, truth_rows};

/// From this chi-square per degree of freedom on, we call a pixel not explained.
pub const CHI2_RISEN: f64 = 2.0;

/// Figures of pixels of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonRow {
    /// Kind of the pixels, e.g. `hiding, dark`.
    pub kind: String,
    /// Number of pixels.
    pub pixels: u64,
    /// Part of them that is mapped.
    pub mapped: f64,
    /// Presence and shares of the mapped pixels.
    pub scores: Scores,
    /// Part of the shares within one standard deviation of the truth. We count the pigments that
    /// the map finds, but leave out pixels of one pigment alone.
    pub within_sd: f64,
    /// Share of the mapped pixels with a chi-square of [`CHI2_RISEN`] or more.
    pub chi2_risen: f64,
}

/// Figures of one pigment or group over all pixels except bare ones.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentFigures {
    /// Name of the pigment or group. The last row holds pigments that the maps do not know.
    pub name: String,
    /// Share of the pixels where it is present.
    pub there: f64,
    /// Share of the pixels where the map finds it, without traces.
    pub told: f64,
    /// Share of the pixels where it is present and the map finds it.
    pub right: f64,
}

/// How maps compare with the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Figures by kind of pixel: all pixels that show paint, then hiding paint by its tone, then
    /// other kinds.
    pub rows: Vec<ComparisonRow>,
    /// Each pigment or group of the maps, then pigments that the maps lack.
    pub pigments: Vec<PigmentFigures>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    pixels: u64,
    scores: ScoreSums,
    shares: usize,
    within: usize,
    risen: u64,
}

impl Sums {
    fn row(&self, kind: &str) -> ComparisonRow {
        ComparisonRow {
            kind: kind.to_owned(),
            pixels: self.pixels,
            mapped: part(self.scores.count, self.pixels as f64),
            scores: self.scores.scores(),
            within_sd: part(self.within as f64, self.shares as f64),
            chi2_risen: part(self.risen as f64, self.scores.count),
        }
    }
}

fn part(value: f64, of: f64) -> f64 {
    if of > 0.0 { value / of } else { 0.0 }
}

/// Rows of the table: name, classes of pixels, and their tone. `None` stands for any tone.
const KINDS: [(&str, &[PaintClass], Option<usize>); 8] = [
    (
        "all paint",
        &[PaintClass::Hiding, PaintClass::Edge, PaintClass::Glaze, PaintClass::Thin],
        None,
    ),
    ("hiding, light", &[PaintClass::Hiding], Some(2)),
    ("hiding, middle", &[PaintClass::Hiding], Some(1)),
    ("hiding, dark", &[PaintClass::Hiding], Some(0)),
    ("edge", &[PaintClass::Edge], None),
    ("glaze", &[PaintClass::Glaze], None),
    ("thin", &[PaintClass::Thin], None),
    ("bare", &[PaintClass::Bare], None),
];

/// Compares `maps` with `truth`, block by block. A pigment is present if its share of the visible
/// paint is `least` or more. Smaller shares are traces, which count as neither right nor wrong.
///
/// # Errors
/// [`TruthError`] if we cannot read one of them, or they belong to different scans.
pub fn compare(maps: &StoredMaps, truth: &Truth, least: f64) -> Result<Comparison, TruthError> {
    let rows = maps.rows();
    let columns = maps.columns();
    if rows.end > truth.lines() || columns.end > truth.samples() {
        return Err(TruthError::Size {
            path: truth.path().to_owned(),
            ends: (rows.end, columns.end),
            lines: truth.lines(),
            samples: truth.samples(),
        });
    }
    let columns_of = columns_of(maps, truth);
    let ground = maps.pigments().iter().position(|column| column == Ground::COLUMN);
    let count = maps.pigments().len() + 1;
    let mut kinds = KINDS.map(|_| Sums::default());
    let mut pigments = vec![[0.0; 3]; count];
    for (place, block) in truth.blocks().enumerate() {
        let inside = block.start.max(rows.start)..block.end.min(rows.end);
        if inside.is_empty() {
            continue;
        }
        let known = truth.block(place)?;
        let told = maps.read(inside.clone(), columns.clone())?;
        for index in 0..told.pixels() {
            let line = inside.start + index / columns.len() - block.start;
            let at = line * truth.samples() + columns.start + index % columns.len();
            let class = known.class[at];
            let tone = tone(known.mean_reflectance[at]);
            let mut shares = vec![0.0; count];
            let own = &known.share[at * known.pigments..][..known.pigments];
            for (share, &column) in own.iter().zip(&columns_of) {
                shares[column] += f64::from(*share);
            }
            let is_mapped = told.mask[index] == Mask::Mapped;
            let trial = trial(&told, index, shares, (least, ground));
            let (shares, within) = covered(&trial);
            for (sums, (_, classes, of_tone)) in kinds.iter_mut().zip(KINDS) {
                if !classes.contains(&class) || of_tone.is_some_and(|own| own != tone) {
                    continue;
                }
                sums.pixels += 1;
                if is_mapped {
                    sums.scores.add(&trial);
                    sums.shares += shares;
                    sums.within += within;
                    sums.risen += u64::from(trial.chi2 >= CHI2_RISEN);
                }
            }
            if class != PaintClass::Bare && is_mapped {
                add_pigments(&mut pigments, &trial);
            }
        }
    }
    let all = kinds[0].scores.count.max(1.0);
    let names = maps.pigments().iter().map(String::as_str).chain(["(not in the library)"]);
    Ok(Comparison {
        rows: kinds.iter().zip(KINDS).map(|(sums, (kind, ..))| sums.row(kind)).collect(),
        pigments: (names.zip(&pigments))
            .map(|(name, sums)| {
                let [there, told, right] = sums.map(|sum| sum / all);
                PigmentFigures { name: name.to_owned(), there, told, right }
            })
            .collect(),
    })
}

/// For each pigment of the truth its column in the maps, or the number of columns if the maps lack
/// it.
fn columns_of(maps: &StoredMaps, truth: &Truth) -> Vec<usize> {
    let groups = &maps.attributes().get("settings").unwrap_or(&Value::Null)["groups"];
    let columns = truth.pigments().iter().map(|pigment: &String| {
        let column = maps.pigments().iter().position(|column: &String| {
            match groups[column.as_str()].as_array() {
                Some(group) => group.iter().any(|name| name.as_str() == Some(pigment)),
                None => column == pigment,
            }
        });
        column.unwrap_or(maps.pigments().len())
    });
    columns.collect()
}

/// The trial of a pixel, with a last column for pigments that the maps do not know. Shares of the maps count
/// as parts of the paint, without the ground.
fn trial(
    maps: &crate::pixel_maps::BlockMaps,
    index: usize,
    mut shares: Vec<f64>,
    (least, ground): (f64, Option<usize>),
) -> Trial {
    let unknown = shares.pop().unwrap_or(0.0);
    let mut trial = Trial { least, ..Trial::of_map(maps, index, &shares) };
    if let Some(ground) = ground {
        let paint = (1.0 - std::mem::take(&mut trial.told[ground])).max(1e-6);
        trial.told.iter_mut().for_each(|share| *share /= paint);
        trial.sd.iter_mut().for_each(|sd| *sd /= paint);
        trial.present[ground] = false;
    }
    trial.truth.push(unknown);
    trial.told.push(0.0);
    trial.present.push(false);
    trial
}

fn add_pigments(pigments: &mut [[f64; 3]], trial: &Trial) {
    for (index, [there, told, right]) in pigments.iter_mut().enumerate() {
        let Some(is_there) = trial.is_there(index) else { continue };
        let is_told = trial.present[index];
        *there += f64::from(u8::from(is_there));
        *told += f64::from(u8::from(is_told));
        *right += f64::from(u8::from(is_told && is_there));
    }
}

/// Truth of a simulated scan on the disk.
#[derive(Debug)]
pub struct Truth {
    path: PathBuf,
    lines: usize,
    samples: usize,
    pigments: Vec<String>,
    settings: Map<String, Value>,
    arrays: Vec<(TruthArray, ZarrArray)>,
    /// Number of rows in a chunk.
    rows: usize,
}

/// Whether the folder holds the truth of a scan.
fn is_truth(path: &Path) -> bool {
    let bytes = std::fs::read(path.join(GROUP)).unwrap_or_default();
    let group: Value = serde_json::from_slice(&bytes).unwrap_or_default();
    group["attributes"]["title"] == TITLE
}

impl Truth {
    /// Opens the truth in the folder `path`.
    ///
    /// # Errors
    /// [`TruthError`] if it holds something else, or damaged truth.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, TruthError> {
        let path = path.as_ref();
        let file = path.join(GROUP);
        let damaged = |problem: String| TruthError::Damaged { path: file.clone(), problem };
        let bytes = documents::file::read(&file)?;
        let group: Value = serde_json::from_slice(&bytes)
            .map_err(|error| damaged(format!("is not JSON: {error}")))?;
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
            let [lines, samples, ..] = first.about.shape[..] else {
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

    /// Blocks of rows that we store together. Read them one after another.
    pub fn blocks(&self) -> impl Iterator<Item = Range<usize>> {
        let lines = self.lines;
        let rows = self.rows;
        (0..lines.div_ceil(rows)).map(move |at| at * rows..((at + 1) * rows).min(lines))
    }

    /// Reads the block of rows at `place` in the order of [`Truth::blocks`].
    pub fn block(&self, place: usize) -> Result<TruthRows, TruthError> {
        let rows = self.rows.min(self.lines.saturating_sub(place * self.rows));
        let pixels = rows * self.samples;
        let mut truth = TruthRows { pigments: self.pigments.len(), ..TruthRows::default() };
        for (array, opened) in &self.arrays {
            let folder = &opened.folder;
            let at: &[usize] =
                if *array == TruthArray::Share { &[place, 0, 0] } else { &[place, 0] };
            let bytes = match opened.chunk(at) {
                Ok(Some(bytes)) => bytes,
                Ok(None) => {
                    let problem = format!("the chunk {place}, 0 is missing");
                    return Err(TruthError::Damaged { path: folder.clone(), problem });
                }
                Err(ChunkError::Io(path, reason)) => {
                    return Err(FileError::reading(&path, reason).into());
                }
                Err(ChunkError::Fault(path, fault)) => {
                    return Err(TruthError::Damaged { path, problem: fault.problem });
                }
            };
            let singles = bytes.as_chunks().0.iter().map(|&v| f32::from_le_bytes(v));
            match array {
                TruthArray::Share => {
                    truth.share = singles.take(pixels * self.pigments.len()).collect();
                }
                TruthArray::Ground => truth.ground = singles.take(pixels).collect(),
                TruthArray::MeanReflectance => {
                    truth.mean_reflectance = singles.take(pixels).collect();
                }
                TruthArray::Class => {
                    truth.class = bytes
                        .iter()
                        .take(pixels)
                        .map(|code: &u8| {
                            PaintClass::from_code(*code).ok_or_else(|| {
                                let problem =
                                    format!("holds the class `{code}`, which has no meaning");
                                TruthError::Damaged { path: folder.clone(), problem }
                            })
                        })
                        .collect::<Result<_, _>>()?;
                }
            }
        }
        Ok(truth)
    }
}

/// A chunk should not hold more numbers than this.
const CHUNK_NUMBERS: usize = 1 << 20;
/// Most rows of a chunk.
const MOST_ROWS: usize = 64;

/// Sizes and settings of the truth that you want to write.
#[derive(Debug, Clone, PartialEq)]
pub struct TruthAbout {
    /// Number of rows.
    pub lines: usize,
    /// Number of columns.
    pub samples: usize,
    /// Names of the pigments.
    pub pigments: Vec<String>,
    /// Settings of the simulation. We store them too.
    pub settings: Map<String, Value>,
}

/// Writes truth. The description of the group comes last, so a folder with a description is whole.
#[derive(Debug)]
pub struct TruthWriter {
    path: PathBuf,
    about: TruthAbout,
    rows: usize,
    next: usize,
}

impl TruthWriter {
    /// Begins truth in the folder `path`. This replaces truth that is already there.
    ///
    /// # Errors
    /// [`TruthError`] if the folder holds anything else, or we cannot write it.
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

    /// Number of rows in a block, which we write as one chunk. The last block may be shorter.
    #[must_use]
    pub fn block_rows(&self) -> usize {
        self.rows
    }

    /// Writes the next block of rows.
    ///
    /// # Errors
    /// [`TruthError`] if the rows are not a block of this truth, or we cannot write them.
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
    /// [`TruthError`] if rows are missing, or we cannot write a file.
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
        for (axis, count) in [("y/c/0", *lines), ("x/c/0", *samples)] {
            let numbers: Vec<u8> = (0..count as i64).flat_map(i64::to_le_bytes).collect();
            write(&self.path.join(axis), &numbers)?;
        }
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

fn singles(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Refuses a folder that holds anything but truth.
fn check(path: &Path) -> Result<(), TruthError> {
    if !path.exists() {
        return Ok(());
    }
    let arrays = TruthArray::ALL.map(TruthArray::name);
    let is_own = entries(path).is_ok_and(|held| {
        let is_other = held.contains(GROUP) && !is_truth(path);
        let mut names = held.iter().map(String::as_str);
        !is_other
            && names.all(|name| {
                let own = arrays.contains(&name) || ["y", "x", "pigment"].contains(&name);
                own || name == GROUP || name.starts_with(".impasto-")
            })
    });
    match is_own {
        true => Ok(()),
        false => Err(TruthError::Exists(path.to_owned())),
    }
}
