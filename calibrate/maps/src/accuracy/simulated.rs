//! Simulated paintings: pixels of known pigments, whose real K and S differ from the library's.

use nalgebra::{Cholesky, DMatrix, DVector};
use pigment::library::PigmentLibrary;
use pigment::{Curves, PigmentId};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::accuracy::scores::Trial;
use crate::map_error::MapError;
use crate::mapping::mapper::{Gap, Mapper};
use crate::pixel_maps::BlockMaps;

/// Length in nm over which the simulated errors of K and S are alike.
const SMOOTH_NM: f64 = 50.0;
/// Standard deviation of the logarithm of each amount, from pixel to pixel of one recipe.
const UNEVEN: f64 = 0.1;
/// Difference of scores that does not count as worse.
const EQUAL: f32 = 0.05;

/// Plan of a simulated painting. Every number is drawn from its seed.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintingPlan {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Pigments of the painting, drawn from the library, or from `palette` if it names some.
    pub pigments: usize,
    /// Names of the pigments that may be drawn; empty for all of the library.
    pub palette: Vec<String>,
    /// Recipes of the painting, each of one to `at_most` of its pigments.
    pub recipes: usize,
    /// Most pigments of a recipe.
    pub at_most: usize,
    /// Least share of a pigment in a recipe.
    pub least_share: f64,
    /// Number of pixels.
    pub pixels: usize,
    /// Standard deviation of the noise of each band, in reflectance.
    pub noise: f64,
    /// Standard deviation of the smooth errors of K and S, relative to their values.
    pub error: f64,
}

impl Default for PaintingPlan {
    /// 8 pigments, 60 recipes of one to three of 10 % and more, noise 0.003, K and S off by 10 %.
    fn default() -> Self {
        Self {
            seed: 1,
            pigments: 8,
            palette: Vec::new(),
            recipes: 60,
            at_most: 3,
            least_share: 0.1,
            pixels: 6000,
            noise: 0.003,
            error: 0.1,
        }
    }
}

/// Best set of a whole search beside the true pigments of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BesideTruth {
    /// Whether its score is worse than that of the true pigments, which a wider search would have found.
    pub is_worse: bool,
    /// Whether it has the pigments or groups of the truth.
    pub is_right: bool,
    /// Its chi-square less that of the true pigments: the evidence for them in the spectrum.
    pub chi2: f64,
}

/// Pixels with their truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Painting {
    /// Names of the pigments of the painting.
    pub pigments: Vec<String>,
    /// Pigments of each pixel, by place in `pigments`, with their shares.
    pub truth: Vec<Vec<(usize, f64)>>,
    /// Reflectances, pixel after pixel, on the library's grid.
    pub spectra: Vec<f32>,
}

impl Painting {
    /// Paints with the pigments of `real` that are in `known` too.
    #[must_use]
    pub fn simulate(real: &PigmentLibrary, known: &PigmentLibrary, plan: &PaintingPlan) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(plan.seed);
        let usable = |library: &PigmentLibrary, name: &str| {
            library.pigments.iter().any(|p| p.name == name && p.identified && !p.guessed)
        };
        let mut ids: Vec<PigmentId> = (real.ids())
            .filter(|&id| usable(real, &real[id].name) && usable(known, &real[id].name))
            .filter(|&id| plan.palette.is_empty() || plan.palette.contains(&real[id].name))
            .collect();
        ids.shuffle(&mut random);
        ids.truncate(plan.pigments);
        ids.sort_unstable();
        let grid = real.grid;
        let factor = smooth_factor(&grid.wavelengths_nm().collect::<Vec<f64>>());
        let mut off = |values: &[f64]| -> Vec<f64> {
            let normal = DVector::from_fn(values.len(), |_, _| StandardNormal.sample(&mut random));
            let errors: DVector<f64> = &factor * normal;
            values.iter().zip(&errors).map(|(v, e)| v * (plan.error * e).exp()).collect()
        };
        let curves: Vec<(Vec<f64>, Vec<f64>)> =
            ids.iter().map(|&id| (off(&real[id].absorption), off(&real[id].scattering))).collect();
        let recipes: Vec<Vec<(usize, f64)>> =
            (0..plan.recipes).map(|_| recipe(&mut random, ids.len(), plan)).collect();
        let mut truth = Vec::new();
        let mut spectra = Vec::new();
        for _ in 0..plan.pixels {
            let mut shares = recipes[random.random_range(0..recipes.len())].clone();
            for (_, share) in &mut shares {
                let normal: f64 = StandardNormal.sample(&mut random);
                *share *= (UNEVEN * normal).exp();
            }
            let sum: f64 = shares.iter().map(|(_, share)| share).sum();
            shares.iter_mut().for_each(|(_, share)| *share /= sum);
            let parts = shares.iter().map(|&(place, share)| {
                let (k, s) = &curves[place];
                (share, k.as_slice(), s.as_slice())
            });
            let film = Curves::weighted_sum(grid, parts).hiding(real.saunderson);
            for reflectance in film {
                let normal: f64 = StandardNormal.sample(&mut random);
                spectra.push((reflectance + plan.noise * normal) as f32);
            }
            truth.push(shares);
        }
        Self { pigments: ids.iter().map(|&id| real[id].name.clone()).collect(), truth, spectra }
    }

    /// Mean reflectance of pixel `index` over its bands.
    #[must_use]
    pub fn mean_reflectance(&self, index: usize) -> f32 {
        let bands = self.spectra.len() / self.truth.len().max(1);
        self.spectra[index * bands..(index + 1) * bands].iter().sum::<f32>() / bands as f32
    }

    /// True shares of pixel `index` by the columns of `mapper`.
    #[must_use]
    pub fn truth_by_column(&self, mapper: &Mapper, index: usize) -> Vec<f64> {
        let mut list = vec![0.0; mapper.columns().len()];
        for &(place, share) in &self.truth[index] {
            let name = &self.pigments[place];
            if let Some(column) = mapper.columns().iter().position(|c| c.pigments.contains(name)) {
                list[column] += share;
            }
        }
        list
    }

    /// Trials of all pixels in `maps`, which `mapper` made.
    #[must_use]
    pub fn trials(&self, mapper: &Mapper, maps: &BlockMaps) -> Vec<Trial> {
        (0..self.truth.len())
            .map(|index| Trial::of_map(maps, index, &self.truth_by_column(mapper, index)))
            .collect()
    }

    /// Compares the best set of a whole search of each pixel with its true pigments, whose shares are refined.
    ///
    /// # Errors
    /// [`MapError::Length`] if the library of `mapper` is on other wavelengths.
    pub fn beside_truth(&self, mapper: &Mapper) -> Result<Vec<BesideTruth>, MapError> {
        let true_sets = self.truth.iter().map(|shares| {
            let named = shares.iter().map(|&(place, share)| (self.pigments[place].as_str(), share));
            named.collect::<Vec<(&str, f64)>>()
        });
        let gaps = mapper.gaps_to_truth(&self.spectra, &true_sets.collect::<Vec<_>>())?;
        Ok(gaps
            .into_iter()
            .flatten()
            .map(|gap: Gap| BesideTruth {
                is_worse: gap.score > EQUAL,
                is_right: gap.is_right,
                chi2: f64::from(gap.chi2),
            })
            .collect())
    }
}

fn recipe(random: &mut ChaCha8Rng, pigments: usize, plan: &PaintingPlan) -> Vec<(usize, f64)> {
    let count = random.random_range(1..=plan.at_most.min(pigments));
    let mut places: Vec<usize> = (0..pigments).collect();
    places.shuffle(random);
    places.truncate(count);
    places.sort_unstable();
    // Evenly distributed on the simplex: gaps between sorted numbers.
    let mut ends: Vec<f64> = (1..count).map(|_| random.random::<f64>()).collect();
    ends.push(1.0);
    ends.sort_by(f64::total_cmp);
    let free = 1.0 - plan.least_share * count as f64;
    let mut before = 0.0;
    let mut shares = Vec::new();
    for (place, end) in places.into_iter().zip(ends) {
        shares.push((place, plan.least_share + free * (end - before)));
        before = end;
    }
    shares
}

/// Matrix that makes smooth curves of variance 1 out of independent normal numbers.
fn smooth_factor(nm: &[f64]) -> DMatrix<f64> {
    let covariance = DMatrix::from_fn(nm.len(), nm.len(), |i, j| {
        let x = (nm[i] - nm[j]) / SMOOTH_NM;
        (-0.5 * x * x).exp() + if i == j { 1e-6 } else { 0.0 }
    });
    let identity = DMatrix::identity(nm.len(), nm.len());
    Cholesky::new(covariance).map_or(identity, |cholesky| cholesky.l())
}
