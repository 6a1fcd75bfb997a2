//! Data of a fit as arrays.

use documents::Cancelled;
use documents::hint::{Explain, Fault, Hint};
use spectra::Grid;
use spectra::optics::Surface;

use super::curves::CurveTable;
use crate::observation::Observation;
use pigment::PigmentId;

/// Mixtures of known shares, with the K/S observed for each.
#[derive(Debug, Clone)]
pub struct Problem {
    /// Wavelengths of all curves.
    pub grid: Grid,
    /// Surface of the measured films.
    pub surface: Surface,
    /// Number of pigments.
    pub pigments: usize,
    /// Pigment whose S is 1.
    pub reference: PigmentId,
    /// Standard deviation of repeated readings, root mean square over samples; 0 if none were repeated.
    pub(crate) reading_sd: f64,
    /// Pigments of each mixture with their shares.
    pub(crate) recipes: Vec<Vec<(usize, f64)>>,
    /// K/S by mixture and wavelength.
    pub(crate) ratio: Vec<Vec<f64>>,
    /// Measured reflectance, as films that hide, by mixture and wavelength.
    pub(crate) reflectance: Vec<Vec<f64>>,
}

impl Problem {
    /// Collects the data of `observations`.
    ///
    /// # Errors
    /// [`FitError::Empty`] without mixtures, [`FitError::Reference`] if none contains the reference
    /// pigment, [`FitError::Shape`] if an observation has another number of pigments or wavelengths.
    pub fn new(
        grid: Grid,
        surface: Surface,
        observations: &[Observation],
        reference: PigmentId,
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
        if !observations.iter().any(|o| o.shares.get(reference.index()).is_some_and(|&s| s > 0.0)) {
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
    pub(crate) fn mixed(&self, curves: &CurveTable, index: usize, at: usize) -> (f64, f64) {
        self.recipes[index].iter().fold((0.0, 0.0), |(k, s), &(pigment, share)| {
            (k + share * curves.absorption[pigment][at], s + share * curves.scattering[pigment][at])
        })
    }

    /// Predicted measured reflectance of each mixture as a film that hides, by mixture and wavelength.
    pub(crate) fn predicted(&self, curves: &CurveTable) -> Vec<Vec<f64>> {
        let film = |index: usize, at: usize| {
            let (k, s) = self.mixed(curves, index, at);
            self.surface.measured_from_internal(spectra::optics::infinite_film(k, s))
        };
        (0..self.recipes.len())
            .map(|index| (0..self.grid.count()).map(|at| film(index, at)).collect())
            .collect()
    }
}

/// Root mean square of `values`; 0 for no values.
pub(crate) fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (squares, count) = values.fold((0.0, 0.0), |(sum, n), v| (sum + v * v, n + 1.0));
    f64::sqrt(squares / f64::max(count, 1.0))
}

/// A fit that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// No sample can be fitted.
    #[error("no sample can be fitted: none ties its pigments to the reference white")]
    Empty,
    /// No mixture contains the reference pigment.
    #[error("the reference pigment occurs in no mixture")]
    Reference,
    /// An observation has another number of pigments or wavelengths.
    #[error(
        "sample {sample} must have {} shares and {} wavelengths, found `{}` and `{}`",
        wanted.0, wanted.1, found.0, found.1
    )]
    Shape {
        /// Name of the sample.
        sample: String,
        /// Expected numbers of pigments and wavelengths.
        wanted: (usize, usize),
        /// Numbers of pigments and wavelengths in the observation.
        found: (usize, usize),
    },
    /// The solver did not solve the quadratic program.
    #[error("the quadratic program at {nm} nm ended as `{status}`")]
    Solver {
        /// Wavelength in nm.
        nm: f64,
        /// Status of the solver.
        status: String,
    },
    /// The fit was asked to end before its time.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Explain for FitError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Empty | Self::Reference => Some(Hint::new(
                "measure the white by itself and mixtures with it, or name another white with [reference]",
            )),
            Self::Shape { .. } | Self::Solver { .. } => None,
            Self::Cancelled(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Cancelled(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
