//! Models that predict films in a fit: films that hide, and films over a known backing.
//!
//! We also compute here what we need before any fit: the colour term of the cost, the rank and condition
//! of the equations, and the pigments that the mixtures determine.
//!
//! The equations K = Q S of the mixtures are homogeneous except for the reference white. We know the S of a
//! pigment only through mixtures that connect it, directly or through others, to this white.

use nalgebra::{DMatrix, SymmetricEigen};
use pigment::{Curves, PigmentId};
use rayon::prelude::*;
use spectra::TristimulusWeights;
use spectra::color::{Lab, Matrix3, Xyz, ciede2000_metric};
use spectra::optics::{Surface, UnevenFilm, infinite_film, infinite_film_slope};

use super::problem::{CurveTable, Layout, Problem};

/// Model of the measured reflectance of a film, from K and S of its mixture.
pub(super) trait Forward: Sync {
    /// Reflectance of sample `index` at wavelength `at`.
    fn reflectance(&self, index: usize, at: usize, k: f64, s: f64) -> f64;

    /// Reflectance with its derivatives with respect to K and S.
    fn linearised(&self, index: usize, at: usize, k: f64, s: f64) -> [f64; 3];
}

/// Model of films that hide their backing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hiding {
    pub(super) surface: Surface,
}

impl Forward for Hiding {
    fn reflectance(&self, _: usize, _: usize, k: f64, s: f64) -> f64 {
        self.surface.measured_from_internal(infinite_film(k, s))
    }

    fn linearised(&self, _: usize, _: usize, k: f64, s: f64) -> [f64; 3] {
        let r = infinite_film(k, s);
        let over_ratio = self.surface.measured_slope(r) * infinite_film_slope(r);
        [self.surface.measured_from_internal(r), over_ratio / s, -over_ratio * k / (s * s)]
    }
}

/// Model of films of unit thickness over known backings. The amounts contain the thickness.
#[derive(Debug, Clone, Copy)]
pub(super) struct Finite<'a> {
    pub(super) film: UnevenFilm,
    /// Internal reflectance of the bare backing, by sample and wavelength.
    pub(super) backing: &'a [Vec<f64>],
}

impl Forward for Finite<'_> {
    fn reflectance(&self, index: usize, at: usize, k: f64, s: f64) -> f64 {
        self.film.reflectance(k, s, self.backing[index][at])
    }

    fn linearised(&self, index: usize, at: usize, k: f64, s: f64) -> [f64; 3] {
        self.film.reflectance_with_slopes(k, s, self.backing[index][at])
    }
}

/// Measured samples with the optical model that predicts them.
#[derive(Debug)]
pub(super) struct Data<'a, F> {
    pub(super) layout: Layout,
    pub(super) forward: F,
    /// Pigments of each sample with their amounts.
    pub(super) recipes: &'a [Vec<(usize, f64)>],
    /// Measured reflectance by sample and wavelength.
    pub(super) target: &'a [Vec<f64>],
    /// Cube roots of the measured reflectance.
    pub(super) roots: Vec<Vec<f64>>,
    /// Standard deviation of repeated readings in measured reflectance, or 0 if unknown.
    pub(super) reading_sd: f64,
    /// For each sample: indices of its unknowns among the unknowns of one wavelength.
    places: Vec<Vec<usize>>,
}

/// A model linearised at a point: values, and derivatives with respect to the unknowns.
pub(super) struct Linear {
    /// Predicted reflectance by sample and wavelength.
    pub(super) values: Vec<Vec<f64>>,
    /// By sample: for each wavelength in turn, one derivative for each unknown of this sample.
    pub(super) slopes: Vec<Vec<f64>>,
}

impl<'a> Data<'a, Hiding> {
    pub(super) fn hiding(problem: &'a Problem) -> Self {
        let layout = Layout {
            pigments: problem.pigments,
            reference: Some(problem.reference.index()),
            wavelengths: problem.grid.count(),
        };
        let forward = Hiding { surface: problem.surface };
        Self::new(layout, forward, &problem.recipes, &problem.reflectance, problem.reading_sd)
    }
}

impl<'a, F: Forward> Data<'a, F> {
    pub(super) fn new(
        layout: Layout,
        forward: F,
        recipes: &'a [Vec<(usize, f64)>],
        target: &'a [Vec<f64>],
        reading_sd: f64,
    ) -> Self {
        let places = recipes
            .iter()
            .map(|recipe| {
                let absorption = recipe.iter().map(|&(pigment, _)| pigment);
                let scattering = recipe.iter().filter_map(|&(p, _)| layout.scattering(p));
                absorption.chain(scattering).collect()
            })
            .collect();
        let roots = target.iter().map(|row| row.iter().map(|value| value.cbrt()).collect());
        Self { layout, forward, recipes, target, roots: roots.collect(), reading_sd, places }
    }

    /// Normal matrix of the derivatives at one wavelength, with equal weights for all samples.
    pub(super) fn normal(&self, linear: &Linear, at: usize) -> DMatrix<f64> {
        let unknowns = self.layout.per_wavelength();
        let mut normal = DMatrix::zeros(unknowns, unknowns);
        for (places, slopes) in self.places.iter().zip(&linear.slopes) {
            let slopes = &slopes[at * places.len()..(at + 1) * places.len()];
            for (a, &row) in places.iter().enumerate() {
                for (b, &column) in places.iter().enumerate() {
                    normal[(row, column)] += slopes[a] * slopes[b];
                }
            }
        }
        normal
    }

    pub(super) fn places(&self, index: usize) -> &[usize] {
        &self.places[index]
    }

    /// Predicted measured reflectance by sample and wavelength.
    pub(super) fn values(&self, curves: &CurveTable) -> Vec<Vec<f64>> {
        (0..self.recipes.len())
            .into_par_iter()
            .map(|index: usize| -> Vec<f64> {
                (0..self.layout.wavelengths)
                    .map(|at: usize| {
                        let (k, s) = self.mixed(curves, index, at);
                        self.forward.reflectance(index, at, k, s)
                    })
                    .collect()
            })
            .collect()
    }

    /// Linearises the model at `curves`, with derivatives with respect to log K and log S.
    pub(super) fn linear(&self, curves: &CurveTable) -> Linear {
        let samples = (0..self.recipes.len()).into_par_iter();
        let (values, slopes) = samples.map(|index| self.linear_of_sample(curves, index)).unzip();
        Linear { values, slopes }
    }

    fn linear_of_sample(&self, curves: &CurveTable, index: usize) -> (Vec<f64>, Vec<f64>) {
        let recipe = &self.recipes[index];
        let wavelengths = self.layout.wavelengths;
        let mut values = Vec::with_capacity(wavelengths);
        let mut slopes = Vec::with_capacity(wavelengths * self.places[index].len());
        for at in 0..wavelengths {
            let (k, s) = self.mixed(curves, index, at);
            let [value, over_k, over_s] = self.forward.linearised(index, at, k, s);
            values.push(value);
            slopes.extend(recipe.iter().map(|&(p, c)| over_k * c * curves.absorption[p][at]));
            let scattering = recipe.iter().filter(|&&(p, _)| self.layout.scattering(p).is_some());
            slopes.extend(scattering.map(|&(p, c)| over_s * c * curves.scattering[p][at]));
        }
        (values, slopes)
    }

    fn mixed(&self, curves: &CurveTable, index: usize, at: usize) -> (f64, f64) {
        self.recipes[index].iter().fold((0.0, 0.0), |(k, s), &(pigment, amount)| {
            (
                k + amount * curves.absorption[pigment][at],
                s + amount * curves.scattering[pigment][at],
            )
        })
    }
}

/// Measured colours that a fit should reproduce.
#[derive(Debug, Clone)]
pub(super) struct ColorTerm<'a> {
    weights: &'a TristimulusWeights,
    /// By sample: its measured colour, and the local metric of CIEDE2000 there.
    targets: Vec<(Lab, Matrix3)>,
}

/// Colour residual of one sample, with its derivatives with respect to reflectance.
pub(super) struct ColorResidual {
    /// Three components. Their length is the colour difference.
    pub(super) residual: [f64; 3],
    /// By wavelength: derivatives of the components with respect to reflectance.
    pub(super) slopes: Vec<[f64; 3]>,
}

impl<'a> ColorTerm<'a> {
    pub(super) fn new(weights: &'a TristimulusWeights, target: &[Vec<f64>]) -> Self {
        let targets = target
            .iter()
            .map(|reflectance| {
                let lab = Lab::from_xyz(weights.xyz(reflectance), weights.white());
                (lab, ciede2000_metric(lab))
            })
            .collect();
        Self { weights, targets }
    }

    pub(super) fn difference(&self, index: usize, reflectance: &[f64]) -> f64 {
        let residual = self.components(index, self.weights.xyz(reflectance));
        residual.iter().map(|v| v * v).sum::<f64>().sqrt()
    }

    pub(super) fn linear(&self, index: usize, reflectance: &[f64]) -> ColorResidual {
        let xyz = self.weights.xyz(reflectance);
        let map = self.targets[index].1.after(&Lab::slopes_over_xyz(xyz, self.weights.white()));
        let slopes = self.weights.weights().iter().map(|w| map.apply(*w)).collect();
        ColorResidual { residual: self.components(index, xyz), slopes }
    }

    /// By sample: how far the colour moves, in CIEDE2000, per unit of reflectance at each wavelength.
    pub(super) fn sensitivity(&self, target: &[Vec<f64>]) -> Vec<Vec<f64>> {
        (0..self.targets.len())
            .map(|index| {
                self.linear(index, &target[index])
                    .slopes
                    .iter()
                    .map(|v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt())
                    .collect()
            })
            .collect()
    }

    fn components(&self, index: usize, xyz: Xyz) -> [f64; 3] {
        let (target, metric) = &self.targets[index];
        let lab = Lab::from_xyz(xyz, self.weights.white());
        metric.apply([lab.lightness - target.lightness, lab.a - target.a, lab.b - target.b])
    }
}

/// How well the mixtures determine K and S at the worst wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition {
    /// Number of unknowns per wavelength.
    pub unknowns: usize,
    /// Least rank over all wavelengths.
    pub rank: usize,
    /// Largest condition number among the wavelengths of that rank.
    pub number: f64,
    /// Wavelength of that condition number, in nm.
    pub nm: f64,
}

/// We attribute eigenvalues of the normal matrix below this fraction of the largest to rounding.
const ROUNDING: f64 = 1e-13;

/// Computes rank and condition of the derivatives of measured reflectance with respect to log K and log S.
/// We scale columns to length 1. A singular value below 3e-7 of the largest counts as 0, because rounding
/// of the normal matrix ends there.
#[must_use]
pub fn condition(problem: &Problem, curves: &[Curves]) -> Condition {
    let curves = CurveTable::off_zero(curves, [f64::NEG_INFINITY; 2]);
    let data = Data::hiding(problem);
    let linear = data.linear(&curves);
    let unknowns = data.layout.per_wavelength();
    let mut worst =
        Condition { unknowns, rank: unknowns, number: 0.0, nm: problem.grid.start_nm() };
    for at in 0..data.layout.wavelengths {
        let normal = data.normal(&linear, at);
        let lengths = (0..unknowns).map(|i| normal[(i, i)].sqrt());
        let units: Vec<f64> = lengths.map(|l| if l > 0.0 { l } else { 1.0 }).collect();
        let scaled =
            DMatrix::from_fn(unknowns, unknowns, |i, j| normal[(i, j)] / (units[i] * units[j]));
        let eigenvalues = SymmetricEigen::new(scaled).eigenvalues;
        let largest = eigenvalues.max();
        let rank = eigenvalues.iter().filter(|&&v| v > ROUNDING * largest).count();
        let number = (largest / eigenvalues.min().max(1e-16 * largest)).sqrt();
        if rank < worst.rank || (rank == worst.rank && number > worst.number) {
            (worst.rank, worst.number, worst.nm) = (rank, number, problem.grid.nm(at));
        }
    }
    worst
}

/// Quantity of a pigment that the data do not identify.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Its S. We know only its K/S, from a masstone.
    Scattering,
    /// Both K and S.
    Everything,
}

/// A pigment that the data do not identify.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unidentified {
    /// Index of the pigment in the list of pigments.
    pub pigment: PigmentId,
    /// Quantity that is not identified.
    pub unknown: Unknown,
    /// Indices of the samples that contain the pigment.
    pub samples: Vec<usize>,
}

/// Two recipes count as equal if their shares, summed over pigments, differ by less than this.
const SAME_RECIPE: f64 = 1e-9;

/// Finds the pigments that the mixtures do not identify. You give the `reference`, which has S = 1, and the
/// shares of all pigments by sample.
///
/// We identify a pigment if it occurs in two or more samples of different recipe, and at least one of them
/// is a mixture with an identified pigment. For example, a masstone alone does not identify S.
#[must_use]
pub fn unidentified<'a>(
    shares: impl IntoIterator<Item = &'a [f64]>,
    reference: PigmentId,
) -> Vec<Unidentified> {
    let collected: Vec<&[f64]> = shares.into_iter().collect();
    let shares = collected.as_slice();
    let pigments = shares.first().map_or(0, |shares| shares.len());
    let holding = |pigment: usize| -> Vec<usize> {
        (0..shares.len()).filter(|&s| shares[s][pigment] > 0.0).collect()
    };
    let partners = |sample: usize, pigment: usize| {
        (0..pigments).filter(move |&other| other != pigment && shares[sample][other] > 0.0)
    };
    let mut known = vec![false; pigments];
    known[reference.index()] = true;
    loop {
        let found = (0..pigments).filter(|&p| !known[p]).find(|&pigment| {
            let samples = holding(pigment);
            let differ = samples.iter().any(|&s| {
                let pairs = shares[s].iter().zip(shares[samples[0]]);
                pairs.map(|(a, b)| (a - b).abs()).sum::<f64>() > SAME_RECIPE
            });
            differ && samples.iter().any(|&s| partners(s, pigment).any(|other| known[other]))
        });
        match found {
            Some(pigment) => known[pigment] = true,
            None => break,
        }
    }
    (0..pigments)
        .filter(|&pigment| !known[pigment])
        .map(|pigment| {
            let samples = holding(pigment);
            let masstone = samples.iter().any(|&s| partners(s, pigment).next().is_none());
            let unknown = if masstone { Unknown::Scattering } else { Unknown::Everything };
            Unidentified { pigment: PigmentId(pigment), unknown, samples }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(shares: &[Vec<f64>]) -> Vec<Unidentified> {
        unidentified(shares.iter().map(Vec::as_slice), PigmentId(0))
    }

    #[test]
    fn a_masstone_alone_identifies_only_the_ratio() {
        let shares = vec![vec![1.0, 0.0], vec![0.0, 1.0]];
        let found = found(&shares);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].pigment, found[0].unknown), (PigmentId(1), Unknown::Scattering));
        assert_eq!(found[0].samples, vec![1]);
    }

    #[test]
    fn a_single_mixture_identifies_nothing() {
        let found = found(&[vec![1.0, 0.0], vec![0.5, 0.5]]);
        assert_eq!((found[0].pigment, found[0].unknown), (PigmentId(1), Unknown::Everything));
    }

    #[test]
    fn masstone_and_tint_identify_a_pigment_through_a_chain_to_the_white() {
        let shares = vec![
            vec![1.0, 0.0, 0.0],
            vec![0.0, 1.0, 0.0],
            vec![0.5, 0.5, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![0.0, 0.5, 0.5],
        ];
        assert!(found(&shares).is_empty(), "pigment 2 is mixed with 1, and 1 with the white");
    }

    #[test]
    fn two_pigments_mixed_only_with_each_other_do_not_reach_the_white() {
        let shares = vec![
            vec![1.0, 0.0, 0.0],
            vec![0.0, 1.0, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![0.0, 0.5, 0.5],
        ];
        let found: Vec<usize> = found(&shares).iter().map(|u| u.pigment.index()).collect();
        assert_eq!(found, vec![1, 2]);
    }
}
