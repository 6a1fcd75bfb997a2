//! Calibrated pigments on one grid.

use serde::{Deserialize, Serialize};
use spectra::Grid;
use spectra::optics::{Surface, UnevenFilm};

use crate::fit_settings::FitSettings;
use crate::mixture::Mixture;

/// What the amounts of a recipe mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AmountKind {
    /// Shares of a mixture; only their ratios count. K and S are relative to
    /// the S of the reference white.
    #[default]
    Relative,
    /// Amounts laid on a fixed area; K and S are per unit of amount.
    Absolute,
}

/// One calibrated pigment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pigment {
    /// Its name; no two of a library are alike.
    pub name: String,
    /// Colour Index name, such as `PB29`, if known.
    #[serde(rename = "colour_index", default, skip_serializing_if = "Option::is_none")]
    pub color_index: Option<String>,
    /// K at each wavelength, 0 and up.
    pub absorption: Vec<f64>,
    /// S at each wavelength, 0 and up.
    pub scattering: Vec<f64>,
    /// Standard deviation of K.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub absorption_sd: Vec<f64>,
    /// Standard deviation of S.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scattering_sd: Vec<f64>,
    /// Whether S is known; if not, `scattering` is a stand-in (see `notes`).
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub identified: bool,
    /// Whether K and S were made up from a colour rather than measured.
    #[serde(default, skip_serializing_if = "is_no")]
    pub guessed: bool,
    /// What a user must know of it, such as an S that was not identified.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

fn yes() -> bool {
    true
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_yes(value: &bool) -> bool {
    *value
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_no(value: &bool) -> bool {
    !*value
}

/// A file that the library was made from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// As the user named it.
    pub path: String,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

/// How well a fit reproduces one sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SampleEvidence {
    /// The sample.
    pub sample: String,
    /// CIEDE2000 between measured and fitted.
    pub delta_e: f64,
}

/// How well a fit reproduces its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// The light of the colour errors.
    pub illuminant: String,
    /// The observer of the colour errors.
    pub observer: String,
    /// Root mean square residual of measured reflectance.
    pub rms: f64,
    /// Mean, median, 90th percentile and largest CIEDE2000.
    pub delta_e: crate::evaluate::Summary,
    /// By sample, in order of the file.
    pub per_sample: Vec<SampleEvidence>,
    /// What the data could not tell, in words.
    pub warnings: Vec<String>,
}

/// Pigments that can be mixed, with where they come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PigmentLibrary {
    /// What the library is.
    pub title: String,
    /// Licence of the figures.
    pub licence: String,
    /// Where the measurements come from.
    pub source: String,
    /// The wavelengths of every K and S.
    pub grid: Grid,
    /// What recipes are written in.
    #[serde(default)]
    pub amounts: AmountKind,
    /// The pigment whose S is 1 at every wavelength; none for absolute amounts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// The surface of the measured films.
    pub saunderson: Surface,
    /// How uneven the measured films were, see [`UnevenFilm`]; only absolute
    /// amounts can tell.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub unevenness: f64,
    /// The measurement files.
    #[serde(default)]
    pub inputs: Vec<Input>,
    /// How the fit was made; none for a library made otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settings: Option<FitSettings>,
    /// The pigments.
    pub pigments: Vec<Pigment>,
    /// How well the fit reproduces its samples.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Evidence>,
}

impl PigmentLibrary {
    /// The index of the pigment called `name`: exactly, else without regard to
    /// case, else the only one whose name starts so.
    ///
    /// # Errors
    /// [`RecipeError`] if none or several fit.
    pub fn find(&self, name: &str) -> Result<usize, RecipeError> {
        let name = name.trim();
        let lower = name.to_lowercase();
        let lowered: Vec<String> = self.pigments.iter().map(|p| p.name.to_lowercase()).collect();
        if let Some(index) = self.pigments.iter().position(|p| p.name == name) {
            return Ok(index);
        }
        if let Some(index) = lowered.iter().position(|n| *n == lower) {
            return Ok(index);
        }
        let mut starting = (0..lowered.len()).filter(|&i| lowered[i].starts_with(&lower));
        match (starting.next(), starting.next()) {
            (Some(index), None) => Ok(index),
            (Some(first), Some(second)) => Err(RecipeError::Ambiguous {
                name: name.to_owned(),
                first: self.pigments[first].name.clone(),
                second: self.pigments[second].name.clone(),
            }),
            _ => Err(RecipeError::UnknownPigment {
                name: name.to_owned(),
                known: self.pigments.iter().map(|p| p.name.clone()).collect(),
            }),
        }
    }

    /// The film that this library's mixtures make.
    #[must_use]
    pub fn film(&self) -> UnevenFilm {
        UnevenFilm { surface: self.saunderson, unevenness: self.unevenness }
    }

    /// The mixture of `(pigment index, parts)`. Parts of a relative library are
    /// normalised to sum 1, so that its thickness keeps its meaning.
    ///
    /// # Errors
    /// [`RecipeError`] unless every part is 0 to 1e12 and they sum to 1e-12 or
    /// more.
    pub fn mix(&self, parts: &[(usize, f64)]) -> Result<Mixture, RecipeError> {
        if let Some((_, part)) = parts.iter().find(|(_, part)| !(0.0..=1e12).contains(part)) {
            return Err(RecipeError::Parts { parts: *part });
        }
        let total: f64 = parts.iter().map(|(_, part)| part).sum();
        if total < 1e-12 {
            return Err(RecipeError::Parts { parts: total });
        }
        let scale = if self.amounts == AmountKind::Relative { 1.0 / total } else { 1.0 };
        let weighted = parts.iter().map(|&(index, part)| {
            let pigment = &self.pigments[index];
            (part * scale, pigment.absorption.as_slice(), pigment.scattering.as_slice())
        });
        Ok(Mixture::of(self.grid.count(), weighted))
    }
}

/// A recipe that cannot be mixed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecipeError {
    /// No pigment has this name.
    #[error("the library has no pigment called `{name}`")]
    UnknownPigment {
        /// The name given.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// Several pigments start with this name.
    #[error("{first} and {second} both start with `{name}`")]
    Ambiguous {
        /// The name given.
        name: String,
        /// One pigment.
        first: String,
        /// Another.
        second: String,
    },
    /// Parts that make no mixture.
    #[error("parts are 0 to 1e12 and sum to 1e-12 or more, found `{parts}`")]
    Parts {
        /// What was given.
        parts: f64,
    },
}

impl RecipeError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::UnknownPigment { known, .. } => Some(format!("pigments: {}", known.join(", "))),
            Self::Ambiguous { .. } => Some("write more of the name".to_owned()),
            Self::Parts { .. } => None,
        }
    }
}
