//! A primed panel.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{GroundError, within};
use graphics::field::Field;
use graphics::noise::{Hills, random};

/// A smooth panel, nearly flat: faint marks of the brush that primed it, along x,
/// sanded down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Panel {
    /// The same seed, the same panel.
    pub seed: u64,
    /// From the usual hollow to the usual height, in mm.
    pub relief_mm: f64,
}

impl Default for Panel {
    fn default() -> Self {
        Self { seed: 1, relief_mm: 0.012 }
    }
}

impl Panel {
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
        let mut random = random(self.seed, 2);
        let [marks, fine, sway, rub] = [(); 4].map(|()| Hills::new(&mut random));
        let mm = cell_mm as f32;
        let mut heights = Field::filled(width, height, 0.0);
        heights.values_mut().par_iter_mut().enumerate().for_each(|(index, out)| {
            let (x, y) = (mm * (index % width) as f32, mm * (index / width) as f32);
            // Strokes are not quite straight; marks of bristles are long and thin.
            let across = y + 1.5 * sway.at(x / 60.0, y / 25.0);
            let bristles =
                0.6 * marks.at(x / 30.0, across / 0.9) + 0.4 * fine.at(x / 18.0, across / 0.35);
            let left = 0.6 + 0.4 * rub.at(x / 14.0, y / 9.0);
            *out = (relief * (0.5 + left * bristles)).max(0.0);
        });
        Ok(heights)
    }
}
