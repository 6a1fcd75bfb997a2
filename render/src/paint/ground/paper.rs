//! Cold-pressed paper.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::noise::{Hills, random};
use super::{GroundError, within};
use crate::field::Field;

/// Cold-pressed watercolour paper: the mark of the felt it was pressed against,
/// bumps of half a millimetre to three, flattened on top.
///
/// Profiles of such papers are 0.05 to 0.1 mm deep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Paper {
    /// The same seed, the same paper.
    pub seed: u64,
    /// From the usual hollow to the usual height, in mm.
    pub relief_mm: f64,
}

impl Default for Paper {
    fn default() -> Self {
        Self { seed: 1, relief_mm: 0.08 }
    }
}

/// Widths of the bumps in mm, what share of the relief each has, and by how many
/// degrees their lattice is turned, so that none shows.
const BUMPS: [(f64, f32, f64); 4] =
    [(2.6, 0.30, 17.0), (1.3, 0.42, 41.0), (0.65, 0.25, 68.0), (0.3, 0.10, 5.0)];

impl Paper {
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
        let layers = BUMPS.map(|(size_mm, share, degrees)| {
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
