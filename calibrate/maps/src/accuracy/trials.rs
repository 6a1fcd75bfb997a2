//! Simulated paintings, scores of a trial, and common linear methods for comparison.
//!
//! A simulated painting has pixels of known pigments, but its real K and S differ from the library.

use nalgebra::{Cholesky, DMatrix, DVector};
use pigment::library::PigmentLibrary;
use pigment::{Curves, PigmentId};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use spectra::optics::absorption_over_scattering;

use crate::films::film::Paints;
use crate::mapping::{Gap, Mapper};
use crate::pixel_maps::{BlockMaps, MapError, Mask};

/// Correlation length in nm of the simulated errors of K and S.
const SMOOTH_NM: f64 = 50.0;
/// Standard deviation of the logarithm of each amount between pixels of one recipe.
const UNEVEN: f64 = 0.1;
/// A difference of scores up to this does not count as worse.
const EQUAL: f32 = 0.05;

/// Plan of a simulated painting. We draw every number from its seed.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintingPlan {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Number of pigments in the painting. We draw them from the library, or from `palette` if it
    /// names some.
    pub pigments: usize,
    /// Names of the pigments that we may draw. If this is empty, we may draw all of the library.
    pub palette: Vec<String>,
    /// Number of recipes. Each has one to `at_most` pigments.
    pub recipes: usize,
    /// Greatest number of pigments in a recipe.
    pub at_most: usize,
    /// Least share of a pigment in a recipe.
    pub least_share: f64,
    /// Number of pixels.
    pub pixels: usize,
    /// Standard deviation of the noise of each band, in reflectance.
    pub noise: f64,
    /// Standard deviation of the smooth errors of K and S, relative to their values.
    pub error: f64,
    /// Standard deviation of the logarithm of each paint's strength, relative to its library: errors
    /// of weighing, and of other batches.
    pub strength: f64,
    /// Standard deviation of the light that the surface itself reflects, from pixel to pixel, in
    /// reflectance.
    pub gloss: f64,
}

impl Default for PaintingPlan {
    /// 8 pigments and 60 recipes, each of one to three pigments with shares of at least 10 %. The
    /// noise is 0.003, and K and S are off by 10 %.
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
            strength: 0.0,
            gloss: 0.0,
        }
    }
}

/// Compares the best set of a full search with the true pigments of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BesideTruth {
    /// Whether the score of the best set is worse than the score of the true pigments. Then a wider
    /// search would have found them.
    pub is_worse: bool,
    /// Whether the best set holds the true pigments, or pigments of the same groups.
    pub is_right: bool,
    /// Chi-square of the best set minus the chi-square of the true pigments. This shows how much
    /// the spectrum speaks for the true ones.
    pub chi2: f64,
}

/// Simulated pixels and their truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Painting {
    /// Names of the pigments of the painting.
    pub pigments: Vec<String>,
    /// Pigments of each pixel, as indices in `pigments`, with their shares.
    pub truth: Vec<Vec<(usize, f64)>>,
    /// Reflectances, pixel after pixel, on the library's grid.
    pub spectra: Vec<f32>,
}

impl Painting {
    /// Simulates a painting with the pigments of `real` that are also in `known`.
    #[must_use]
    pub fn simulate(real: &PigmentLibrary, known: &PigmentLibrary, plan: &PaintingPlan) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(plan.seed);
        let mut ids: Vec<PigmentId> = (real.ids())
            .filter(|&id| usable(real, &real[id].name) && usable(known, &real[id].name))
            .filter(|&id| plan.palette.is_empty() || plan.palette.contains(&real[id].name))
            .collect();
        ids.shuffle(&mut random);
        ids.truncate(plan.pigments);
        ids.sort_unstable();
        let grid = real.grid;
        let factor = smooth_factor(&grid.wavelengths_nm().collect::<Vec<f64>>());
        let curves: Vec<[Vec<f64>; 2]> = (ids.iter())
            .map(|&id| {
                [&real[id].absorption, &real[id].scattering].map(|values| {
                    let normal =
                        DVector::from_fn(values.len(), |_, _| StandardNormal.sample(&mut random));
                    let errors: DVector<f64> = &factor * normal;
                    values.iter().zip(&errors).map(|(v, e)| v * (plan.error * e).exp()).collect()
                })
            })
            .collect();
        let strengths: Vec<f64> = match plan.strength > 0.0 {
            true => (0..ids.len())
                .map(|_| {
                    let normal: f64 = StandardNormal.sample(&mut random);
                    (plan.strength * normal).exp()
                })
                .collect(),
            false => vec![1.0; ids.len()],
        };
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
                let [k, s] = &curves[place];
                (share * strengths[place], k.as_slice(), s.as_slice())
            });
            let film = Curves::weighted_sum(grid, parts).hiding(real.saunderson);
            let gloss = match plan.gloss > 0.0 {
                true => {
                    let normal: f64 = StandardNormal.sample(&mut random);
                    plan.gloss * normal
                }
                false => 0.0,
            };
            for reflectance in film {
                let normal: f64 = StandardNormal.sample(&mut random);
                spectra.push((reflectance + gloss + plan.noise * normal) as f32);
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

    /// True shares of pixel `index`, in the columns of `mapper`.
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

    /// Trials of all pixels in `maps`. Pass the `mapper` that made them.
    #[must_use]
    pub fn trials(&self, mapper: &Mapper, maps: &BlockMaps) -> Vec<Trial> {
        (0..self.truth.len())
            .map(|index| Trial::of_map(maps, index, &self.truth_by_column(mapper, index)))
            .collect()
    }

    /// Compares the best set of a full search of each pixel with its true pigments, after refining
    /// their shares.
    ///
    /// # Errors
    /// [`MapError::Length`] if the library of `mapper` has other wavelengths.
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

fn usable(library: &PigmentLibrary, name: &str) -> bool {
    library.pigments.iter().any(|p| p.name == name && p.identified && !p.guessed)
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

/// Matrix that turns independent normal numbers into smooth curves of variance 1.
fn smooth_factor(nm: &[f64]) -> DMatrix<f64> {
    let covariance = DMatrix::from_fn(nm.len(), nm.len(), |i, j| {
        let x = (nm[i] - nm[j]) / SMOOTH_NM;
        (-0.5 * x * x).exp() + if i == j { 1e-6 } else { 0.0 }
    });
    let identity = DMatrix::identity(nm.len(), nm.len());
    Cholesky::new(covariance).map_or(identity, |cholesky| cholesky.l())
}

/// A pixel with known pigments, and the answer of a method. All lists are by pigment or group.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// True shares, sum 1.
    pub truth: Vec<f64>,
    /// Shares that the method found.
    pub told: Vec<f64>,
    /// Whether the method finds each pigment or group present.
    pub present: Vec<bool>,
    /// Probability that each pigment or group is present. This is empty if the method does not give
    /// one.
    pub probability: Vec<f64>,
    /// Standard deviation of each share. This is empty if the method does not give one.
    pub sd: Vec<f64>,
    /// Chi-square per degree of freedom, or NaN if the method does not give one.
    pub chi2: f64,
    /// Least true share that counts as present, or 0 if we do not look for traces. A smaller share
    /// is a trace: finding it is neither right nor wrong.
    pub least: f64,
}

impl Trial {
    /// Trial of pixel `index` of a map. Pass the true shares by column as `truth`. A column counts
    /// as present if its probability is one half or more.
    #[must_use]
    pub fn of_map(maps: &BlockMaps, index: usize, truth: &[f64]) -> Self {
        let columns = index * maps.pigments..(index + 1) * maps.pigments;
        let mapped = maps.mask[index] == Mask::Mapped;
        let [told, probability, sd] = [&maps.share, &maps.presence, &maps.share_sd].map(|values| {
            values[columns.clone()].iter().map(|value| f64::from(*value)).collect::<Vec<f64>>()
        });
        Self {
            truth: truth.to_vec(),
            told: told.into_iter().map(|v| if mapped { v } else { 0.0 }).collect(),
            present: probability.iter().map(|p| *p >= 0.5).collect(),
            probability,
            sd,
            chi2: f64::from(maps.chi2[index]),
            least: 0.0,
        }
    }

    /// Whether pigment `index` is present, or `None` for a trace.
    #[must_use]
    pub fn is_there(&self, index: usize) -> Option<bool> {
        match self.truth[index] {
            share if share > 0.0 && share >= self.least => Some(true),
            share if share > 0.0 => None,
            _ => Some(false),
        }
    }

    /// Joins the columns that have the same number in `group_of`. Numbers are below `count`. This
    /// drops probabilities and deviations, because you cannot join them.
    #[must_use]
    pub fn joined(&self, group_of: &[usize], count: usize) -> Self {
        let [truth, told] = [&self.truth, &self.told].map(|values| {
            let mut sums = vec![0.0; count];
            values.iter().zip(group_of).for_each(|(value, &group)| sums[group] += value);
            sums
        });
        let mut present = vec![false; count];
        self.present.iter().zip(group_of).for_each(|(&is, &group)| present[group] |= is);
        Self {
            truth,
            told,
            present,
            probability: Vec::new(),
            sd: Vec::new(),
            chi2: self.chi2,
            least: self.least,
        }
    }
}

/// Figures of many trials.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scores {
    /// Share of the found pigments that are present, 0 to 1.
    pub precision: f64,
    /// Share of the present pigments that the method finds, 0 to 1.
    pub recall: f64,
    /// Mean over pixels of half the sum of the absolute errors of the shares.
    pub share_error: f64,
}

impl Scores {
    /// Figures of `trials`.
    #[must_use]
    pub fn of<'a>(trials: impl IntoIterator<Item = &'a Trial>) -> Self {
        let mut sums = ScoreSums::default();
        trials.into_iter().for_each(|trial| sums.add(trial));
        sums.scores()
    }

    /// Harmonic mean of precision and recall.
    #[must_use]
    pub fn f1(&self) -> f64 {
        let sum = self.precision + self.recall;
        if sum > 0.0 { 2.0 * self.precision * self.recall / sum } else { 0.0 }
    }
}

impl std::fmt::Display for Scores {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { precision, recall, share_error } = self;
        write!(f, "{precision:.3} {recall:.3} {share_error:.3}")
    }
}

/// Sums over trials. You may add them one after another.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ScoreSums {
    /// Number of trials.
    pub count: f64,
    /// Pigments that the method finds and that are present.
    pub right: f64,
    /// Pigments that the method finds, without traces.
    pub told: f64,
    /// Pigments that are present.
    pub there: f64,
    /// Sum of half the absolute errors of the shares.
    pub error: f64,
}

impl ScoreSums {
    /// Adds a trial.
    pub fn add(&mut self, trial: &Trial) {
        self.count += 1.0;
        for (index, (&truth, &share)) in trial.truth.iter().zip(&trial.told).enumerate() {
            self.error += 0.5 * (truth - share).abs();
            let Some(is_there) = trial.is_there(index) else { continue };
            let told = trial.present[index];
            self.there += f64::from(u8::from(is_there));
            self.told += f64::from(u8::from(told));
            self.right += f64::from(u8::from(told && is_there));
        }
    }

    /// Figures of all trials so far.
    #[must_use]
    pub fn scores(&self) -> Scores {
        Scores {
            precision: ratio(self.right, self.told),
            recall: ratio(self.right, self.there),
            share_error: ratio(self.error, self.count),
        }
    }
}

fn ratio(value: f64, of: f64) -> f64 {
    if of > 0.0 { value / of } else { 0.0 }
}

/// Probabilities of one range, compared with how often the pigments are present.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reliability {
    /// Least probability of the range.
    pub from: f64,
    /// Number of probabilities in it.
    pub count: usize,
    /// Mean of these probabilities.
    pub told: f64,
    /// Share of these cases in which the pigment is present.
    pub true_part: f64,
}

/// Reliability of the probabilities of `trials` by range. A range starts at each of `ends` and
/// stops before the next one.
#[must_use]
pub fn reliability<'a>(
    trials: impl IntoIterator<Item = &'a Trial> + Clone,
    ends: &[f64],
) -> Vec<Reliability> {
    (0..ends.len())
        .map(|index: usize| {
            let from = ends[index];
            let to = ends.get(index + 1).copied().unwrap_or(f64::INFINITY);
            let mut count = 0;
            let mut told = 0.0;
            let mut is_true = 0.0;
            for trial in trials.clone() {
                for (index, &probability) in trial.probability.iter().enumerate() {
                    if let (Some(is_there), true) =
                        (trial.is_there(index), (from..to).contains(&probability))
                    {
                        count += 1;
                        told += probability;
                        is_true += f64::from(u8::from(is_there));
                    }
                }
            }
            let of = (count as f64).max(1.0);
            Reliability { from, count, told: told / of, true_part: is_true / of }
        })
        .collect()
}

/// How often shares lie within their standard deviation of the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Number of shares.
    pub count: usize,
    /// Part of them within one standard deviation.
    pub within: f64,
}

/// Coverage of the shares of all pigments that the method finds. We leave out pixels where it finds
/// only one, because its share is 1 by definition.
#[must_use]
pub fn coverage<'a>(trials: impl IntoIterator<Item = &'a Trial>) -> Coverage {
    let mut count = 0;
    let mut within = 0;
    for trial in trials {
        let (more, inside) = covered(trial);
        count += more;
        within += inside;
    }
    Coverage { count, within: within as f64 / (count as f64).max(1.0) }
}

/// Number of shares of one trial that [`coverage`] counts, and how many of them lie within one
/// standard deviation.
#[must_use]
pub fn covered(trial: &Trial) -> (usize, usize) {
    let alone = trial.present.iter().filter(|is| **is).count() < 2;
    let counted = (0..trial.sd.len()).filter(|&index| trial.present[index] && !alone);
    let within = (counted.clone())
        .filter(|&index| (trial.truth[index] - trial.told[index]).abs() <= trial.sd[index]);
    (counted.count(), within.count())
}

/// A common linear method of unmixing, for comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Baseline {
    /// Nonnegative least squares on reflectance, shares of sum 1.
    Reflectance,
    /// Nonnegative least squares on -ln of reflectance, shares of sum 1.
    Absorbance,
    /// Nonnegative least squares on K/S (Kubelka-Munk theory with one constant).
    Ratio,
    /// Spectral angle to the masstones. The nearest masstone gets the share 1.
    Angle,
    /// Nonnegative least squares on K - Q S with shares of sum 1, where Q is K/S of the pixel
    /// (Kubelka-Munk theory with two constants): a mixture like the pixel sums to 0 in each band. We
    /// divide each band by 1 + Q, so that dark bands do not outweigh the others.
    TwoConstants,
}

/// Shares that a baseline finds.
#[derive(Debug, Clone, PartialEq)]
pub struct Unmixed {
    /// Share of each pigment, sum 1.
    pub shares: Vec<f64>,
}

/// Weight of the equation that makes the shares sum to 1.
const SUM: f64 = 100.0;
/// We stop coordinate descent after this many sweeps.
const SWEEPS: usize = 20_000;

impl Baseline {
    /// The baselines that know the masstones alone, in the order of a table.
    pub const ALL: [Self; 4] = [Self::Reflectance, Self::Absorbance, Self::Ratio, Self::Angle];

    /// Name for a table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reflectance => "linear R, NNLS sum 1",
            Self::Absorbance => "-log R, NNLS sum 1",
            Self::Ratio => "K/S one constant, NNLS",
            Self::Angle => "spectral angle",
            Self::TwoConstants => "K - Q S two constants, NNLS sum 1",
        }
    }

    /// Shares of the pigments of `paints` in a film. Pass its reflectance on their bands.
    #[must_use]
    pub fn unmix(self, paints: &Paints, reflectance: &[f64]) -> Unmixed {
        let ratio = |reflectance: f64| {
            let internal = paints.surface.internal_from_measured(reflectance).unwrap_or(0.0);
            absorption_over_scattering(internal.clamp(1e-3, 1.0))
        };
        if self == Self::TwoConstants {
            let ratios: Vec<f64> = reflectance.iter().copied().map(ratio).collect();
            let curves = paints.absorption.iter().zip(&paints.scattering);
            let columns = curves.map(|(k, s)| {
                let bands = k.iter().zip(s).zip(&ratios);
                bands.map(|((k, s), q)| (k - q * s) / (1.0 + q)).chain([SUM]).collect()
            });
            let target: Vec<f64> = ratios.iter().map(|_| 0.0).chain([SUM]).collect();
            return Unmixed::of(nonnegative(&columns.collect::<Vec<Vec<f64>>>(), &target));
        }
        let masstones = (0..paints.count()).map(|p| paints.reflectance(&[(p, 1.0)]));
        let mut spectra: Vec<Vec<f64>> = masstones.chain([reflectance.to_vec()]).collect();
        for value in spectra.iter_mut().flatten() {
            *value = match self {
                Self::Reflectance | Self::Angle | Self::TwoConstants => *value,
                Self::Absorbance => -value.max(1e-3).ln(),
                Self::Ratio => ratio(*value),
            };
        }
        let mut target = spectra.pop().unwrap_or_default();
        let mut columns = spectra;
        if self == Self::Angle {
            let cosines: Vec<f64> = columns
                .iter()
                .map(|column| dot(column, &target) / dot(column, column).sqrt())
                .collect();
            let nearest = (0..columns.len())
                .reduce(|a: usize, b: usize| if cosines[b] > cosines[a] { b } else { a })
                .unwrap_or(0);
            let shares = (0..columns.len()).map(|p| f64::from(u8::from(p == nearest))).collect();
            return Unmixed { shares };
        }
        if self != Self::Ratio {
            target.push(SUM);
            columns.iter_mut().for_each(|column| column.push(SUM));
        }
        Unmixed::of(nonnegative(&columns, &target))
    }
}

impl Unmixed {
    /// Scales nonnegative parts to the sum 1.
    fn of(mut shares: Vec<f64>) -> Self {
        let sum: f64 = shares.iter().sum::<f64>().max(1e-12);
        shares.iter_mut().for_each(|share| *share /= sum);
        Self { shares }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Nonnegative least squares by coordinate descent, which converges from every start.
fn nonnegative(columns: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    let count = columns.len();
    let gram: Vec<Vec<f64>> =
        columns.iter().map(|a| columns.iter().map(|b| dot(a, b)).collect()).collect();
    let mut slope: Vec<f64> = columns.iter().map(|column| -dot(column, target)).collect();
    let mut x = vec![0.0f64; count];
    for _ in 0..SWEEPS {
        let mut largest = 0.0f64;
        for i in 0..count {
            let next = (x[i] - slope[i] / gram[i][i].max(1e-12)).max(0.0);
            let change = next - x[i];
            if change != 0.0 {
                x[i] = next;
                slope.iter_mut().zip(&gram[i]).for_each(|(slope, g)| *slope += change * g);
                largest = largest.max(change.abs());
            }
        }
        if largest < 1e-9 {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_squares_meet_the_conditions_of_an_optimum() {
        let columns = [vec![1.0, 0.2, 0.1], vec![0.9, 0.3, 0.1], vec![0.1, 0.4, 1.0]];
        let target = [0.5, 0.1, 0.7];
        let x = nonnegative(&columns, &target);
        for (column, x) in columns.iter().zip(&x) {
            let rest: Vec<f64> = (0..3)
                .map(|row| {
                    target[row]
                        - columns
                            .iter()
                            .zip(&*nonnegative(&columns, &target))
                            .map(|(c, x)| c[row] * x)
                            .sum::<f64>()
                })
                .collect();
            let slope = dot(column, &rest);
            assert!(slope < 1e-6 && (slope.abs() < 1e-6 || *x == 0.0), "{x} {slope}");
        }
    }
}
