//! Watercolour paper, from its finish and a seed.

use serde::{Deserialize, Serialize};

use super::error::GroundError;
use super::relief::{self, Stream};
use graphics::field::Field;
use graphics::noise::Hills;

/// Finish of watercolour paper: how it was pressed, which decides its grain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PaperFinish {
    /// Pressed between felts without heat: an even grain.
    #[default]
    ColdPressed,
    /// Hardly pressed: a deep, coarse grain.
    Rough,
    /// Pressed between hot rollers: nearly smooth.
    HotPressed,
}

/// Settings of watercolour paper: the imprint of the felt it was pressed against, bumps 0.3
/// to 3.6 mm wide with flattened tops.
///
/// Profiles of cold-pressed papers are 0.05 to 0.1 mm deep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, from = "PaperFields")]
pub struct Paper {
    /// Seed of the grain, 1 by default.
    pub seed: u64,
    /// Height from an average hollow to an average bump in mm, 0 to 2; by default that of
    /// the finish.
    pub relief_mm: f64,
    /// Finish of the paper, cold-pressed by default.
    #[serde(rename = "making", skip_serializing_if = "PaperFinish::is_default")]
    pub finish: PaperFinish,
}

/// Fields of a paper in a file, all optional.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PaperFields {
    seed: Option<u64>,
    relief_mm: Option<f64>,
    making: Option<PaperFinish>,
}

impl From<PaperFields> for Paper {
    fn from(fields: PaperFields) -> Self {
        let default = Self::of(fields.making.unwrap_or_default(), fields.seed.unwrap_or(1));
        Self { relief_mm: fields.relief_mm.unwrap_or(default.relief_mm), ..default }
    }
}

impl Default for Paper {
    fn default() -> Self {
        Self::of(PaperFinish::ColdPressed, 1)
    }
}

/// One octave of bumps: their width in mm, their share of the relief, and the rotation of
/// their noise lattice in degrees, which hides its axes.
type Bumps = (f64, f32, f64);

impl PaperFinish {
    /// Average relief of papers of this finish, in mm.
    #[must_use]
    pub fn relief_mm(self) -> f64 {
        match self {
            Self::ColdPressed => 0.08,
            Self::Rough => 0.13,
            Self::HotPressed => 0.02,
        }
    }

    fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Octaves of the grain, chosen by eye.
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
    /// Paper with the average relief of its finish.
    #[must_use]
    pub fn of(finish: PaperFinish, seed: u64) -> Self {
        Self { seed, relief_mm: finish.relief_mm(), finish }
    }

    /// Heights in mm of `width` x `height` cells, each `cell_mm` wide.
    ///
    /// # Errors
    /// [`GroundError::OutOfRange`].
    pub fn heights_mm(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
    ) -> Result<Field<f32>, GroundError> {
        let (relief, mut random) = relief::set_up(self.relief_mm, self.seed, Stream::Paper)?;
        let octaves = self.finish.bumps().map(|(size_mm, share, degrees)| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let step = cell_mm / size_mm;
            (Hills::new(&mut random), share, [cos * step, sin * step].map(|v| v as f32))
        });
        Ok(relief::heights_mm(width, height, |x, y| {
            let x = x as f32;
            let y = y as f32;
            let sum: f32 = octaves
                .iter()
                .map(|(hills, share, [c, s])| share * hills.at(x * c - y * s, x * s + y * c))
                .sum();
            // Pressing flattens bumps strongly and hollows slightly: a soft limit for each.
            let pressed = if sum > 0.0 { sum / (1.0 + 1.5 * sum) } else { sum / (1.0 - 0.3 * sum) };
            relief * (0.65 + 1.3 * pressed)
        }))
    }
}
