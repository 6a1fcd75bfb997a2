//! Information that a design gives on K and S, estimated from a library of similar paint.

use nalgebra::DMatrix;
use spectra::Grid;

use super::paints::PaintSet;
use super::swatch_recipe::SwatchRecipe;
use crate::fit::{AssumedPaints, ExpectedNoise, PRIOR_INFORMATION, Slopes};
use pigment::evaluate::percentile;
use pigment::library::PigmentLibrary;
use pigment::{Curves, PigmentId};

/// Information that each recipe of a pool gives on log K and log S of every paint, over a library's
/// wavelengths.
///
/// It is the Fisher information of the fit's own residuals: reflectances of films that hide, surface
/// included, under its noise model, plus the little information of the fit's prior. Smoothness over
/// wavelength is left out, so that predicted deviations are rather too large.
#[derive(Debug, Clone)]
pub struct Information {
    pub(super) slopes: Slopes,
    paints: usize,
    grid: Grid,
}

/// Predicted standard deviations of one paint's K and S, relative to K and S (that is, of their
/// logarithms); the median over wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeDeviation {
    /// Relative standard deviation of K.
    pub absorption: f64,
    /// Relative standard deviation of S; `None` for the white, whose S is 1.
    pub scattering: Option<f64>,
}

impl Information {
    /// Computes the information of `pool`. Paint i of the pool is assumed to have the K and S of
    /// `pigments[i]` of `library`.
    #[must_use]
    pub fn new(
        library: &PigmentLibrary,
        pigments: &[PigmentId],
        pool: &[SwatchRecipe],
        noise: ExpectedNoise,
    ) -> Self {
        let paints = AssumedPaints {
            surface: library.saunderson,
            reference: PaintSet::WHITE,
            curves: pigments.iter().map(|id| library.curves(*id)).collect(),
        };
        let recipes = pool
            .iter()
            .map(|recipe: &SwatchRecipe| -> Vec<(usize, f64)> {
                recipe.shares().iter().map(|&(paint, share)| (paint.index(), share)).collect()
            })
            .collect();
        let slopes = Slopes::of(&paints, recipes, noise);
        Self { slopes, paints: pigments.len(), grid: library.grid }
    }

    /// Covariance of log K and log S by wavelength: the inverse of the information of `design`.
    pub(super) fn covariances(&self, design: &[usize]) -> Vec<DMatrix<f64>> {
        (0..self.slopes.wavelengths())
            .map(|at| {
                let factor = self.matrix(design, at).cholesky();
                factor.expect("the prior makes it positive definite").inverse()
            })
            .collect()
    }

    /// Mean per unknown of log det of the information of `design`, a list of indices into the pool.
    #[must_use]
    pub fn log_determinant(&self, design: &[usize]) -> f64 {
        let wavelengths = self.slopes.wavelengths();
        let sum: f64 = (0..wavelengths)
            .map(|at| {
                let factor = self.matrix(design, at).cholesky();
                let factor = factor.expect("the prior makes it positive definite").unpack();
                2.0 * factor.diagonal().iter().map(|v| v.ln()).sum::<f64>()
            })
            .sum();
        sum / (wavelengths * self.slopes.unknowns()) as f64
    }

    /// D-efficiency of `design` against `other`. A value of 0.8 means that 80 % as many readings of `other`
    /// would give the same information.
    #[must_use]
    pub fn efficiency(&self, design: &[usize], other: &[usize]) -> f64 {
        (self.log_determinant(design) - self.log_determinant(other)).exp()
    }

    /// Standard deviations of log K and log S that `design` should give, by paint; 0 for the S of the
    /// white.
    #[must_use]
    pub fn log_deviations(&self, design: &[usize]) -> Vec<Curves> {
        let covariances = self.covariances(design);
        let by_wavelength = |place: Option<usize>| -> Vec<f64> {
            covariances
                .iter()
                .map(|c: &DMatrix<f64>| place.map_or(0.0, |place| c[(place, place)].sqrt()))
                .collect()
        };
        (0..self.paints)
            .map(|paint: usize| Curves {
                grid: self.grid,
                absorption: by_wavelength(Some(paint)),
                scattering: by_wavelength(self.slopes.scattering(paint)),
            })
            .collect()
    }

    /// Median over wavelength of these standard deviations, by paint.
    #[must_use]
    pub fn deviations(&self, design: &[usize]) -> Vec<RelativeDeviation> {
        self.log_deviations(design)
            .iter()
            .enumerate()
            .map(|(paint, Curves { absorption, scattering, .. }): (usize, &Curves)| {
                let is_white = paint == PaintSet::WHITE.index();
                RelativeDeviation {
                    absorption: percentile(absorption, 50.0),
                    scattering: (!is_white).then(|| percentile(scattering, 50.0)),
                }
            })
            .collect()
    }

    fn matrix(&self, design: &[usize], at: usize) -> DMatrix<f64> {
        let unknowns = self.slopes.unknowns();
        let mut matrix = DMatrix::from_diagonal_element(unknowns, unknowns, PRIOR_INFORMATION);
        for &index in design {
            let places = &self.slopes.places[index];
            let slopes = self.slopes.at(index, at);
            for (&row, a) in places.iter().zip(slopes) {
                for (&column, b) in places.iter().zip(slopes) {
                    matrix[(row, column)] += a * b;
                }
            }
        }
        matrix
    }
}
