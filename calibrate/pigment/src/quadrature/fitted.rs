//! Nodes and weights that we fit to the mixtures of a library. You can also compare all methods of choosing
//! wavelengths, for several numbers of them.

use std::ops::RangeInclusive;

use documents::Task;
use nalgebra::DVector;
use rayon::prelude::*;
use spectra::color::{Lab, Matrix3, Xyz, ciede2000_metric};
use spectra::optics::{infinite_film, infinite_film_from_ratio, infinite_film_slope};

use super::rule::{
    MixtureSet, NODE_BAND_NM, Quadrature, QuadratureError, QuadratureFailure, on_line,
};
use crate::evaluate::Viewing;
use crate::least_squares::{NormalEquations, Stop, minimise};
use crate::library::PigmentLibrary;

/// We train with this many random mixtures, besides all masstones. We chose it by eye.
const TRAINING: usize = 700;
const TRAINING_SEED: u64 = 2004;
const STOP: Stop = Stop { iterations: 120, relative_decrease: 1e-6 };
/// Greatest absolute value of every weight. The weights of a channel sum to about 100, so a good fit never
/// reaches this.
const LARGEST_WEIGHT: f64 = 1e3;

impl Quadrature {
    /// Fits nodes and weights so that the mixtures of `library` keep their colours. This is least squares
    /// in CIEDE2000 over its masstones and seeded random mixtures, from several starts.
    ///
    /// # Errors
    /// [`QuadratureFailure::Count`] for 0 nodes, or more than 32.
    pub fn library(
        viewing: &Viewing,
        library: &PigmentLibrary,
        count: usize,
    ) -> Result<Self, QuadratureFailure> {
        let start = Self::moments(viewing, count)?;
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let random = MixtureSet::for_fitting(library, &weights, TRAINING, TRAINING_SEED);
        let training = MixtureSet::masstones(library, &weights).joined(random);
        Ok(fitted(&start, &training))
    }
}

/// Returns the best of several fits.
///
/// The unknowns are the n nodes and, in each channel, all weights but the last, which we get from the sum
/// for the white. The residuals are differences from the exact colours in the local metric of CIEDE2000. We
/// start from the nodes of `start`, from the same nodes moved towards or away from their mean, and from
/// evenly spaced nodes.
fn fitted(start: &Quadrature, training: &MixtureSet) -> Quadrature {
    let problem = Problem::new(start, training);
    let count = start.nodes_nm.len();
    let middle = start.nodes_nm.iter().sum::<f64>() / count as f64;
    let [narrow, wide] = [0.85, 1.1].map(|factor: f64| -> Vec<f64> {
        start.nodes_nm.iter().map(|nm| middle + factor * (nm - middle)).collect()
    });
    let starts = [
        start.nodes_nm.clone(),
        narrow,
        wide,
        even_nodes(count, 410.0, 680.0),
        even_nodes(count, 425.0, 650.0),
    ];
    let fits: Vec<(f64, Quadrature)> =
        starts.into_par_iter().map(|nodes| problem.solve(nodes)).collect();
    let best = fits.into_iter().reduce(|a, b| if b.0 < a.0 { b } else { a });
    best.expect("there is a start").1
}

fn even_nodes(count: usize, low: f64, high: f64) -> Vec<f64> {
    (0..count).map(|i| low + (high - low) * (i as f64 + 0.5) / count as f64).collect()
}

struct Problem<'a> {
    start: &'a Quadrature,
    training: &'a MixtureSet,
    targets: Vec<(Lab, Matrix3)>,
}

impl<'a> Problem<'a> {
    fn new(start: &'a Quadrature, training: &'a MixtureSet) -> Self {
        Self {
            start,
            training,
            targets: training
                .xyz
                .iter()
                .map(|xyz| {
                    let lab = Lab::from_xyz(*xyz, training.white);
                    (lab, ciede2000_metric(lab))
                })
                .collect(),
        }
    }

    /// Fits from these nodes and returns the cost with the quadrature.
    fn solve(&self, nodes: Vec<f64>) -> (f64, Quadrature) {
        let n = nodes.len();
        let mut nodes = nodes;
        nodes.sort_by(f64::total_cmp);
        let weights = self.linear_weights(&nodes);
        let mut point = DVector::zeros(n + 3 * (n - 1));
        for (i, nm) in nodes.iter().enumerate() {
            point[i] = *nm;
        }
        for i in 0..n - 1 {
            for channel in 0..3 {
                point[n + 3 * i + channel] = weights[i][channel];
            }
        }
        let mut lower = DVector::from_element(point.len(), -LARGEST_WEIGHT);
        let mut upper = DVector::from_element(point.len(), LARGEST_WEIGHT);
        lower.rows_mut(0, n).fill(NODE_BAND_NM[0]);
        upper.rows_mut(0, n).fill(NODE_BAND_NM[1]);
        let minimum = minimise(
            point,
            (&lower, &upper),
            STOP,
            &Task::default(),
            |p| self.equations(p),
            |p| self.cost(p),
        );
        (minimum.cost, self.quadrature(&minimum.point))
    }

    /// Weights for fixed nodes by linear least squares in XYZ.
    fn linear_weights(&self, nodes: &[f64]) -> Vec<[f64; 3]> {
        let n = nodes.len();
        let mut equations = [(); 3].map(|()| NormalEquations::zeros(n));
        let white = self.training.white.to_array();
        for (index, xyz) in self.training.xyz.iter().enumerate() {
            let reflectance: Vec<f64> =
                nodes.iter().map(|&nm| self.reflectance(index, nm).0).collect();
            // With relative errors we give dark colours the weight that the eye gives them.
            let weight = (xyz.y + 1.0).recip().powi(2);
            for (channel, value) in xyz.to_array().into_iter().enumerate() {
                equations[channel].add(-value, &reflectance, weight);
            }
        }
        let solved = equations.map(|mut equations| {
            for i in 0..n {
                equations.matrix[(i, i)] *= 1.0 + 1e-9;
            }
            let cholesky = equations.matrix.cholesky();
            cholesky.map_or_else(|| DVector::zeros(n), |c| c.solve(&-equations.gradient))
        });
        (0..n)
            .map(|i| {
                std::array::from_fn(|channel| {
                    let value = solved[channel][i];
                    if value.is_finite() { value } else { white[channel] / n as f64 }
                })
            })
            .collect()
    }

    fn quadrature(&self, point: &DVector<f64>) -> Quadrature {
        let n = self.start.nodes_nm.len();
        let white = self.start.white.to_array();
        let mut last = white;
        let mut pairs: Vec<(f64, [f64; 3])> = (0..n - 1)
            .map(|i| {
                let weights: [f64; 3] = std::array::from_fn(|channel| point[n + 3 * i + channel]);
                for (rest, weight) in last.iter_mut().zip(weights) {
                    *rest -= weight;
                }
                (point[i], weights)
            })
            .collect();
        pairs.push((point[n - 1], last));
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (nodes_nm, weights) = pairs.into_iter().unzip();
        Quadrature { nodes_nm, weights, white: self.start.white }
    }

    /// Measured reflectance of a mixture at `nm`, and its derivative with respect to the wavelength.
    fn reflectance(&self, index: usize, nm: f64) -> (f64, f64) {
        let mixture = &self.training.mixtures[index];
        let (k, k_slope) = on_line(self.training.grid, &mixture.absorption, nm);
        let (s, s_slope) = on_line(self.training.grid, &mixture.scattering, nm);
        let internal = infinite_film(k, s);
        let surface = self.training.surface;
        let slope = if k > 0.0 && s > 0.0 && internal < 1.0 {
            let ratio = k / s;
            let ratio_over_nm = (k_slope - ratio * s_slope) / s;
            infinite_film_slope(infinite_film_from_ratio(ratio)) * ratio_over_nm
        } else {
            0.0
        };
        (surface.measured_from_internal(internal), surface.measured_slope(internal) * slope)
    }

    /// Residual of a mixture and its derivatives with respect to XYZ.
    fn residual(&self, index: usize, xyz: Xyz) -> ([f64; 3], Matrix3) {
        let white = self.training.white;
        let (target, metric) = &self.targets[index];
        let lab = Lab::from_xyz(xyz, white);
        let difference = [lab.lightness - target.lightness, lab.a - target.a, lab.b - target.b];
        let lab_over_xyz = Lab::slopes_over_xyz(xyz, white);
        (metric.apply(difference), metric.after(&lab_over_xyz))
    }

    fn equations(&self, point: &DVector<f64>) -> NormalEquations {
        let n = self.start.nodes_nm.len();
        let weights = self.weights_in_order(point);
        let mut equations = NormalEquations::zeros(point.len());
        let mut derivatives = vec![0.0; point.len()];
        for index in 0..self.training.len() {
            let at_nodes: Vec<(f64, f64)> =
                (0..n).map(|i| self.reflectance(index, point[i])).collect();
            let (residual, slopes) = self.residual(index, sum(&at_nodes, &weights));
            let last = at_nodes[n - 1].0;
            for (row, slope) in residual.into_iter().zip(slopes.0) {
                for i in 0..n {
                    let along: f64 = (0..3).map(|c| slope[c] * weights[i][c]).sum();
                    derivatives[i] = along * at_nodes[i].1;
                    if i + 1 < n {
                        for channel in 0..3 {
                            derivatives[n + 3 * i + channel] =
                                slope[channel] * (at_nodes[i].0 - last);
                        }
                    }
                }
                equations.add(row, &derivatives, 1.0);
            }
        }
        equations
    }

    fn cost(&self, point: &DVector<f64>) -> f64 {
        let n = self.start.nodes_nm.len();
        let weights = self.weights_in_order(point);
        (0..self.training.len())
            .map(|index| {
                let at_nodes: Vec<(f64, f64)> =
                    (0..n).map(|i| self.reflectance(index, point[i])).collect();
                let (residual, _) = self.residual(index, sum(&at_nodes, &weights));
                residual.iter().map(|r| 0.5 * r * r).sum::<f64>()
            })
            .sum()
    }

    /// All weights in the order of the nodes of `point`, which are not sorted.
    fn weights_in_order(&self, point: &DVector<f64>) -> Vec<[f64; 3]> {
        let n = self.start.nodes_nm.len();
        let mut last = self.start.white.to_array();
        let mut weights: Vec<[f64; 3]> = Vec::with_capacity(n);
        for i in 0..n - 1 {
            let own: [f64; 3] = std::array::from_fn(|channel| point[n + 3 * i + channel]);
            for (rest, weight) in last.iter_mut().zip(own) {
                *rest -= weight;
            }
            weights.push(own);
        }
        weights.push(last);
        weights
    }
}

fn sum(at_nodes: &[(f64, f64)], weights: &[[f64; 3]]) -> Xyz {
    let mut xyz = [0.0; 3];
    for ((value, _), weights) in at_nodes.iter().zip(weights) {
        for (total, weight) in xyz.iter_mut().zip(weights) {
            *total += value * weight;
        }
    }
    xyz.into()
}

/// Method of choosing wavelengths and weights. The module's table describes each.
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

/// We test trials on this many random mixtures. It is the default of `impasto quadrature`.
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
    /// Computes each method with each of `counts` wavelengths, ordered by method, and its error on 1000
    /// random mixtures of `library`. This uses all cores.
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
