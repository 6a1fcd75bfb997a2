//! Comparison of all methods of choosing wavelengths, for several numbers of them.

use std::ops::RangeInclusive;

use rayon::prelude::*;

use super::mixtures::MixtureSet;
use super::rule::{Quadrature, QuadratureError, QuadratureFailure};
use crate::evaluate::Viewing;
use crate::library::PigmentLibrary;

/// Method of choosing wavelengths and weights; the module's table describes each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuadratureMethod {
    /// The method of [`Quadrature::gauss`].
    Gauss,
    /// The method of [`Quadrature::moments`].
    Moments,
    /// The method of [`Quadrature::library`].
    Library,
}

/// A quadrature with its colour error.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadratureTrial {
    /// Method that chose the wavelengths.
    pub method: QuadratureMethod,
    /// Wavelengths and weights that it chose.
    pub rule: Quadrature,
    /// CIEDE2000 error over random mixtures that no method was fitted to.
    pub error: QuadratureError,
}

/// Number of random mixtures that trials are tested on, the default of `impasto quadrature`.
const MIXTURES: usize = 1000;
/// Seed of these mixtures, the default of `impasto quadrature`.
const SEED: u64 = 1;

impl QuadratureMethod {
    /// Every method, in the order of the module's table.
    pub const ALL: [Self; 3] = [Self::Gauss, Self::Moments, Self::Library];

    /// Name of the method, as programs spell it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Gauss => "gauss",
            Self::Moments => "moments",
            Self::Library => "library",
        }
    }
}

impl QuadratureTrial {
    /// Computes each method with each of `counts` wavelengths, ordered by method, and its error on
    /// 1000 random mixtures of `library`. Uses all cores.
    ///
    /// # Errors
    /// [`QuadratureFailure::Count`] if a count is not 1 to 32.
    pub fn all(
        viewing: &Viewing,
        library: &PigmentLibrary,
        counts: &RangeInclusive<usize>,
    ) -> Result<Vec<Self>, QuadratureFailure> {
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let mixtures = MixtureSet::random(library, &weights, MIXTURES, SEED);
        let pairs: Vec<_> = QuadratureMethod::ALL
            .into_iter()
            .flat_map(|method| counts.clone().map(move |count| (method, count)))
            .collect();
        let trials = pairs.into_par_iter().map(|(method, count)| {
            let rule = match method {
                QuadratureMethod::Gauss => Quadrature::gauss(viewing, count)?,
                QuadratureMethod::Moments => Quadrature::moments(viewing, count)?,
                QuadratureMethod::Library => Quadrature::library(viewing, library, count)?,
            };
            let error = rule.error(&mixtures);
            Ok(Self { method, rule, error })
        });
        trials.collect()
    }
}
