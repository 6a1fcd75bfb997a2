//! The unknowns and the data of a fit, in arrays.

use spectra::Grid;
use spectra::optics::Surface;

use super::curves::Curves;
use crate::observation::Observation;

/// Mixtures of known shares with the K/S observed of each.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The wavelengths.
    pub grid: Grid,
    /// The surface of the measured films.
    pub surface: Surface,
    /// How many pigments.
    pub pigments: usize,
    /// The pigment whose S is 1.
    pub reference: usize,
    /// Root mean square spread of repeated readings; 0 if none were repeated.
    pub(crate) reading_sd: f64,
    /// By mixture: the pigments in it and their shares.
    pub(crate) recipes: Vec<Vec<(usize, f64)>>,
    /// By mixture and wavelength: K/S.
    pub(crate) ratio: Vec<Vec<f64>>,
    /// By mixture and wavelength: measured reflectance of a film that hides.
    pub(crate) reflectance: Vec<Vec<f64>>,
}

impl Problem {
    /// The problem of `observations`.
    ///
    /// # Errors
    /// [`FitError::Empty`] without mixtures, [`FitError::Reference`] if the
    /// reference pigment occurs in none, [`FitError::Shape`] if an observation
    /// has another number of pigments or wavelengths.
    pub fn new(
        grid: Grid,
        surface: Surface,
        observations: &[Observation],
        reference: usize,
    ) -> Result<Self, FitError> {
        let first = observations.first().ok_or(FitError::Empty)?;
        let pigments = first.shares.len();
        for observation in observations {
            let found = (observation.shares.len(), observation.ratio.len());
            if found != (pigments, grid.count()) || observation.reflectance.len() != grid.count() {
                return Err(FitError::Shape {
                    sample: observation.sample.clone(),
                    wanted: (pigments, grid.count()),
                    found,
                });
            }
        }
        if !observations.iter().any(|o| o.shares.get(reference).is_some_and(|&s| s > 0.0)) {
            return Err(FitError::Reference);
        }
        let recipe = |o: &Observation| {
            o.shares.iter().copied().enumerate().filter(|(_, share)| *share > 0.0).collect()
        };
        Ok(Self {
            grid,
            surface,
            pigments,
            reference,
            reading_sd: root_mean_square(observations.iter().filter_map(|o| o.spread)),
            recipes: observations.iter().map(recipe).collect(),
            ratio: observations.iter().map(|o| o.ratio.clone()).collect(),
            reflectance: observations.iter().map(|o| o.reflectance.clone()).collect(),
        })
    }

    /// K and S of mixture `index` at wavelength `at`.
    pub(crate) fn mixed(&self, curves: &Curves, index: usize, at: usize) -> (f64, f64) {
        self.recipes[index].iter().fold((0.0, 0.0), |(k, s), &(pigment, share)| {
            (k + share * curves.absorption[pigment][at], s + share * curves.scattering[pigment][at])
        })
    }

    /// Measured reflectance that `curves` predict of each mixture in a film
    /// that hides, by mixture and wavelength.
    pub(crate) fn predicted(&self, curves: &Curves) -> Vec<Vec<f64>> {
        let film = |index: usize, at: usize| {
            let (k, s) = self.mixed(curves, index, at);
            self.surface.measured_from_internal(spectra::optics::infinite_film(k, s))
        };
        (0..self.recipes.len())
            .map(|index| (0..self.grid.count()).map(|at| film(index, at)).collect())
            .collect()
    }
}

/// 0 for no values.
pub(crate) fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (squares, count) = values.fold((0.0, 0.0), |(sum, n), v| (sum + v * v, n + 1.0));
    f64::sqrt(squares / f64::max(count, 1.0))
}

/// Why a fit could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Nothing to fit.
    #[error("no sample can be fitted: none ties its pigments to the reference white")]
    Empty,
    /// The reference pigment occurs in no mixture.
    #[error("the reference pigment occurs in no mixture")]
    Reference,
    /// An observation of another shape.
    #[error(
        "sample {sample} must have {} shares and {} wavelengths, found `{}` and `{}`",
        wanted.0, wanted.1, found.0, found.1
    )]
    Shape {
        /// The sample.
        sample: String,
        /// Pigments and wavelengths wanted.
        wanted: (usize, usize),
        /// Pigments and wavelengths found.
        found: (usize, usize),
    },
    /// The quadratic program could not be solved.
    #[error("the quadratic program at {nm} nm ended as `{status}`")]
    Solver {
        /// The wavelength.
        nm: f64,
        /// What the solver said.
        status: String,
    },
}
