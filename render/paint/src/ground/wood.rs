//! A wooden palette.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::primer::{ColorPrimer, Primer};
use super::{GroundError, within};
use crate::optics::Gloss;
use graphics::field::Field;
use graphics::noise::{Hills, random};

/// Varnished walnut, as of a painter's palette: long fibres along x, growth rings
/// between them, and open pores that the varnish has not filled.
///
/// How deep is ours, chosen by eye: deep enough to be seen as wood by its relief
/// alone, too shallow to hold a brush up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Wood {
    /// The same seed, the same board.
    pub seed: u64,
    /// From the bottom of a usual pore to the usual height, in mm.
    pub relief_mm: f64,
}

impl Default for Wood {
    fn default() -> Self {
        Self { seed: 1, relief_mm: 0.1 }
    }
}

/// From one growth ring to the next, in mm, about.
const RING_MM: f32 = 5.0;

impl Wood {
    /// What it reflects if nothing else is said: a walnut brown.
    pub(super) fn walnut() -> Primer {
        Primer::Color(ColorPrimer { rgb: "#7a5433".to_owned() })
    }

    /// The shine of its varnish.
    pub(super) const VARNISH: Gloss = Gloss { strength: 0.2, exponent: 40.0 };

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
        let mut random = random(self.seed, 3);
        let [sway, drift, fibres, fine, pores, open] = [(); 6].map(|()| Hills::new(&mut random));
        let mm = cell_mm as f32;
        let mut heights = Field::filled(width, height, 0.0);
        heights.values_mut().par_iter_mut().enumerate().for_each(|(index, out)| {
            let (x, y) = (mm * (index % width) as f32, mm * (index / width) as f32);
            // Fibres follow the rings, which sway along the trunk.
            let across =
                y + 9.0 * sway.at(x / 160.0, y / 50.0) + 1.2 * drift.at(x / 45.0, y / 12.0);
            let ring = (across / RING_MM + 0.6 * drift.at(across / 17.0, 0.3)).rem_euclid(1.0);
            // Wood of late summer is dense and stands higher, then the next spring
            // begins at once.
            let late = ring * ring * (1.0 - ring.powi(8));
            let grain =
                0.6 * fibres.at(x / 26.0, across / 1.1) + 0.4 * fine.at(x / 11.0, across / 0.55);
            // More of them in early wood, each some millimetres long.
            let open = 0.15 * open.at(x / 30.0, across / 4.0) - 0.3 * late - 0.4;
            let depth = (3.0 * (pores.at(x / 5.0, across / 0.45) + open)).clamp(0.0, 1.0);
            *out = (relief * (0.7 + 0.4 * grain + 0.35 * late - 0.6 * depth)).max(0.0);
        });
        Ok(heights)
    }
}
