//! Data of a fit as arrays: K/S of the mixtures, K and S of all pigments.

use documents::{Cancelled, hint::Explain};
use pigment::{Curves, PigmentId};
use spectra::{Grid, optics::Surface};

use crate::observation::Observation;

/// Mixtures of known shares, with the K/S observed for each.
#[derive(Debug, Clone)]
pub struct Problem {
    /// Wavelengths of all curves.
    pub grid: Grid,
    /// Surface of the measured films.
    pub surface: Surface,
    /// Number of pigments.
    pub pigments: usize,
    /// Pigment with S = 1.
    pub reference: PigmentId,
    /// Standard deviation of repeated readings (root mean square over samples). It is 0 if you repeated
    /// none.
    pub(crate) reading_sd: f64,
    /// Pigments of each mixture with their shares.
    pub(crate) recipes: Vec<Vec<(usize, f64)>>,
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

    pub(crate) fn mixed(&self, curves: &CurveTable, index: usize, at: usize) -> (f64, f64) {
        self.recipes[index].iter().fold((0.0, 0.0), |(k, s), &(pigment, share)| {
            (k + share * curves.absorption[pigment][at], s + share * curves.scattering[pigment][at])
        })
    }

    /// Predicted measured reflectance of each mixture as a film that hides, by mixture and wavelength.
    pub(crate) fn predicted(&self, curves: &CurveTable) -> Vec<Vec<f64>> {
        let films = (0..self.recipes.len()).map(|index| {
            let film = (0..self.grid.count()).map(|at| {
                let (k, s) = self.mixed(curves, index, at);
                self.surface.measured_from_internal(spectra::optics::infinite_film(k, s))
            });
            film.collect()
        });
        films.collect()
    }
}

fn recipe(o: &Observation) -> Vec<(usize, f64)> {
    o.shares.iter().copied().enumerate().filter(|(_, share)| *share > 0.0).collect()
}

/// Root mean square of `values`, or 0 for no values.
pub(crate) fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (squares, count) = values.fold((0.0, 0.0), |(sum, n), v| (sum + v * v, n + 1.0));
    f64::sqrt(squares / f64::max(count, 1.0))
}

/// A fit that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum FitError {
    /// No sample can be fitted.
    #[error("no sample can be fitted: none ties its pigments to the reference white")]
    #[hint(
        "measure the white by itself and mixtures with it, or name another white with [reference]"
    )]
    Empty,
    /// No mixture contains the reference pigment.
    #[error("the reference pigment occurs in no mixture")]
    #[hint(
        "measure the white by itself and mixtures with it, or name another white with [reference]"
    )]
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
    /// The fit was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// K and S of all pigments, by pigment and wavelength.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CurveTable {
    pub(crate) absorption: Vec<Vec<f64>>,
    pub(crate) scattering: Vec<Vec<f64>>,
}

impl CurveTable {
    /// Table of `curves`. We raise K to at least `least[0]` and S to at least `least[1]`, because the
    /// logarithm of 0 has no slope.
    pub(crate) fn off_zero(curves: &[Curves], least: [f64; 2]) -> Self {
        Self {
            absorption: curves.iter().map(|c| clamped(&c.absorption, least[0])).collect(),
            scattering: curves.iter().map(|c| clamped(&c.scattering, least[1])).collect(),
        }
    }

    pub(crate) fn into_curves(self, grid: Grid) -> Vec<Curves> {
        let pairs = self.absorption.into_iter().zip(self.scattering);
        pairs.map(|(absorption, scattering)| Curves { grid, absorption, scattering }).collect()
    }
}

fn clamped(curve: &[f64], least: f64) -> Vec<f64> {
    curve.iter().map(|v| v.max(least)).collect()
}

/// A solution may contain 0. We raise K and S to these values before we take logarithms.
pub(crate) const OFF_ZERO: [f64; 2] = [1e-4, 1e-3];

/// Bounds of log K and log S, for K and S from 1e-5 to 1e4. A pigment with less than 1e-5 does not show.
pub(super) const LOWER: f64 = -11.512_925_464_970_229;
pub(super) const UPPER: f64 = 9.210_340_371_976_184;

/// Order of the unknowns. For each wavelength we list log K of every pigment, then log S of every pigment
/// except the reference, which has S = 1. Absolute amounts have no reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) pigments: usize,
    pub(super) reference: Option<usize>,
    pub(super) wavelengths: usize,
}

impl Layout {
    pub(super) fn per_wavelength(self) -> usize {
        2 * self.pigments - usize::from(self.reference.is_some())
    }

    pub(super) fn len(self) -> usize {
        self.per_wavelength() * self.wavelengths
    }

    /// Index of log S of `pigment` among the unknowns of one wavelength, or `None` for the reference.
    pub(super) fn scattering(self, pigment: usize) -> Option<usize> {
        match self.reference {
            Some(reference) if pigment == reference => None,
            Some(reference) if pigment > reference => Some(self.pigments + pigment - 1),
            _ => Some(self.pigments + pigment),
        }
    }

    /// Whether the unknown with this index is a log S.
    pub(super) fn is_scattering(self, unknown: usize) -> bool {
        unknown % self.per_wavelength() >= self.pigments
    }

    /// Unknowns of `curves`, clamped to the bounds.
    pub(super) fn unknowns(self, curves: &CurveTable) -> Vec<f64> {
        let mut unknowns = Vec::with_capacity(self.len());
        for at in 0..self.wavelengths {
            unknowns.extend((0..self.pigments).map(|p| log(curves.absorption[p][at])));
            let others = (0..self.pigments).filter(|&p| Some(p) != self.reference);
            unknowns.extend(others.map(|p| log(curves.scattering[p][at])));
        }
        unknowns
    }

    pub(super) fn curves(self, unknowns: &[f64]) -> CurveTable {
        let per = self.per_wavelength();
        let curve = |place: usize| -> Vec<f64> {
            (0..self.wavelengths).map(|at| unknowns[at * per + place].exp()).collect()
        };
        CurveTable {
            absorption: (0..self.pigments).map(curve).collect(),
            scattering: (0..self.pigments)
                .map(|p| self.scattering(p).map_or_else(|| vec![1.0; self.wavelengths], curve))
                .collect(),
        }
    }
}

fn log(value: f64) -> f64 {
    value.max(f64::MIN_POSITIVE).ln().clamp(LOWER, UPPER)
}
