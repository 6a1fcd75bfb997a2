//! Seeded random mixtures of a library, with their exact colour.

use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1};
use spectra::color::Xyz;
use spectra::optics::Surface;
use spectra::{Grid, TristimulusWeights};

use crate::library::PigmentLibrary;
use crate::mixture::Mixture;

/// Mixtures of a library in films that hide.
#[derive(Debug, Clone, PartialEq)]
pub struct MixtureSet {
    pub(super) grid: Grid,
    pub(super) surface: Surface,
    pub(super) mixtures: Vec<Mixture>,
    /// By full integration over the library's grid.
    pub(super) xyz: Vec<Xyz>,
    pub(super) white: Xyz,
}

impl MixtureSet {
    /// `count` mixtures: one to four pigments, each number as likely as the
    /// next, any pigments, shares uniform over all that sum to 1. The same seed
    /// gives the same mixtures.
    #[must_use]
    pub fn random(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
    ) -> Self {
        Self::from_stream(library, weights, count, seed, 0)
    }

    /// Mixtures to fit a quadrature to: whatever the seed, none of those that
    /// [`MixtureSet::random`] gives.
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
                let recipe: Vec<(usize, f64)> = index::sample(&mut random, pigments, parts)
                    .into_iter()
                    .map(|pigment| (pigment, Exp1.sample(&mut random)))
                    .collect();
                library.mix(&recipe).expect("parts above 0 make a mixture")
            })
            .collect();
        Self::of(library, weights, mixtures)
    }

    /// Every pigment by itself.
    #[must_use]
    pub fn masstones(library: &PigmentLibrary, weights: &TristimulusWeights) -> Self {
        let alone = |index| library.mix(&[(index, 1.0)]).expect("one part makes a mixture");
        Self::of(library, weights, (0..library.pigments.len()).map(alone).collect())
    }

    /// This set and `other` together.
    #[must_use]
    pub fn joined(mut self, other: Self) -> Self {
        self.mixtures.extend(other.mixtures);
        self.xyz.extend(other.xyz);
        self
    }

    /// How many mixtures.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mixtures.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mixtures.is_empty()
    }

    fn of(library: &PigmentLibrary, weights: &TristimulusWeights, mixtures: Vec<Mixture>) -> Self {
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
