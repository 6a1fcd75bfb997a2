//! Every way to choose wavelengths, for several numbers of them.

use std::ops::RangeInclusive;

use rayon::prelude::*;

use super::mixtures::MixtureSet;
use super::rule::{Quadrature, QuadratureError, QuadratureFailure};
use crate::evaluate::Viewing;
use crate::library::PigmentLibrary;

/// How wavelengths and weights are chosen; see the module.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuadratureMethod {
    /// [`Quadrature::gauss`].
    Gauss,
    /// [`Quadrature::moments`].
    Moments,
    /// [`Quadrature::library`].
    Library,
}

/// A quadrature with what it costs.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadratureTrial {
    /// How it was chosen.
    pub method: QuadratureMethod,
    /// Wavelengths and weights.
    pub rule: Quadrature,
    /// CIEDE2000 over mixtures that no method was fitted to.
    pub error: QuadratureError,
}

/// The mixtures that trials are held against, as `impasto quadrature` has it.
const MIXTURES: usize = 1000;
const SEED: u64 = 1;

impl QuadratureMethod {
    /// Every method, in the order of the module's table.
    pub const ALL: [Self; 3] = [Self::Gauss, Self::Moments, Self::Library];

    /// Its name on the command line.
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
    /// Each method with each of `counts` wavelengths, method by method, against
    /// 1000 random mixtures of `library`; on all cores.
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
        let each = |method| counts.clone().map(move |count| (method, count));
        let pairs: Vec<_> = QuadratureMethod::ALL.into_iter().flat_map(each).collect();
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
