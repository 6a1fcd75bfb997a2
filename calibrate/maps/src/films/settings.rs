//! Settings of a map.

use calibrate::{Residuals, ResidualsError};
use pigment::PigmentLibrary;

use super::ground::Ground;
use super::noise::{LEAST_MIXTURES, ModelError, USUAL_MODEL_ERROR};
use crate::map_error::MapError;

/// Pigments that a map shows as one.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PigmentGroup {
    /// Name of the group.
    pub name: String,
    /// Names of its pigments.
    pub pigments: Vec<String>,
}

/// Settings of [`Mapper::new`](crate::Mapper::new).
#[derive(Debug, Clone, PartialEq)]
pub struct MapSettings {
    /// Most pigments of a mixture, 1 to 4. Default: 3.
    pub at_most: usize,
    /// Names of the pigments that take part. Default: all of the library whose K and S are measured.
    pub palette: Vec<String>,
    /// Groups of pigments that are mapped as one. Default: none.
    pub groups: Vec<PigmentGroup>,
    /// Whether pigments that the bands cannot tell apart are mapped as one. Default: yes.
    pub group_alike: bool,
    /// Standard deviation of the noise of each band of the scan, in reflectance; 0 to 1. Default: 0.003.
    pub sensor_noise: f64,
    /// Error of the library's predictions. Default: for the library that ships the errors of the mixtures left
    /// out of its fit, for any other 10 % of K and S, with which the measured Van Gogh oils are unmixed best of
    /// 5 to 70 %.
    pub model_error: Option<ModelError>,
    /// Chi-square that a pigment must save beyond the prior, by which mixtures of any number of pigments are alike,
    /// unless the survey finds it in the palette; 0 to 100. Default: 2.
    pub penalty: f64,
    /// The bare ground, whose pixels are told and not mapped. Default: none, and bare ground is mapped as paint.
    pub ground: Option<Ground>,
}

impl Default for MapSettings {
    fn default() -> Self {
        Self {
            at_most: 3,
            palette: Vec::new(),
            groups: Vec::new(),
            group_alike: true,
            sensor_noise: 0.003,
            model_error: None,
            penalty: 2.0,
            ground: None,
        }
    }
}

impl MapSettings {
    /// Error of the predictions of `library`: as stated, else the usual one. Residuals are on the library's
    /// wavelengths.
    ///
    /// # Errors
    /// [`ResidualsError`] if residuals hold fewer than [`LEAST_MIXTURES`] mixtures, or do not cover the
    /// library's wavelengths.
    pub fn model_error_of(&self, library: &PigmentLibrary) -> Result<ModelError, ResidualsError> {
        let residuals = match &self.model_error {
            Some(ModelError::Stated(relative)) => return Ok(ModelError::Stated(*relative)),
            Some(ModelError::Residuals(residuals)) => residuals,
            None if *library == PigmentLibrary::van_gogh_oils() => &Residuals::van_gogh_oils(),
            None => return Ok(ModelError::Stated(USUAL_MODEL_ERROR)),
        };
        let found = residuals.mixtures.len();
        if found < LEAST_MIXTURES {
            return Err(ResidualsError::Few { found, least: LEAST_MIXTURES });
        }
        residuals.on_grid(library.grid).map(ModelError::Residuals)
    }

    /// Checks the range of every number.
    ///
    /// # Errors
    /// [`MapError::Setting`] for the first that is out of range.
    pub fn check(&self) -> Result<(), MapError> {
        let stated = match self.model_error {
            Some(ModelError::Stated(relative)) => relative,
            _ => 0.1,
        };
        let rows = [
            ("at_most", "1 to 4", self.at_most as f64, 1.0..=4.0),
            ("sensor_noise", "0 to 1", self.sensor_noise, 0.0..=1.0),
            ("model_error", "0.001 to 1", stated, 0.001..=1.0),
            ("penalty", "0 to 100", self.penalty, 0.0..=100.0),
        ];
        for (name, range, value, valid) in rows {
            if !valid.contains(&value) {
                return Err(MapError::Setting { name, range, value });
            }
        }
        Ok(())
    }
}
