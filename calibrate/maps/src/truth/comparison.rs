//! Compares maps with the truth of the scan that they were made of.

use serde_json::Value;

use super::error::TruthError;
use super::paint_class::PaintClass;
use super::stored::Truth;
use crate::accuracy::{ScoreSums, Scores, Trial, covered, tone};
use crate::pixel_maps::Mask;
use crate::store::StoredMaps;

/// Chi-square per degree of freedom from which a pixel counts as not explained.
pub const CHI2_RISEN: f64 = 2.0;

/// Figures of pixels of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonRow {
    /// Kind of the pixels, such as `hiding, dark`.
    pub kind: String,
    /// Number of pixels.
    pub pixels: u64,
    /// Part of them that is mapped.
    pub mapped: f64,
    /// Presence and shares of the mapped pixels.
    pub scores: Scores,
    /// Part of the shares told to be present that lie within one standard deviation of the truth. Pixels of one
    /// pigment alone are left out.
    pub within_sd: f64,
    /// Part of the mapped pixels whose chi-square is [`CHI2_RISEN`] or more.
    pub chi2_risen: f64,
}

/// Figures of one pigment or group over all pixels but bare ones.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentFigures {
    /// Name of the pigment or group; the last row holds those that the maps do not know.
    pub name: String,
    /// Part of the pixels where it is present.
    pub there: f64,
    /// Part of the pixels where it is told, traces left out.
    pub told: f64,
    /// Part of the pixels where it is present and told.
    pub right: f64,
}

/// Maps beside the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Pixels by what is seen: all that show paint, then hiding paint by its tone, then other kinds.
    pub rows: Vec<ComparisonRow>,
    /// Each pigment or group of the maps, then those that the maps lack.
    pub pigments: Vec<PigmentFigures>,
}

/// Sums over pixels of one kind.
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
        let part = |value: f64, of: f64| if of > 0.0 { value / of } else { 0.0 };
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

/// Rows of the table: names, and which pixels they hold.
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

/// Compares `maps` with `truth`, block by block. A pigment is present where its share of the paint that is seen is
/// `least` or more; smaller shares are traces, which are neither right nor wrong to tell.
///
/// # Errors
/// [`TruthError`] if one of both cannot be read, or they are of different scans.
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
            let trial = trial(&told, index, shares, least);
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

/// Column of the maps of each pigment of the truth; the number of columns where the maps have none.
fn columns_of(maps: &StoredMaps, truth: &Truth) -> Vec<usize> {
    let groups = &maps.attributes().get("settings").unwrap_or(&Value::Null)["groups"];
    let holds = |column: &String, pigment: &String| match groups[column.as_str()].as_array() {
        Some(group) => group.iter().any(|name| name.as_str() == Some(pigment)),
        None => column == pigment,
    };
    let column = |pigment| maps.pigments().iter().position(|column| holds(column, pigment));
    truth.pigments().iter().map(|p| column(p).unwrap_or(maps.pigments().len())).collect()
}

/// The trial of a pixel, with a last column for pigments that the maps do not know.
fn trial(
    maps: &crate::pixel_maps::BlockMaps,
    index: usize,
    mut shares: Vec<f64>,
    least: f64,
) -> Trial {
    let unknown = shares.pop().unwrap_or(0.0);
    let mut trial = Trial { least, ..Trial::of_map(maps, index, &shares) };
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
