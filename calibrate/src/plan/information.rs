//! What a design tells of K and S, by a library of paint like it.

use nalgebra::DMatrix;

use super::palette::Palette;
use super::recipe::Recipe;
use crate::fit::{Belief, ExpectedNoise, PRIOR_INFORMATION, Slopes};
use pigment::evaluate::percentile;
use pigment::library::PigmentLibrary;

/// The information that each recipe of a pool has on log K and log S of every
/// paint, over a library's wavelengths.
///
/// Fisher information of the fit's own residuals: reflectance of films that
/// hide, the surface included, under its noise model, on top of the little that
/// the fit's prior holds. Smoothness over wavelength is left out, so that
/// deviations are on the safe side.
#[derive(Debug, Clone)]
pub struct Information {
    pub(super) slopes: Slopes,
    paints: usize,
}

/// Predicted standard deviations of one paint's K and S, as shares of K and S
/// (deviations of their logarithms): the median over wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeDeviation {
    /// Of K.
    pub absorption: f64,
    /// Of S; `None` for the white, whose S is the unit.
    pub scattering: Option<f64>,
}

impl Information {
    /// That of `pool`, whose paint number i is pigment `pigments[i]` of
    /// `library`.
    #[must_use]
    pub fn new(
        library: &PigmentLibrary,
        pigments: &[usize],
        pool: &[Recipe],
        noise: ExpectedNoise,
    ) -> Self {
        let of = |index: &usize| &library.pigments[*index];
        let belief = Belief {
            grid: library.grid,
            surface: library.saunderson,
            reference: Palette::WHITE,
            absorption: pigments.iter().map(|i| of(i).absorption.as_slice()).collect(),
            scattering: pigments.iter().map(|i| of(i).scattering.as_slice()).collect(),
        };
        let recipes: Vec<Vec<(usize, f64)>> = pool.iter().map(Recipe::shares).collect();
        Self { slopes: Slopes::of(&belief, &recipes, noise), paints: pigments.len() }
    }

    /// By wavelength, the inverse of the information of `design`: the
    /// covariance of log K and log S.
    pub(super) fn covariances(&self, design: &[usize]) -> Vec<DMatrix<f64>> {
        (0..self.slopes.wavelengths())
            .map(|at| {
                let factor = self.matrix(design, at).cholesky();
                factor.expect("the prior makes it positive definite").inverse()
            })
            .collect()
    }

    /// log det of the information of `design`, summed over wavelengths and
    /// divided by the number of unknowns: its mean per unknown.
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

    /// D-efficiency of `design` against `other`: the share of readings with
    /// which `other` would tell as much, if both could be repeated in part.
    #[must_use]
    pub fn efficiency(&self, design: &[usize], other: &[usize]) -> f64 {
        (self.log_determinant(design) - self.log_determinant(other)).exp()
    }

    /// Standard deviations of log K and log S that `design` should give, by
    /// paint and wavelength; 0 for the white's S.
    #[must_use]
    pub fn log_deviations(&self, design: &[usize]) -> [Vec<Vec<f64>>; 2] {
        let covariances = self.covariances(design);
        let by_wavelength = |place: Option<usize>| -> Vec<f64> {
            let sd = |c: &DMatrix<f64>| place.map_or(0.0, |place| c[(place, place)].sqrt());
            covariances.iter().map(sd).collect()
        };
        [
            (0..self.paints).map(|paint| by_wavelength(Some(paint))).collect(),
            (0..self.paints).map(|paint| by_wavelength(self.slopes.scattering(paint))).collect(),
        ]
    }

    /// The same in two numbers a paint.
    #[must_use]
    pub fn deviations(&self, design: &[usize]) -> Vec<RelativeDeviation> {
        let [absorption, scattering] = self.log_deviations(design);
        let paints = absorption.iter().zip(&scattering).enumerate();
        paints
            .map(|(paint, (absorption, scattering))| RelativeDeviation {
                absorption: percentile(absorption, 50.0),
                scattering: (paint != Palette::WHITE).then(|| percentile(scattering, 50.0)),
            })
            .collect()
    }

    fn matrix(&self, design: &[usize], at: usize) -> DMatrix<f64> {
        let unknowns = self.slopes.unknowns();
        let mut matrix = DMatrix::from_diagonal_element(unknowns, unknowns, PRIOR_INFORMATION);
        for &index in design {
            let (places, slopes) = (&self.slopes.places[index], self.slopes.at(index, at));
            for (&row, a) in places.iter().zip(slopes) {
                for (&column, b) in places.iter().zip(slopes) {
                    matrix[(row, column)] += a * b;
                }
            }
        }
        matrix
    }
}
