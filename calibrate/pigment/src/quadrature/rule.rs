//! Wavelengths with their weights for X, Y and Z, and their colour error over random mixtures of a library.
//!
//! [`GaussRule`] is the Gaussian quadrature of a tabulated weight function. [`MixtureSet`] holds seeded random
//! mixtures with their exact colours.

use documents::{Cancelled, hint::Explain};
use nalgebra::{DMatrix, SymmetricEigen};
use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1};
use serde::Serialize;
use spectra::color::{Lab, Xyz, delta_e_ciede2000};
use spectra::optics::Surface;
use spectra::{Grid, TristimulusWeights};

use crate::evaluate::{Viewing, percentile};
use crate::library::PigmentLibrary;
use crate::recipe::{Curves, PigmentId, Recipe, hiding_film};

/// A few wavelengths with weights. Use them to turn reflectances at these wavelengths into XYZ.
#[derive(Debug, Clone, PartialEq)]
pub struct Quadrature {
    /// Wavelengths in nm, in rising order.
    pub nodes_nm: Vec<f64>,
    /// Weights of X, Y and Z at each wavelength. Each channel sums to the white.
    pub weights: Vec<[f64; 3]>,
    /// White of the light for the observer, Y = 100.
    pub white: Xyz,
}

/// Colour error of a quadrature against full integration, in CIEDE2000.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct QuadratureError {
    /// Mean of the errors.
    pub mean: f64,
    /// 95th percentile of the errors.
    pub p95: f64,
    /// Largest of the errors.
    pub max: f64,
}

/// Limits of fitted nodes in nm: the band of the CIE's observers.
pub(super) const NODE_BAND_NM: [f64; 2] = [360.0, 830.0];

/// A quadrature has at most this many nodes, about as many as a library has wavelengths. We chose it by
/// eye.
const MAX_NODES: usize = 32;

impl Quadrature {
    /// Computes the published rule of `count` nodes: Gaussian nodes of the nonnegative weight (x + y + z) E
    /// at 1 nm. We divide the weight of each node among the channels in the ratio of x, y and z there
    /// (Baxter, Wendt and Lin 2004, section 5.3).
    ///
    /// # Errors
    /// [`QuadratureFailure::Count`] for 0 nodes, or more than 32.
    pub fn gauss(viewing: &Viewing, count: usize) -> Result<Self, QuadratureFailure> {
        let light = Light::of(viewing);
        let rule = light.rule(count)?;
        let weights = rule
            .nodes
            .iter()
            .zip(&rule.weights)
            .map(|(&nm, weight)| {
                let channels = light.at(nm);
                let sum: f64 = channels.iter().sum();
                channels.map(|c| weight * c / sum)
            })
            .collect();
        Ok(Self { nodes_nm: rule.nodes, weights, white: light.white })
    }

    /// Computes the nodes of [`Quadrature::gauss`] with weights that are exact for polynomials of
    /// degree n - 1 in each channel.
    ///
    /// # Errors
    /// [`QuadratureFailure::Count`] for 0 nodes, or more than 32.
    pub fn moments(viewing: &Viewing, count: usize) -> Result<Self, QuadratureFailure> {
        let light = Light::of(viewing);
        let rule = light.rule(count)?;
        let [x, y, z] = [0, 1, 2].map(|channel| {
            let weight: Vec<f64> = light.channels.iter().map(|c| c[channel]).collect();
            rule.weights_from_moments(&weight)
        });
        let weights = (0..count).map(|i| [x[i], y[i], z[i]]).collect();
        Ok(Self { nodes_nm: rule.nodes, weights, white: light.white })
    }

    /// XYZ of a reflectance given at each node.
    ///
    /// # Panics
    /// If the number of values is not the number of nodes.
    #[must_use]
    pub fn xyz(&self, reflectance: &[f64]) -> Xyz {
        assert_eq!(reflectance.len(), self.weights.len(), "one reflectance for each node");
        let mut xyz = [0.0; 3];
        for (value, weights) in reflectance.iter().zip(&self.weights) {
            for (sum, weight) in xyz.iter_mut().zip(weights) {
                *sum += value * weight;
            }
        }
        xyz.into()
    }

    /// Interpolates values on `grid`, for example K or S, linearly at the nodes. Beyond the grid we hold
    /// the end values.
    #[must_use]
    pub fn at_nodes(&self, grid: Grid, values: &[f64]) -> Vec<f64> {
        self.nodes_nm.iter().map(|&nm| on_line(grid, values, nm).0).collect()
    }

    /// Colour error against full integration over `mixtures`.
    #[must_use]
    pub fn error(&self, mixtures: &MixtureSet) -> QuadratureError {
        let errors: Vec<f64> = mixtures
            .mixtures
            .iter()
            .zip(&mixtures.xyz)
            .map(|(mixture, &exact)| {
                let absorption = self.at_nodes(mixtures.grid, &mixture.absorption);
                let scattering = self.at_nodes(mixtures.grid, &mixture.scattering);
                let found = self.xyz(&hiding_film(&absorption, &scattering, mixtures.surface));
                delta_e_ciede2000(
                    Lab::from_xyz(found, self.white),
                    Lab::from_xyz(exact, mixtures.white),
                )
            })
            .collect();
        QuadratureError::of(&errors)
    }
}

impl QuadratureError {
    pub(super) fn of(errors: &[f64]) -> Self {
        Self {
            mean: errors.iter().sum::<f64>() / errors.len().max(1) as f64,
            p95: percentile(errors, 95.0),
            max: percentile(errors, 100.0),
        }
    }
}

/// Value and slope at `nm` of the piecewise linear curve through values on a grid. Beyond the grid we hold
/// the end values.
pub(super) fn on_line(grid: Grid, values: &[f64], nm: f64) -> (f64, f64) {
    let last = values.len() - 1;
    let position = (nm - grid.start_nm()) / grid.step_nm();
    if last == 0 || position <= 0.0 {
        return (values[0], 0.0);
    }
    if position >= last as f64 {
        return (values[last], 0.0);
    }
    let index = position as usize;
    let rise = values[index + 1] - values[index];
    (values[index] + rise * (position - index as f64), rise / grid.step_nm())
}

/// Tristimulus weights of a light at 1 nm.
struct Light {
    nm: Vec<f64>,
    channels: Vec<[f64; 3]>,
    white: Xyz,
}

impl Light {
    fn of(viewing: &Viewing) -> Self {
        // On the grid of the CIE tables we interpolate nothing.
        let weights = TristimulusWeights::new(
            Grid::cie(),
            &viewing.illuminant,
            viewing.observer,
            spectra::Interpolation::Linear,
        )
        .expect("linear interpolation fits any grid");
        Self {
            nm: Grid::cie().wavelengths_nm().collect(),
            channels: weights.weights().to_vec(),
            white: weights.white(),
        }
    }

    fn rule(&self, count: usize) -> Result<GaussRule, QuadratureFailure> {
        let weight: Vec<f64> = self.channels.iter().map(|c| c.iter().sum()).collect();
        (count <= MAX_NODES)
            .then(|| GaussRule::new(&self.nm, &weight, count))
            .flatten()
            .ok_or(QuadratureFailure::Count(count))
    }

    fn at(&self, nm: f64) -> [f64; 3] {
        std::array::from_fn(|channel| {
            let values: Vec<f64> = self.channels.iter().map(|c| c[channel]).collect();
            on_line(Grid::cie(), &values, nm).0
        })
    }
}

/// Most random mixtures that a request draws.
pub(super) const MOST_MIXTURES: usize = 100_000;

/// A quadrature that cannot be computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error, Explain)]
pub enum QuadratureFailure {
    /// The number of nodes is 0 or above 32.
    #[error("a quadrature has 1 to 32 wavelengths, found `{0}`")]
    #[hint("eight wavelengths are enough for most paints: [nodes=8]")]
    #[fault(Setting)]
    Count(usize),
    /// The number of random mixtures is above 100,000, which take 60 MB.
    #[error("at most {MOST_MIXTURES} random mixtures are drawn, found `{0}`")]
    #[hint("the error hardly changes beyond [mixtures=1000]")]
    #[fault(Setting)]
    Mixtures(usize),
    /// A method fits wavelengths to a library, and there is none.
    #[error("the method `{0}` needs a pigment library")]
    #[hint("name the [library], or choose [method=moments]")]
    #[fault(Setting)]
    NoLibrary(&'static str),
    /// The fit was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

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
    /// Draws `count` mixtures of one to four pigments. Each number of pigments is equally likely. We draw
    /// the pigments uniformly, and the shares are uniform over all that sum to 1. You get the same mixtures
    /// from the same seed.
    #[must_use]
    pub fn random(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
    ) -> Self {
        Self::from_stream(library, weights, count, seed, 0)
    }

    /// Mixtures for fitting a quadrature. We use another random stream than [`MixtureSet::random`], so that
    /// no seed makes the two sets share mixtures.
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

/// Nodes and weights of the Gaussian rule for a discrete weight function.
///
/// We find the three-term recurrence of the orthogonal polynomials by the discretised Stieltjes procedure
/// (Gautschi 1982, 2004, section 2.2.3.1). The nodes are the eigenvalues of the Jacobi matrix, and we get
/// the weights from its eigenvectors (Golub and Welsch 1969). The rule is exact for polynomials up to
/// degree 2 n - 1 summed over the points of the weight function.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussRule {
    /// Nodes in rising order, in the unit of the points.
    pub nodes: Vec<f64>,
    /// Weight of each node, above 0. They sum to the sum of the weight function.
    pub weights: Vec<f64>,
    /// By degree k below n: values of the orthonormal polynomial of degree k at the nodes.
    at_nodes: Vec<Vec<f64>>,
    /// By degree k below n: values of that polynomial at the points of the weight function.
    at_points: Vec<Vec<f64>>,
}

impl GaussRule {
    /// Computes the rule of `count` nodes for the weight function `weight` given at `points`.
    ///
    /// Returns `None` if fewer than `count` points have a weight above 0.
    #[must_use]
    pub fn new(points: &[f64], weight: &[f64], count: usize) -> Option<Self> {
        if count == 0 || weight.iter().filter(|w| **w > 0.0).count() < count {
            return None;
        }
        // On -1..1 the polynomials stay bounded.
        let low = points[0];
        let high = points[points.len() - 1];
        let middle = f64::midpoint(low, high);
        let half = (high - low) / 2.0;
        let t: Vec<f64> = points.iter().map(|p| (p - middle) / half).collect();

        let total: f64 = weight.iter().sum();
        let mut diagonal = Vec::with_capacity(count);
        let mut beside: Vec<f64> = Vec::with_capacity(count);
        let mut at_points = vec![vec![total.sqrt().recip(); t.len()]];
        for k in 0..count {
            let p = &at_points[k];
            let center: f64 = (0..t.len()).map(|i| weight[i] * t[i] * p[i] * p[i]).sum();
            diagonal.push(center);
            if k + 1 == count {
                break;
            }
            let mut next: Vec<f64> = (0..t.len())
                .map(|i| {
                    let before = if k == 0 { 0.0 } else { beside[k - 1] * at_points[k - 1][i] };
                    (t[i] - center) * p[i] - before
                })
                .collect();
            let norm = next.iter().zip(weight).map(|(v, w)| w * v * v).sum::<f64>().sqrt();
            next.iter_mut().for_each(|v| *v /= norm);
            beside.push(norm);
            at_points.push(next);
        }

        let jacobi = DMatrix::from_fn(count, count, |i, j| match i.abs_diff(j) {
            0 => diagonal[i],
            1 => beside[i.min(j)],
            _ => 0.0,
        });
        let eigen = SymmetricEigen::new(jacobi);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let weights: Vec<f64> =
            order.iter().map(|&i| total * eigen.eigenvectors[(0, i)].powi(2)).collect();
        // Column i of the eigenvectors holds the polynomials at node i, scaled to length 1. This length is
        // the root of the weight.
        let at_nodes = (0..count)
            .map(|k| {
                order
                    .iter()
                    .map(|&i| {
                        let first = eigen.eigenvectors[(0, i)];
                        eigen.eigenvectors[(k, i)] / (first * total.sqrt())
                    })
                    .collect()
            })
            .collect();
        let nodes = order.iter().map(|&i| middle + half * eigen.eigenvalues[i]).collect();
        Some(Self { nodes, weights, at_nodes, at_points })
    }

    /// Weights at the same nodes for another weight function on the same points: exact for
    /// polynomials up to degree n - 1. Weights may be negative.
    #[must_use]
    pub fn weights_from_moments(&self, weight: &[f64]) -> Vec<f64> {
        let moments: Vec<f64> =
            self.at_points.iter().map(|p| p.iter().zip(weight).map(|(p, w)| p * w).sum()).collect();
        (0..self.nodes.len())
            .map(|i| {
                let sum: f64 = moments.iter().zip(&self.at_nodes).map(|(m, p)| m * p[i]).sum();
                self.weights[i] * sum
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uneven_weight() -> (Vec<f64>, Vec<f64>) {
        let points: Vec<f64> = (0..300).map(|i| 400.0 + f64::from(i)).collect();
        let weight = points.iter().map(|p| 1.0 + (p / 37.0).sin() + (p / 90.0).cos().powi(2));
        let weight = weight.collect();
        (points, weight)
    }

    #[test]
    fn a_gauss_rule_is_exact_up_to_degree_2n_minus_1() {
        let (points, weight) = uneven_weight();
        let total: f64 = weight.iter().sum();
        for count in 1..=12 {
            let rule = GaussRule::new(&points, &weight, count).unwrap();
            let last = 2 * count as i32 - 1;
            for degree in 0..=last + 1 {
                let exact: f64 =
                    points.iter().zip(&weight).map(|(p, w)| w * scaled_power(degree, *p)).sum();
                let found: f64 = rule
                    .nodes
                    .iter()
                    .zip(&rule.weights)
                    .map(|(n, w)| w * scaled_power(degree, *n))
                    .sum();
                let error = (found - exact).abs() / total;
                match degree <= last {
                    true => assert!(error < 1e-12, "{count} nodes, degree {degree}: {error}"),
                    false => assert!(error > 1e-9, "{count} nodes are exact beyond their degree"),
                }
            }
        }
    }

    fn scaled_power(degree: i32, nm: f64) -> f64 {
        ((nm - 550.0) / 150.0).powi(degree)
    }

    #[test]
    fn moment_weights_are_exact_up_to_degree_n_minus_1() {
        let (points, weight) = uneven_weight();
        let other: Vec<f64> = points.iter().map(|p| (p / 25.0).sin().powi(2)).collect();
        for count in 1..=12 {
            let rule = GaussRule::new(&points, &weight, count).unwrap();
            let weights = rule.weights_from_moments(&other);
            for degree in 0..count as i32 {
                let exact: f64 =
                    points.iter().zip(&other).map(|(p, w)| w * scaled_power(degree, *p)).sum();
                let found: f64 = rule
                    .nodes
                    .iter()
                    .zip(&weights)
                    .map(|(n, w)| w * scaled_power(degree, *n))
                    .sum();
                assert!((found - exact).abs() < 1e-9 * exact.abs().max(1.0), "{count}, {degree}");
            }
        }
    }

    #[test]
    fn a_rule_with_more_nodes_than_points_is_refused() {
        assert_eq!(GaussRule::new(&[1.0, 2.0], &[1.0, 0.0], 2), None);
    }
}
