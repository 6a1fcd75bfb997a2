//! Settings of a map, and its noise: the sensor's noise and the error of the library's predictions.
//!
//! The errors of Kubelka-Munk predictions are smooth over wavelength and far greater than the
//! sensor's noise. We whiten spectra by the covariance of both before we compare them, so that
//! neighbouring bands with a common error do not count twice.

use calibrate::{Residuals, ResidualsError};
use nalgebra::{DMatrix, SymmetricEigen};
use pigment::PigmentLibrary;
use serde_json::{Value, json};

use super::bands::{Bands, Ground};
use crate::pixel_maps::MapError;

/// Pigments that a map shows as one.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PigmentGroup {
    /// Name of the group.
    pub name: String,
    /// Names of its pigments.
    pub pigments: Vec<String>,
}

/// Settings that you pass to [`Mapper::new`](crate::Mapper::new).
#[derive(Debug, Clone, PartialEq)]
pub struct MapSettings {
    /// Most pigments of a mixture, 1 to 4. Default: 4.
    pub at_most: usize,
    /// Names of the pigments that take part. Default: all pigments of the library with measured K and S.
    pub palette: Vec<String>,
    /// Groups of pigments to map as one. Default: none.
    pub groups: Vec<PigmentGroup>,
    /// Whether to map pigments as one if the bands cannot tell them apart. Default: yes.
    pub group_alike: bool,
    /// Standard deviation of the noise of each band of the scan, in reflectance, 0 to 1. Default:
    /// 0.003.
    pub sensor_noise: f64,
    /// Error of the library's predictions. Default: the errors of left-out mixtures for the library
    /// that we ship, and 10 % of K and S for any other. We tried 5 to 70 %, and 10 % unmixes the
    /// measured Van Gogh oils best.
    pub model_error: Option<ModelError>,
    /// Amount by which a further pigment must lower chi-square in a whole search, 0 to 100. This
    /// adds to the prior, which makes mixtures of any number of pigments equally likely. In a map
    /// the survey replaces both: it finds how often the scan holds each pigment. Default: 2.
    pub penalty: f64,
    /// The bare ground. We report its pixels and do not map them. If you leave this out (the
    /// default), bare ground looks like paint.
    pub ground: Option<Ground>,
}

impl Default for MapSettings {
    fn default() -> Self {
        Self {
            at_most: 4,
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
    /// Error of the predictions of `library`: the stated one, or else the usual one. Residuals are
    /// converted to the library's wavelengths.
    ///
    /// # Errors
    /// [`ResidualsError`] if residuals hold fewer than [`LEAST_MIXTURES`] mixtures, or do not cover
    /// the library's wavelengths.
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

/// We shrink the covariance of left-out residuals towards its diagonal by this part, because a few
/// dozen mixtures do not determine a covariance of 31 bands. We chose it on the Van Gogh oils,
/// where 0.3 to 0.6 give equal results.
const SHRINKAGE: f64 = 0.5;
/// Degrees of freedom of the residuals' distribution. Some mixtures err ten times as much as others, so
/// that their tails are heavier than normal ones. We chose it on the Van Gogh oils.
const TAIL: f64 = 10.0;
/// Beside stated errors, the light that the surface itself reflects varies by this standard
/// deviation, in reflectance. It is the same in all bands, and counts in dark paint most. Errors of
/// left-out mixtures hold it already.
const STATED_GLOSS: f64 = 0.003;
/// Correlation lengths in nm of stated errors of K and S, each with its part of the variance. The
/// rest of the variance is independent from band to band. We chose them on simulated paintings with
/// other seeds than the tests have. Longer ones give deviations that are too small.
const SMOOTH: [(f64, f64); 2] = [(60.0, 0.5), (30.0, 0.45)];
/// Relative error of K and S if you do not state one.
pub const USUAL_MODEL_ERROR: f64 = 0.1;
/// Factor on the variance of stated errors, because the errors of a mixture's pigments partly
/// cancel. For a mixture it is the sum of squares of the pigments' parts in K and in S: 2 for one
/// pigment, 1 for two of the same strength. We use a mean.
const CANCELLED: f64 = 1.8;
/// You need this many left-out mixtures to see how a library errs. With fewer, the covariance
/// depends on a few contradictory swatches.
pub const LEAST_MIXTURES: usize = 10;
/// Least standard deviation of a band, in reflectance.
const LEAST_SD: f64 = 1e-4;
/// Least part of a band's variance that it shares with no other band.
const LEAST_OWN: f64 = 1e-3;
/// We describe errors that bands have in common by this many curves over wavelength.
pub(crate) const CURVES: usize = 8;

/// Error of a library's predictions.
#[derive(Debug, Clone, PartialEq)]
pub enum ModelError {
    /// Errors of at least [`LEAST_MIXTURES`] mixtures that were left out of the library's fit, on
    /// wavelengths that cover its own.
    Residuals(Residuals),
    /// Smooth errors of K and S of each pigment, as a standard deviation relative to their values,
    /// 0 to 1.
    Stated(f64),
}

impl ModelError {
    /// Text for messages and books. If two errors have the same text, they are equal.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Stated(relative) => format!("K and S off by {} %", 100.0 * relative),
            Self::Residuals(residuals) => format!(
                "the errors of {} left-out mixtures, sha256 {}",
                residuals.mixtures.len(),
                residuals.sha256()
            ),
        }
    }
}

impl ModelError {
    /// The stated error, or the number of mixtures and the hash of the residuals, as JSON.
    pub(crate) fn to_json(&self) -> Value {
        match self {
            Self::Stated(relative) => json!(relative),
            Self::Residuals(residuals) => json!({
                "left_out_mixtures": residuals.mixtures.len(),
                "residuals_sha256": residuals.sha256(),
            }),
        }
    }
}

/// Covariance of the differences between measured and predicted spectra near a measured one.
///
/// It combines a few common curves and each band by itself, both multiplied by a scale that depends on
/// the measured reflectance, plus the sensor's noise.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Noise {
    /// Variance of the sensor's noise in each band.
    pub(crate) sensor: Vec<f64>,
    /// For each band, the standard deviation that each curve describes.
    pub(crate) curves: Vec<[f64; CURVES]>,
    /// Variance of each band that the curves do not describe.
    pub(crate) own: Vec<f64>,
    pub(crate) scale: Scale,
    /// Effective number of bands: as many independent bands would show as much of the library's
    /// error.
    pub(crate) effective_bands: f64,
    pub(crate) evidence: Evidence,
    /// Standard deviation of the light that the surface itself reflects, the same in all bands. If
    /// it is above 0, it takes the place of the last curve.
    pub(crate) gloss: f64,
}

/// How far a chi-square counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Evidence {
    /// Degrees of freedom of Student's distribution of the errors.
    pub(crate) tail: f64,
    /// Number of bands that count as independent.
    pub(crate) bands: f64,
    /// We divide differences of scores by this, because we know the errors of a library only
    /// roughly, and exact likelihoods would give probabilities that promise too much.
    pub(crate) temperature: f64,
    /// The errors of a scan count as this power of its median chi-square per degree of freedom: 1
    /// trusts the scan alone, 0 the errors that we expect.
    pub(crate) of_scan: f64,
}

impl Evidence {
    /// For errors of left-out mixtures. We tried temperatures of 1 to 3.
    fn of_residuals(bands: f64) -> Self {
        Self { tail: TAIL, bands, temperature: 1.5, of_scan: 0.0 }
    }

    /// For stated errors, which are guesses. The errors of one pixel may be a few times as large or as
    /// small as you state, and neighbouring bands err more alike than we assume. We chose the numbers
    /// by the likelihood of the true pigments in simulated paintings of up to five pigments. We
    /// painted these with the oils of one half of the readings, 15 % stronger or weaker, and mapped
    /// them with the oils of the other half.
    fn of_stated(bands: f64) -> Self {
        Self { tail: 5.0, bands: 0.5 * bands, temperature: 2.0, of_scan: 0.5 }
    }
}

/// Scale on which the errors of dark and light films are alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    /// Fourth root of reflectance. This is near the perceptually even cube root of the fit, but we
    /// compute it by square roots, which every machine rounds alike.
    FourthRoot,
    /// Logarithm of K/S.
    LogRatio,
}

impl Noise {
    /// Noise on `bands`: `sensor` is the standard deviation of the sensor in each band, `model` the
    /// error of the predictions.
    pub(crate) fn new(bands: &Bands, sensor: f64, model: &ModelError) -> Self {
        let sensor: Vec<f64> =
            bands.noise(sensor).iter().map(|sd| (sd * sd).max(LEAST_SD * LEAST_SD)).collect();
        let count = bands.count();
        let (covariance, scale) = match model {
            ModelError::Stated(relative) => {
                let variance = CANCELLED * relative * relative;
                (variance * correlation(&bands.nm), Scale::LogRatio)
            }
            ModelError::Residuals(residuals) => {
                (root_covariance(bands, residuals), Scale::FourthRoot)
            }
        };
        let (evidence, gloss) = match model {
            ModelError::Stated(_) => (Evidence::of_stated(count as f64), STATED_GLOSS),
            ModelError::Residuals(_) => (Evidence::of_residuals(count as f64), 0.0),
        };
        let trace = covariance.trace();
        let square: f64 = covariance.iter().map(|value| value * value).sum();
        let effective_bands = if square > 0.0 { trace * trace / square } else { count as f64 };
        let diagonal: Vec<f64> = covariance.diagonal().iter().copied().collect();
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(covariance);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| eigenvalues[b].total_cmp(&eigenvalues[a]));
        let mut curves = vec![[0.0; CURVES]; count];
        let described = if gloss > 0.0 { CURVES - 1 } else { CURVES };
        for (curve, &axis) in order.iter().take(described).enumerate() {
            // The variance that a band has by itself belongs to no curve.
            let own = order.last().map_or(0.0, |&last| eigenvalues[last]);
            let sd = (eigenvalues[axis] - own).max(0.0).sqrt();
            for (band, curves) in curves.iter_mut().enumerate() {
                curves[curve] = sd * eigenvectors[(band, axis)];
            }
        }
        let own = diagonal.iter().zip(&curves).map(|(&variance, curves)| {
            let common: f64 = curves.iter().map(|value| value * value).sum();
            (variance - common).max(LEAST_OWN * variance).max(1e-12)
        });
        Self { sensor, own: own.collect(), curves, scale, effective_bands, evidence, gloss }
    }
}

fn correlation(nm: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(nm.len(), nm.len(), |i, j| {
        if i == j {
            return 1.0;
        }
        let distance = nm[i] - nm[j];
        SMOOTH
            .into_iter()
            .map(|(length, part): (f64, f64)| {
                part * libm::exp(-distance * distance / (2.0 * length * length))
            })
            .sum()
    })
}

/// Mean product of the residuals of the fourth roots, moved towards its diagonal.
fn root_covariance(bands: &Bands, residuals: &Residuals) -> DMatrix<f64> {
    let count = bands.count();
    let mut sum = DMatrix::<f64>::zeros(count, count);
    let mut sizes = Vec::new();
    for mixture in &residuals.mixtures {
        let pairs = mixture.measured.iter().zip(&mixture.predicted);
        let residual: Vec<f64> = pairs.map(|(measured, predicted)| measured - predicted).collect();
        let reflectance = bands.fold_library(&mixture.measured);
        let residual = bands.fold_library(&residual);
        let roots = reflectance.iter().zip(&residual);
        let roots: Vec<f64> =
            roots.map(|(r, e)| e / (4.0 * libm::pow(r.max(1e-4), 0.75))).collect();
        // Some have a mean square a hundred times larger than others, which would not count.
        let size = (roots.iter().map(|root| root * root).sum::<f64>() / count as f64).sqrt();
        sizes.push(size);
        for i in 0..count {
            for j in 0..count {
                sum[(i, j)] += roots[i] * roots[j] / size.max(1e-6);
            }
        }
    }
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let samples = residuals.mixtures.len().max(1) as f64;
    DMatrix::from_fn(count, count, |i, j| {
        let part = if i == j { 1.0 } else { 1.0 - SHRINKAGE };
        part * sum[(i, j)] * median / samples
    })
}
