//! Watercolour paper.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{GroundError, within};
use graphics::field::Field;
use graphics::noise::{Hills, random};

/// How watercolour paper was pressed, which decides its grain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Making {
    /// Between felts without heat: an even grain.
    #[default]
    ColdPressed,
    /// Hardly at all: deep and coarse.
    Rough,
    /// Between hot rollers: nearly smooth.
    HotPressed,
}

/// Watercolour paper: the mark of the felt it was pressed against, bumps of half a
/// millimetre to three, flattened on top.
///
/// Profiles of cold-pressed papers are 0.05 to 0.1 mm deep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, from = "Told")]
pub struct Paper {
    /// The same seed, the same paper.
    pub seed: u64,
    /// From the usual hollow to the usual height, in mm.
    pub relief_mm: f64,
    /// How it was pressed.
    #[serde(skip_serializing_if = "Making::is_usual")]
    pub making: Making,
}

/// A paper as a file tells it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Told {
    seed: Option<u64>,
    relief_mm: Option<f64>,
    making: Option<Making>,
}

impl From<Told> for Paper {
    fn from(told: Told) -> Self {
        let usual = Self::of(told.making.unwrap_or_default(), told.seed.unwrap_or(1));
        Self { relief_mm: told.relief_mm.unwrap_or(usual.relief_mm), ..usual }
    }
}

impl Default for Paper {
    fn default() -> Self {
        Self::of(Making::ColdPressed, 1)
    }
}

/// A size of bumps: their width in mm, what share of the relief they have, and by
/// how many degrees their lattice is turned, so that none shows.
type Bumps = (f64, f32, f64);

impl Making {
    /// The usual relief in mm.
    #[must_use]
    pub fn relief_mm(self) -> f64 {
        match self {
            Self::ColdPressed => 0.08,
            Self::Rough => 0.13,
            Self::HotPressed => 0.02,
        }
    }

    fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    fn bumps(self) -> [Bumps; 4] {
        match self {
            Self::ColdPressed => {
                [(2.6, 0.30, 17.0), (1.3, 0.42, 41.0), (0.65, 0.25, 68.0), (0.3, 0.10, 5.0)]
            }
            Self::Rough => {
                [(3.6, 0.34, 17.0), (1.9, 0.46, 41.0), (0.9, 0.20, 68.0), (0.4, 0.07, 5.0)]
            }
            Self::HotPressed => {
                [(2.6, 0.20, 17.0), (0.9, 0.30, 41.0), (0.45, 0.30, 68.0), (0.22, 0.20, 5.0)]
            }
        }
    }
}

impl Paper {
    /// Paper of the usual relief of its making.
    #[must_use]
    pub fn of(making: Making, seed: u64) -> Self {
        Self { seed, relief_mm: making.relief_mm(), making }
    }

    /// Heights over `width` x `height` cells of `cell_mm`, in mm.
    ///
    /// # Errors
    /// [`GroundError::Figure`].
    pub fn heights_mm(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
    ) -> Result<Field<f32>, GroundError> {
        let relief = within("relief_mm", " mm", self.relief_mm, [0.0, 2.0])? as f32;
        let mut random = random(self.seed, 1);
        let layers = self.making.bumps().map(|(size_mm, share, degrees)| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let step = cell_mm / size_mm;
            (Hills::new(&mut random), share, [cos * step, sin * step].map(|v| v as f32))
        });
        let mut heights = Field::filled(width, height, 0.0);
        heights.values_mut().par_iter_mut().enumerate().for_each(|(index, out)| {
            let (x, y) = ((index % width) as f32, (index / width) as f32);
            let sum: f32 = layers
                .iter()
                .map(|(hills, share, [c, s])| share * hills.at(x * c - y * s, x * s + y * c))
                .sum();
            // Pressed: heights are cut off softly, hollows less so.
            let pressed = if sum > 0.0 { sum / (1.0 + 1.5 * sum) } else { sum / (1.0 - 0.3 * sum) };
            *out = (relief * (0.65 + 1.3 * pressed)).max(0.0);
        });
        Ok(heights)
    }
}
