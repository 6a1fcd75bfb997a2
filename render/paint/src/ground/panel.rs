//! A primed panel.

use serde::{Deserialize, Serialize};

use super::error::GroundError;
use super::relief::{self, Stream};
use graphics::field::Field;
use graphics::noise::Hills;

/// Settings of a smooth, nearly flat panel: the brush that primed it left faint marks along
/// x, which were sanded down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Panel {
    /// Seed of the brush marks, 1 by default.
    pub seed: u64,
    /// Height from an average hollow to an average ridge in mm, 0 to 2; 0.012 by default.
    pub relief_mm: f64,
}

impl Default for Panel {
    fn default() -> Self {
        Self { seed: 1, relief_mm: 0.012 }
    }
}

impl Panel {
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
        let (relief, mut random) = relief::set_up(self.relief_mm, self.seed, Stream::Panel)?;
        let [marks, fine, sway, rub] = [(); 4].map(|()| Hills::new(&mut random));
        let mm = cell_mm as f32;
        Ok(relief::heights_mm(width, height, |x, y| {
            let x = mm * x as f32;
            let y = mm * y as f32;
            // Strokes are not quite straight; marks of bristles are long and thin.
            let across = y + 1.5 * sway.at(x / 60.0, y / 25.0);
            let bristles =
                0.6 * marks.at(x / 30.0, across / 0.9) + 0.4 * fine.at(x / 18.0, across / 0.35);
            let left = 0.6 + 0.4 * rub.at(x / 14.0, y / 9.0);
            relief * (0.5 + left * bristles)
        }))
    }
}
