//! Noise of a map: that of the sensor, and the error of the library's predictions.
//!
//! The errors of Kubelka-Munk predictions are smooth over wavelength and far greater than the sensor's noise.
//! Spectra are compared after whitening by the covariance of both, so that neighbouring bands that err
//! together do not count twice.

use nalgebra::{Cholesky, DMatrix};

use crate::bands::Bands;
use crate::left_out::Residuals;
use crate::paints::Paints;

/// Part of the covariance of left-out residuals that is moved to its diagonal. A few dozen mixtures do not
/// tell a covariance of 31 bands; chosen on the Van Gogh oils, where 0.3 to 0.6 do alike.
const SHRINKAGE: f64 = 0.5;
/// Degrees of freedom of the residuals' distribution. Some mixtures err ten times as much as others, so
/// that their tails are heavier than normal ones; chosen on the Van Gogh oils.
const TAIL: f64 = 8.0;
/// Lengths in nm over which stated errors of K and S are alike, with their parts of the variance. The
/// rest is independent from band to band.
const SMOOTH: [(f64, f64); 2] = [(100.0, 0.55), (40.0, 0.42)];
/// Left-out errors of a fit relative to its own; measured on the Van Gogh oils.
const LEFT_OUT_TO_FITTED: f64 = 1.9;
/// Relative error of K and S of a library that tells nothing about its errors.
pub const USUAL_MODEL_ERROR: f64 = 0.1;
/// Least standard deviation of a band, in reflectance.
const LEAST_SD: f64 = 1e-4;

/// Error of a library's predictions.
#[derive(Debug, Clone, PartialEq)]
pub enum ModelError {
    /// Errors of mixtures that the library had not seen.
    Residuals(Residuals),
    /// Smooth errors of K and S of each pigment, as a standard deviation relative to their values; 0 to 1.
    Stated(f64),
}

/// Covariance of the differences between measured and predicted spectra.
#[derive(Debug, Clone)]
pub struct Noise {
    /// Variance of the sensor's noise in each band.
    sensor: Vec<f64>,
    model: Model,
    /// Degrees of freedom of Student's distribution; infinite for a normal one.
    pub tail: f64,
}

#[derive(Debug, Clone)]
enum Model {
    /// Covariance of the cube roots of reflectance.
    CubeRoot(DMatrix<f64>),
    /// Relative variance of K and S, and the correlation of their errors between bands.
    Relative(f64, DMatrix<f64>),
}

impl Noise {
    /// Noise on `bands` of a sensor whose bands have the standard deviation `sensor`, and of predictions
    /// with the error `model`.
    #[must_use]
    pub fn new(bands: &Bands, sensor: f64, model: &ModelError) -> Self {
        let sensor = bands.noise(sensor).iter().map(|sd| (sd * sd).max(LEAST_SD * LEAST_SD)).collect();
        match model {
            ModelError::Stated(relative) => {
                let model = Model::Relative(relative * relative, correlation(&bands.nm));
                Self { sensor, model, tail: f64::INFINITY }
            }
            ModelError::Residuals(residuals) => {
                let covariance = cube_root_covariance(bands, residuals);
                Self { sensor, model: Model::CubeRoot(covariance), tail: TAIL }
            }
        }
    }

    /// Relative error of K and S that explains the root mean square error `rms` of a fit of `paints`.
    #[must_use]
    pub fn stated_from_rms(paints: &Paints, rms: f64) -> f64 {
        let singles = 0..paints.count();
        let squares: Vec<f64> = singles
            .flat_map(|pigment| {
                let (k, s) = paints.mixed(&[(pigment, 1.0)]);
                let slopes = k.into_iter().zip(s).map(|(k, s)| {
                    let slope = paints.log_slope(spectra::optics::infinite_film(k, s));
                    2.0 * slope * slope
                });
                slopes.collect::<Vec<f64>>()
            })
            .collect();
        let mean = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
        (LEFT_OUT_TO_FITTED * rms / mean.sqrt().max(1e-6)).clamp(0.01, 1.0)
    }

    /// Covariance of the bands for a film of the pigments `shares` with their shares.
    #[must_use]
    pub fn covariance(&self, paints: &Paints, shares: &[(usize, f64)]) -> DMatrix<f64> {
        let bands = self.sensor.len();
        let reflectance = paints.reflectance(shares);
        let mut covariance = match &self.model {
            Model::CubeRoot(covariance) => {
                let scale: Vec<f64> =
                    reflectance.iter().map(|r| 3.0 * r.max(1e-4).powf(2.0 / 3.0)).collect();
                DMatrix::from_fn(bands, bands, |i, j| scale[i] * covariance[(i, j)] * scale[j])
            }
            Model::Relative(variance, correlation) => {
                let (k, s) = paints.mixed(shares);
                let slope: Vec<f64> = (0..bands)
                    .map(|b| paints.log_slope(spectra::optics::infinite_film(k[b], s[b])))
                    .collect();
                let parts: Vec<Vec<f64>> = (shares.iter())
                    .flat_map(|&(p, share)| {
                        let part = |curve: &[f64], sum: &[f64]| {
                            (0..bands).map(|b| slope[b] * share * curve[b] / sum[b]).collect()
                        };
                        [part(&paints.absorption[p], &k), part(&paints.scattering[p], &s)]
                    })
                    .collect();
                DMatrix::from_fn(bands, bands, |i, j| {
                    let product: f64 = parts.iter().map(|part| part[i] * part[j]).sum();
                    variance * correlation[(i, j)] * product
                })
            }
        };
        for (band, variance) in self.sensor.iter().enumerate() {
            covariance[(band, band)] += variance;
        }
        covariance
    }

    /// Lower triangular matrix that whitens differences of spectra near the film of `shares`: its product
    /// with a difference has uncorrelated bands of variance 1.
    #[must_use]
    pub fn whitening(&self, paints: &Paints, shares: &[(usize, f64)]) -> DMatrix<f64> {
        inverse_factor(self.covariance(paints, shares))
    }

    /// Effective number of bands: how many independent ones tell as much of the library's error.
    #[must_use]
    pub fn effective_bands(&self) -> f64 {
        let (Model::CubeRoot(matrix) | Model::Relative(_, matrix)) = &self.model;
        let trace = matrix.trace();
        let square: f64 = matrix.iter().map(|value| value * value).sum();
        if square > 0.0 { trace * trace / square } else { self.sensor.len() as f64 }
    }
}

/// Inverse of the lower Cholesky factor; of the diagonal alone if rounding has made `covariance` indefinite.
pub(crate) fn inverse_factor(covariance: DMatrix<f64>) -> DMatrix<f64> {
    let count = covariance.nrows();
    let diagonal = covariance.diagonal();
    let factor = Cholesky::new(covariance).map(|cholesky| cholesky.l());
    let inverse = factor.and_then(|l| l.solve_lower_triangular(&DMatrix::identity(count, count)));
    inverse.unwrap_or_else(|| DMatrix::from_diagonal(&diagonal.map(|v| 1.0 / v.max(1e-12).sqrt())))
}

fn correlation(nm: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(nm.len(), nm.len(), |i, j| {
        if i == j {
            return 1.0;
        }
        let distance = nm[i] - nm[j];
        let part = |(length, part): (f64, f64)| {
            part * (-distance * distance / (2.0 * length * length)).exp()
        };
        SMOOTH.into_iter().map(part).sum()
    })
}

/// Mean product of the residuals of the cube roots, moved towards its diagonal.
fn cube_root_covariance(bands: &Bands, residuals: &Residuals) -> DMatrix<f64> {
    let count = bands.count();
    let mut sum = DMatrix::<f64>::zeros(count, count);
    for (reflectance, residual) in residuals.reflectance.iter().zip(&residuals.residual) {
        let (reflectance, residual) =
            (bands.fold_library(reflectance), bands.fold_library(residual));
        let roots = reflectance.iter().zip(&residual);
        let roots: Vec<f64> =
            roots.map(|(r, e)| e / (3.0 * r.max(1e-4).powf(2.0 / 3.0))).collect();
        for i in 0..count {
            for j in 0..count {
                sum[(i, j)] += roots[i] * roots[j];
            }
        }
    }
    let samples = residuals.residual.len().max(1) as f64;
    DMatrix::from_fn(count, count, |i, j| {
        let part = if i == j { 1.0 } else { 1.0 - SHRINKAGE };
        part * sum[(i, j)] / samples
    })
}
