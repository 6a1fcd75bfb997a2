//! A library of calibrated pigments on one wavelength grid.

use std::io::{self, Read};
use std::ops::{Index, IndexMut};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use spectra::Grid;
use spectra::optics::{Surface, UnevenFilm};

use super::recipe_error::RecipeError;
use crate::curves::Curves;
use crate::fit_settings::FitSettings;
use crate::recipe::{PigmentId, Recipe};

/// Allowed range of a part. Sums with larger parts lose their small terms to rounding.
const PARTS: std::ops::RangeInclusive<f64> = 0.0..=1e12;
/// Least sum of parts that can be normalised.
const LEAST_TOTAL: f64 = 1e-12;

/// Meaning of the amounts in a recipe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AmountKind {
    /// Shares of a mixture, of which only the ratios count. K and S are relative to the S of the
    /// reference white.
    #[default]
    Relative,
    /// Amounts on a fixed area. K and S are per unit of amount.
    Absolute,
}

/// One calibrated pigment of a library.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pigment {
    /// Name of the pigment, unique in its library.
    pub name: String,
    /// Colour Index name, such as `PB29`; `None` if unknown.
    #[serde(rename = "colour_index", default, skip_serializing_if = "Option::is_none")]
    pub color_index: Option<String>,
    /// K at each wavelength of the library's grid, 0 and up.
    pub absorption: Vec<f64>,
    /// S at each wavelength of the library's grid, 0 and up.
    pub scattering: Vec<f64>,
    /// Standard deviation of K at each wavelength; empty if unknown.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub absorption_sd: Vec<f64>,
    /// Standard deviation of S at each wavelength; empty if unknown.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scattering_sd: Vec<f64>,
    /// Whether S is known. If not, `scattering` is 1 at every wavelength, and `notes` say so.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub identified: bool,
    /// Whether K and S were guessed from a colour rather than measured.
    #[serde(default, skip_serializing_if = "is_no")]
    pub guessed: bool,
    /// Least and greatest amount above 0 of the measured films. Only absolute amounts have such limits,
    /// and files of older versions do not state them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured_amounts: Option<[f64; 2]>,
    /// Warnings about the pigment, in words for the user.
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

/// A file from which the library was made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Path of the file, as the user named it.
    pub path: String,
    /// SHA-256 of the bytes, in hexadecimal.
    pub sha256: String,
}

impl Input {
    /// Record of the file `path` with the content of `reader`, which is never in memory as a whole.
    ///
    /// # Errors
    /// The error of `reader`.
    pub fn of_reader(path: impl Into<String>, mut reader: impl Read) -> io::Result<Self> {
        let mut hasher = Sha256::new();
        let mut buffer = vec![0; 1 << 16];
        loop {
            let length = match reader.read(&mut buffer) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                other => other?,
            };
            if length == 0 {
                break;
            }
            hasher.update(&buffer[..length]);
        }
        let sha256 = hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { path: path.into(), sha256 })
    }

    /// Record of the file `path` with the given content.
    #[must_use]
    pub fn new(path: impl Into<String>, content: &[u8]) -> Self {
        let sha256 = Sha256::digest(content).iter().map(|byte| format!("{byte:02x}")).collect();
        Self { path: path.into(), sha256 }
    }
}

/// Error of a fit for one sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SampleEvidence {
    /// Name of the sample.
    pub sample: String,
    /// CIEDE2000 between measured and fitted colour.
    pub delta_e: f64,
}

/// Errors of a fit over all its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// Name of the light under which colour errors are computed.
    pub illuminant: String,
    /// Name of the observer for which colour errors are computed.
    pub observer: String,
    /// Root mean square error of measured reflectance.
    pub rms: f64,
    /// Summary of the colour errors in CIEDE2000.
    pub delta_e: crate::evaluate::Summary,
    /// Colour error of each sample, in order of the file.
    pub per_sample: Vec<SampleEvidence>,
    /// Quantities that the data do not identify, and inconsistent data, in words.
    pub warnings: Vec<String>,
}

/// Calibrated pigments that can be mixed, with their sources.
///
/// ```
/// use pigment::{PigmentLibrary, Viewing};
///
/// let oils = PigmentLibrary::van_gogh_oils();
/// let color = oils.color([("Zinc White", 9.0), ("Cobalt Blue", 1.0)], &Viewing::default())?;
/// assert_eq!(color.hex(), "#5698e4");
/// # Ok::<(), pigment::ColorError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PigmentLibrary {
    /// Title of the library.
    pub title: String,
    /// Licence of the values.
    pub licence: String,
    /// Source of the measurements.
    pub source: String,
    /// Wavelengths of all K and S.
    pub grid: Grid,
    /// Meaning of the amounts in a recipe.
    #[serde(default)]
    pub amounts: AmountKind,
    /// Name of the pigment whose S is 1 at every wavelength; `None` for absolute amounts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// Surface of the measured films (Saunderson correction).
    pub saunderson: Surface,
    /// Unevenness of the measured films, see [`UnevenFilm`]; 0 to 2. Only absolute amounts reveal
    /// it.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub unevenness: f64,
    /// Measurement files from which the library was made.
    #[serde(default)]
    pub inputs: Vec<Input>,
    /// Settings of the fit; `None` for a library made otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub settings: Option<FitSettings>,
    /// The pigments; at least one, no two with the same name.
    pub pigments: Vec<Pigment>,
    /// Errors of the fit; `None` for a library made otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Evidence>,
}

impl PigmentLibrary {
    /// A library of relative amounts without pigments. Title, licence and source are empty.
    #[must_use]
    pub fn empty(grid: Grid, surface: Surface) -> Self {
        Self {
            title: String::new(),
            licence: String::new(),
            source: String::new(),
            grid,
            amounts: AmountKind::Relative,
            reference: None,
            saunderson: surface,
            unevenness: 0.0,
            inputs: Vec::new(),
            settings: None,
            pigments: Vec::new(),
            evidence: None,
        }
    }

    /// Finds a pigment by `name`. Tries, in this order, the exact name, the name in any letter case, and the
    /// start of a name in any letter case if only one pigment has it.
    ///
    /// # Errors
    /// [`RecipeError`] if no pigment or several match.
    pub fn find(&self, name: &str) -> Result<PigmentId, RecipeError> {
        let name = name.trim();
        let lower = name.to_lowercase();
        let lowered: Vec<String> = self.pigments.iter().map(|p| p.name.to_lowercase()).collect();
        if let Some(index) = self.pigments.iter().position(|p| p.name == name) {
            return Ok(PigmentId(index));
        }
        if let Some(index) = lowered.iter().position(|n| *n == lower) {
            return Ok(PigmentId(index));
        }
        let mut starting = (0..lowered.len()).filter(|&i| lowered[i].starts_with(&lower));
        match (starting.next(), starting.next()) {
            (Some(index), None) => Ok(PigmentId(index)),
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

    /// All pigments of the library by their place, in order.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = PigmentId> + Clone + use<> {
        (0..self.pigments.len()).map(PigmentId)
    }

    /// Place of the reference white; `None` if the library has none.
    #[must_use]
    pub fn reference_id(&self) -> Option<PigmentId> {
        let name = self.reference.as_ref()?;
        self.ids().find(|&id| self[id].name == *name)
    }

    /// K and S of one pigment, with their grid.
    ///
    /// # Panics
    /// If `pigment` belongs to a larger library.
    #[must_use]
    pub fn curves(&self, pigment: PigmentId) -> Curves {
        let Pigment { absorption, scattering, .. } = self[pigment].clone();
        Curves { grid: self.grid, absorption, scattering }
    }

    /// Mean colour error of the fit in CIEDE2000, as its evidence records it: about how far a mixture is from
    /// its prediction. `None` for a library made otherwise.
    #[must_use]
    pub fn mean_error(&self) -> Option<f64> {
        self.evidence.as_ref().map(|evidence| evidence.delta_e.mean)
    }

    /// Film model that predicts the measured films: their surface and unevenness.
    #[must_use]
    pub fn film(&self) -> UnevenFilm {
        UnevenFilm { surface: self.saunderson, unevenness: self.unevenness }
    }

    /// Recipe of pigments by name, each with its parts. Names are looked up by [`Self::find`].
    ///
    /// # Errors
    /// [`RecipeError`] for a name that matches no pigment or several.
    pub fn recipe<N: AsRef<str>>(
        &self,
        parts: impl IntoIterator<Item = (N, f64)>,
    ) -> Result<Recipe, RecipeError> {
        parts.into_iter().map(|(name, part)| Ok((self.find(name.as_ref())?, part))).collect()
    }

    /// K and S of a recipe. Parts of a relative library are normalised to sum 1, so that a given thickness
    /// means the same film for any total of the parts.
    ///
    /// # Errors
    /// [`RecipeError::Parts`] unless every part is 0 to 1e12 and they sum to 1e-12 or more.
    ///
    /// # Panics
    /// If a pigment belongs to a larger library.
    pub fn mix(&self, recipe: impl AsRef<[(PigmentId, f64)]>) -> Result<Curves, RecipeError> {
        let parts = self.parts(recipe)?;
        let weighted = parts.iter().map(|&(id, part)| {
            let pigment = &self[id];
            (part, pigment.absorption.as_slice(), pigment.scattering.as_slice())
        });
        Ok(Curves::weighted_sum(self.grid, weighted))
    }

    /// Parts of a recipe as K and S are weighted by them: normalised to sum 1 in a relative library.
    ///
    /// # Errors
    /// [`RecipeError::Parts`] unless every part is 0 to 1e12 and they sum to 1e-12 or more.
    pub fn parts(
        &self,
        recipe: impl AsRef<[(PigmentId, f64)]>,
    ) -> Result<Vec<(PigmentId, f64)>, RecipeError> {
        let parts = recipe.as_ref();
        if let Some((_, part)) = parts.iter().find(|(_, part)| !PARTS.contains(part)) {
            return Err(RecipeError::Parts { parts: *part });
        }
        let total: f64 = parts.iter().map(|(_, part)| part).sum();
        if total < LEAST_TOTAL {
            return Err(RecipeError::Parts { parts: total });
        }
        let scale = if self.amounts == AmountKind::Relative { 1.0 / total } else { 1.0 };
        Ok(parts.iter().map(|&(id, part)| (id, part * scale)).collect())
    }
}

impl Index<PigmentId> for PigmentLibrary {
    type Output = Pigment;

    fn index(&self, pigment: PigmentId) -> &Pigment {
        &self.pigments[pigment.0]
    }
}

impl IndexMut<PigmentId> for PigmentLibrary {
    fn index_mut(&mut self, pigment: PigmentId) -> &mut Pigment {
        &mut self.pigments[pigment.0]
    }
}
