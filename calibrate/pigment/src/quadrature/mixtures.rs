//! Seeded random mixtures of a library, with their exact colours.

use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1};
use spectra::color::Xyz;
use spectra::optics::Surface;
use spectra::{Grid, TristimulusWeights};

use crate::curves::Curves;
use crate::library::PigmentLibrary;
use crate::recipe::{PigmentId, Recipe};

/// Mixtures of a library as films that hide their ground, with their exact colours.
#[derive(Debug, Clone, PartialEq)]
pub struct MixtureSet {
    pub(super) grid: Grid,
    pub(super) surface: Surface,
    pub(super) mixtures: Vec<Curves>,
    /// Colours by full integration over the library's grid.
    pub(super) xyz: Vec<Xyz>,
    pub(super) white: Xyz,
}

impl MixtureSet {
    /// Draws `count` mixtures of one to four pigments. Each number of pigments is equally likely,
    /// the pigments are drawn uniformly, and the shares are uniform over all that sum to 1. The same
    /// seed gives the same mixtures.
    #[must_use]
    pub fn random(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
    ) -> Self {
        Self::from_stream(library, weights, count, seed, 0)
    }

    /// Mixtures for fitting a quadrature, from another random stream than [`MixtureSet::random`],
    /// so that no seed makes the two sets share mixtures.
    pub(super) fn for_fitting(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
    ) -> Self {
        Self::from_stream(library, weights, count, seed, 1)
    }

    fn from_stream(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
        stream: u64,
    ) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        let pigments = library.pigments.len();
        let mixtures = (0..count)
            .map(|_| {
                let parts = random.random_range(1..=pigments.min(4));
                // Exponential parts, normalised, are uniform over the simplex.
                let recipe: Recipe = index::sample(&mut random, pigments, parts)
                    .into_iter()
                    .map(|pigment| (PigmentId(pigment), Exp1.sample(&mut random)))
                    .collect();
                library.mix(&recipe).expect("parts above 0 make a mixture")
            })
            .collect();
        Self::of(library, weights, mixtures)
    }

    /// Every pigment by itself as a film that hides.
    #[must_use]
    pub fn masstones(library: &PigmentLibrary, weights: &TristimulusWeights) -> Self {
        Self::of(
            library,
            weights,
            library
                .ids()
                .map(|id| library.mix([(id, 1.0)]).expect("one part makes a mixture"))
                .collect(),
        )
    }

    /// Appends the mixtures of `other`.
    #[must_use]
    pub fn joined(mut self, other: Self) -> Self {
        self.mixtures.extend(other.mixtures);
        self.xyz.extend(other.xyz);
        self
    }

    /// Number of mixtures in the set.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mixtures.len()
    }

    /// Whether the set holds no mixture.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mixtures.is_empty()
    }

    fn of(library: &PigmentLibrary, weights: &TristimulusWeights, mixtures: Vec<Curves>) -> Self {
        let surface = library.saunderson;
        Self {
            grid: library.grid,
            surface,
            xyz: mixtures.iter().map(|m| weights.xyz(&m.hiding(surface))).collect(),
            mixtures,
            white: weights.white(),
        }
    }
}
