//! A wooden palette.

use serde::{Deserialize, Serialize};

use super::error::GroundError;
use super::primer::{ColorPrimer, Primer};
use super::relief::{self, Stream};
use crate::optics::Gloss;
use graphics::field::Field;
use graphics::noise::Hills;

/// Settings of varnished walnut, as painters' palettes are made of: long fibres along x,
/// growth rings, and open pores that the varnish has not filled.
///
/// The depth was chosen by eye: deep enough to look like wood, too shallow to catch a
/// brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Wood {
    /// Seed of the grain, 1 by default.
    pub seed: u64,
    /// Height from the bottom of an average pore to the average surface in mm, 0 to 2; 0.1
    /// by default.
    pub relief_mm: f64,
}

impl Default for Wood {
    fn default() -> Self {
        Self { seed: 1, relief_mm: 0.1 }
    }
}

/// Average distance of growth rings, in mm.
const RING_MM: f32 = 5.0;

impl Wood {
    /// Default colour: walnut brown.
    pub(super) fn walnut() -> Primer {
        Primer::Color(ColorPrimer { rgb: "#7a5433".to_owned() })
    }

    /// Default gloss: that of varnish.
    pub(super) const VARNISH: Gloss = Gloss { strength: 0.2, exponent: 40.0 };

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
        let (relief, mut random) = relief::set_up(self.relief_mm, self.seed, Stream::Wood)?;
        let [sway, drift, fibres, fine, pores, open] = [(); 6].map(|()| Hills::new(&mut random));
        let mm = cell_mm as f32;
        Ok(relief::heights_mm(width, height, |x, y| {
            let x = mm * x as f32;
            let y = mm * y as f32;
            // Fibres follow the rings, which sway along the trunk.
            let across =
                y + 9.0 * sway.at(x / 160.0, y / 50.0) + 1.2 * drift.at(x / 45.0, y / 12.0);
            let ring = (across / RING_MM + 0.6 * drift.at(across / 17.0, 0.3)).rem_euclid(1.0);
            // Dense latewood stands higher; the next ring begins abruptly.
            let late = ring * ring * (1.0 - ring.powi(8));
            let grain =
                0.6 * fibres.at(x / 26.0, across / 1.1) + 0.4 * fine.at(x / 11.0, across / 0.55);
            // Pores: more of them in earlywood, each some millimetres long.
            let open = 0.15 * open.at(x / 30.0, across / 4.0) - 0.3 * late - 0.4;
            let depth = (3.0 * (pores.at(x / 5.0, across / 0.45) + open)).clamp(0.0, 1.0);
            relief * (0.7 + 0.4 * grain + 0.35 * late - 0.6 * depth)
        }))
    }
}
