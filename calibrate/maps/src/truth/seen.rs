//! Truth of rows: shares of the visible paint, blurred as the camera blurs light, and the arrays that store
//! them.

use std::ops::Range;
use std::path::PathBuf;

use documents::file::FileError;
use documents::hint::Explain;
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use crate::camera::Camera;
use crate::store::StoreError;

/// How many parts the truth of a pixel has. First come pigments, then layers, then the ground.
/// Pigments and ground sum to 1, and so do layers and ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TruthParts {
    /// Number of pigments.
    pub pigments: usize,
    /// Number of layers.
    pub layers: usize,
}

impl TruthParts {
    /// Number of values of a pixel.
    #[must_use]
    pub fn count(&self) -> usize {
        self.pigments + self.layers + 1
    }
}

/// Truth of the pixels of some rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TruthRows {
    /// Number of pigments.
    pub pigments: usize,
    /// Share of each pigment in the visible paint, with sum 1. If there is no paint, all are 0.
    pub share: Vec<f32>,
    /// Part of the pixel that shows the ground, 0 to 1.
    pub ground: Vec<f32>,
    /// Mean reflectance over the bands, before drift and noise.
    pub mean_reflectance: Vec<f32>,
    /// Kind of each pixel.
    pub class: Vec<PaintClass>,
}

/// Truth of `rows`. Pass the `mean_reflectance` that the camera reported. `of(line)` must give the
/// parts of a row, pixel by pixel in the order of [`TruthParts`].
#[must_use]
pub fn truth_rows(
    camera: &Camera,
    parts: TruthParts,
    rows: Range<usize>,
    mean_reflectance: Vec<f32>,
    of: &(dyn Fn(usize) -> Vec<f64> + Sync),
) -> TruthRows {
    let count = parts.count();
    let blurred = camera.blurred(rows.clone(), of);
    let each: Vec<TruthRows> = (blurred.par_iter().zip(rows))
        .map(|(blurred, line)| {
            let mut truth = TruthRows::default();
            let own = of(line);
            for (seen, own) in blurred.chunks_exact(count).zip(own.chunks_exact(count)) {
                let shares = shares(seen, parts);
                let apart = shares.iter().zip(self::shares(own, parts));
                let apart: f64 = apart.map(|(a, b)| 0.5 * (a - b).abs()).sum();
                let ground = seen[count - 1];
                let layers = &seen[parts.pigments..count - 1];
                let paint: f64 = layers.iter().sum();
                let greatest = layers.iter().copied().fold(0.0, f64::max) / paint.max(1e-12);
                truth.class.push(PaintClass::of(ground, greatest, apart));
                truth.ground.push(ground as f32);
                truth.share.extend(shares.iter().map(|share| *share as f32));
            }
            truth
        })
        .collect();
    let mut all = TruthRows { pigments: parts.pigments, mean_reflectance, ..TruthRows::default() };
    for line in each {
        all.share.extend(line.share);
        all.ground.extend(line.ground);
        all.class.extend(line.class);
    }
    all
}

/// Shares of the pigments in the paint alone.
fn shares(parts: &[f64], TruthParts { pigments, .. }: TruthParts) -> Vec<f64> {
    let sum: f64 = parts[..pigments].iter().sum();
    let factor = if sum > 1e-9 { 1.0 / sum } else { 0.0 };
    parts[..pigments].iter().map(|part| part * factor).collect()
}

/// A film is thin if this part of the pixel shows the ground.
const THIN: f64 = 0.05;
/// If this part of the pixel shows the ground, we see no paint.
const BARE: f64 = 0.95;
/// A layer counts as seen alone if it has this part of all paint.
const ALONE: f64 = 0.95;
/// A pixel is at an edge if the blur changes its shares by more than this (half the sum of absolute
/// differences).
const EDGE: f64 = 0.1;

/// Kind of a pixel by the paint that you see there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum PaintClass {
    /// One layer of one mixture hides all below it. Maps assume this of every pixel.
    Hiding = 0,
    /// You see two layers or more through each other, e.g. a glaze on white.
    Glaze = 1,
    /// The ground shows through by 5 % or more.
    Thin = 2,
    /// The ground shows by 95 % or more.
    Bare = 3,
    /// The blur of the camera mixes paints of different shares: an edge.
    Edge = 4,
}

impl PaintClass {
    /// Every class in the order of its number.
    pub const ALL: [Self; 5] = [Self::Hiding, Self::Glaze, Self::Thin, Self::Bare, Self::Edge];

    /// Number that files store.
    #[must_use]
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// Class of a stored number.
    #[must_use]
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.get(usize::from(code)).copied()
    }

    /// Name in files and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hiding => "hiding",
            Self::Glaze => "glaze",
            Self::Thin => "thin",
            Self::Bare => "bare",
            Self::Edge => "edge",
        }
    }

    /// Class of a pixel. `ground` is the part of it that shows the ground. `greatest` is the part
    /// of the visible paint that belongs to the most visible layer. `apart` is half the sum of the
    /// absolute differences between the pixel's own shares and the blurred ones.
    #[must_use]
    pub fn of(ground: f64, greatest: f64, apart: f64) -> Self {
        match (ground, greatest, apart) {
            (ground, ..) if ground >= BARE => Self::Bare,
            (ground, ..) if ground >= THIN => Self::Thin,
            (_, _, apart) if apart > EDGE => Self::Edge,
            (_, greatest, _) if greatest < ALONE => Self::Glaze,
            _ => Self::Hiding,
        }
    }
}

/// Title of the group, by which we recognise it.
pub(super) const TITLE: &str = "truth of a simulated scan";

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TruthArray {
    Share,
    Ground,
    MeanReflectance,
    Class,
}

impl TruthArray {
    pub(super) const ALL: [Self; 4] =
        [Self::Share, Self::Ground, Self::MeanReflectance, Self::Class];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Share => "share",
            Self::Ground => "ground",
            Self::MeanReflectance => "mean_reflectance",
            Self::Class => "class",
        }
    }

    pub(super) const fn data_type(self) -> &'static str {
        match self {
            Self::Class => "uint8",
            _ => "float32",
        }
    }

    pub(super) const fn bytes(self) -> usize {
        match self {
            Self::Class => 1,
            _ => 4,
        }
    }

    /// Sizes of the array, or of a part of it, for `down` x `across` pixels.
    pub(super) fn sizes(self, down: usize, across: usize, pigments: usize) -> Vec<usize> {
        match self {
            Self::Share => vec![down, across, pigments],
            _ => vec![down, across],
        }
    }

    pub(super) const fn dimensions(self) -> &'static [&'static str] {
        match self {
            Self::Share => &["y", "x", "pigment"],
            _ => &["y", "x"],
        }
    }

    pub(super) fn attributes(self) -> Map<String, Value> {
        let attributes = match self {
            Self::Share => json!({
                "long_name": "share of the pigment in the paint that is seen", "units": "1"
            }),
            Self::Ground => {
                json!({"long_name": "part of the ground in what is seen", "units": "1"})
            }
            Self::MeanReflectance => {
                json!({"long_name": "mean reflectance over the bands, without noise", "units": "1"})
            }
            Self::Class => json!({
                "long_name": "kind of the paint",
                "flag_values": PaintClass::ALL.map(PaintClass::code),
                "flag_meanings": PaintClass::ALL.map(PaintClass::name).join(" ")
            }),
        };
        match attributes {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }
}

/// We cannot write, read or compare truth.
#[derive(Debug, thiserror::Error, Explain)]
pub enum TruthError {
    /// We cannot read or write a file.
    #[error(transparent)]
    File(#[from] FileError),
    /// We cannot read the maps.
    #[error(transparent)]
    Maps(#[from] StoreError),
    /// The folder holds something else.
    #[error("{}: holds files that are not the truth of a simulated scan", .0.display())]
    #[hint("name another folder, or empty this one")]
    #[fault(Setting)]
    Exists(PathBuf),
    /// The folder does not hold truth, or it is damaged.
    #[error("{}: {problem}", path.display())]
    #[hint("simulate the scan again")]
    Damaged {
        /// Path of the file or folder.
        path: PathBuf,
        /// The fault that we found.
        problem: String,
    },
    /// Rows do not fit the truth that you write.
    #[error("{}: {problem}", path.display())]
    Rows {
        /// Path of the folder.
        path: PathBuf,
        /// The numbers that disagree.
        problem: String,
    },
    /// Maps and truth belong to different scans.
    #[error(
        "{}: the maps end at row {} and column {}, the truth has {lines} x {samples} pixels",
        path.display(), ends.0, ends.1
    )]
    #[hint("name the truth of the scan that was mapped")]
    #[fault(Setting)]
    Size {
        /// Path of the truth.
        path: PathBuf,
        /// Ends of the mapped rows and columns.
        ends: (usize, usize),
        /// Rows of the truth.
        lines: usize,
        /// Columns of the truth.
        samples: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_survive_their_numbers_and_follow_the_paint() {
        for class in PaintClass::ALL {
            assert_eq!(PaintClass::from_code(class.code()), Some(class));
        }
        assert_eq!(PaintClass::from_code(5), None);
        assert_eq!(PaintClass::of(0.97, 1.0, 0.0), PaintClass::Bare);
        assert_eq!(PaintClass::of(0.2, 1.0, 0.0), PaintClass::Thin);
        assert_eq!(PaintClass::of(0.01, 0.6, 0.0), PaintClass::Glaze);
        assert_eq!(PaintClass::of(0.01, 0.99, 0.3), PaintClass::Edge);
        assert_eq!(PaintClass::of(0.01, 0.99, 0.02), PaintClass::Hiding);
    }
}
