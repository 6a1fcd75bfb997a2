//! Effective K and S, fitted together with the weights to films of a library.

use std::ops::Range;

use nalgebra::DVector;
use rayon::prelude::*;
use spectra::Cancellation;
use spectra::color::{Lab, Matrix3, Xyz, ciede2000_metric};
use spectra::optics::{Layer, infinite_film_from_ratio, infinite_film_slope};

use super::effective::EffectiveQuadrature;
use super::films::{Film, FilmSet};
use super::rule::{Quadrature, QuadratureFailure};
use crate::evaluate::Viewing;
use crate::least_squares::{NormalEquations, SparseRows, Stop, minimise};
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// Films of the training set for each pigment, and at least.
const FILMS_A_PIGMENT: usize = 120;
const LEAST_FILMS: usize = 2000;
/// Seed of the training set.
const SEED: u64 = 2004;
/// Stopping rule of the fit.
const STOP: Stop<'static> = Stop { iterations: 100, relative_decrease: 1e-5, cancellation: None };
/// Greatest size of every weight, as of the fitted rule.
const LARGEST_WEIGHT: f64 = 1e3;
/// Greatest change of the logarithm of K or S.
const LARGEST_CHANGE: f64 = 6.0;
/// Weight of the squared change of each logarithm, which keeps K and S that no film shows at the
/// values of the library.
const PRIOR: f64 = 1e-3;
/// Least K or S that can change, relative to the sum of both at the wavelength.
const LEAST: f64 = 1e-5;
/// Films that one task adds up; fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 128;

impl EffectiveQuadrature {
    /// Fits weights, and K and S of every pigment, at the wavelengths of [`Quadrature::library`], so that
    /// films of `library` keep their colours: least squares in CIEDE2000 over films that hide, tints,
    /// and thin films over black and white.
    ///
    /// # Errors
    /// [`QuadratureFailure::Count`] for 0 nodes, or more than 32.
    pub fn of(
        viewing: &Viewing,
        library: &PigmentLibrary,
        count: usize,
    ) -> Result<Self, QuadratureFailure> {
        Self::of_until(viewing, library, count, &Cancellation::default())
    }

    /// Fits like [`Self::of`], until `cancellation` ends it: many wavelengths of many pigments take minutes.
    ///
    /// # Errors
    /// [`QuadratureFailure`] for 0 nodes, or more than 32, or if the fit was cancelled.
    pub fn of_until(
        viewing: &Viewing,
        library: &PigmentLibrary,
        count: usize,
        cancellation: &Cancellation,
    ) -> Result<Self, QuadratureFailure> {
        let start = Quadrature::library(viewing, library, count)?;
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let films = LEAST_FILMS.max(FILMS_A_PIGMENT * library.pigments.len());
        let films = FilmSet::for_fitting(library, &weights, films, SEED);
        let found = Problem::new(start, library, &films).solve(cancellation);
        cancellation.check()?;
        Ok(found)
    }
}

/// Places of the unknowns: three weights for each wavelength but the last, whose weights follow from
/// the white; then the changes of log K and log S by pigment and wavelength.
struct Problem<'a> {
    start: EffectiveQuadrature,
    films: &'a FilmSet,
    /// Target and metric of each film.
    targets: Vec<(Lab, Matrix3)>,
    /// Ground of each film at the wavelengths; empty for a film that hides.
    grounds: Vec<Vec<f64>>,
}

impl<'a> Problem<'a> {
    fn new(rule: Quadrature, library: &PigmentLibrary, films: &'a FilmSet) -> Self {
        let target = |film: &Film| {
            let lab = Lab::from_xyz(film.xyz, films.white);
            (lab, ciede2000_metric(lab))
        };
        let ground = |film: &Film| match &film.over {
            Some((_, ground)) => rule.at_nodes(library.grid, ground),
            None => Vec::new(),
        };
        let (targets, grounds) =
            films.films.iter().map(|film| (target(film), ground(film))).unzip();
        let mut start = EffectiveQuadrature::interpolated(rule, library);
        for (absorption, scattering) in start.absorption.iter_mut().zip(&mut start.scattering) {
            for (k, s) in absorption.iter_mut().zip(scattering) {
                let least = LEAST * (*k + *s);
                (*k, *s) = (k.max(least), s.max(least));
            }
        }
        Self { start, films, targets, grounds }
    }

    fn nodes(&self) -> usize {
        self.start.rule.nodes_nm.len()
    }

    /// Place of the change of log K of a pigment at a wavelength; that of log S follows it.
    fn place(&self, pigment: usize, node: usize) -> usize {
        3 * (self.nodes() - 1) + 2 * (pigment * self.nodes() + node)
    }

    /// The fit, or where it stands once it was cancelled.
    fn solve(&self, cancellation: &Cancellation) -> EffectiveQuadrature {
        let n = self.nodes();
        let free = 3 * (n - 1);
        let count = self.place(self.start.absorption.len(), 0);
        let mut point = DVector::zeros(count);
        for (i, weights) in self.start.rule.weights[..n - 1].iter().enumerate() {
            point.rows_mut(3 * i, 3).copy_from_slice(weights);
        }
        let bound = |size: f64| {
            let mut bounds = DVector::from_element(count, size * LARGEST_CHANGE);
            bounds.rows_mut(0, free).fill(size * LARGEST_WEIGHT);
            bounds
        };
        let minimum = minimise(
            point,
            (&bound(-1.0), &bound(1.0)),
            Stop { cancellation: Some(cancellation), ..STOP },
            |point| self.equations(point),
            |point| self.cost(point),
        );
        self.at(&minimum.point)
    }

    /// The quadrature at a point of the search.
    fn at(&self, point: &DVector<f64>) -> EffectiveQuadrature {
        let n = self.nodes();
        let mut found = self.start.clone();
        let mut last = found.rule.white.to_array();
        for (i, weights) in found.rule.weights[..n - 1].iter_mut().enumerate() {
            for (channel, weight) in weights.iter_mut().enumerate() {
                *weight = point[3 * i + channel];
                last[channel] -= *weight;
            }
        }
        found.rule.weights[n - 1] = last;
        let changed = found.absorption.iter_mut().zip(&mut found.scattering).enumerate();
        for (pigment, (absorption, scattering)) in changed {
            for node in 0..n {
                let place = self.place(pigment, node);
                absorption[node] *= point[place].exp();
                scattering[node] *= point[place + 1].exp();
            }
        }
        found
    }

    /// Measured reflectance of a film at a wavelength, and its derivatives by K and S of the mixture.
    fn reflectance(&self, index: usize, node: usize, k: f64, s: f64) -> [f64; 3] {
        let [internal, over_k, over_s] = match &self.films.films[index].over {
            None => {
                let internal = infinite_film_from_ratio(k / s);
                let slope = infinite_film_slope(internal) / s;
                [internal, slope, -slope * k / s]
            }
            Some((thickness, _)) => {
                let below = self.grounds[index][node];
                let [internal, over_k, over_s] =
                    Layer::over_with_slopes(thickness * k, thickness * s, below);
                [internal, thickness * over_k, thickness * over_s]
            }
        };
        let surface = self.films.surface;
        let slope = surface.measured_slope(internal);
        [surface.measured_from_internal(internal), slope * over_k, slope * over_s]
    }

    /// Residual of a film and its derivatives by XYZ.
    fn residual(&self, index: usize, xyz: Xyz) -> ([f64; 3], Matrix3) {
        let white = self.films.white;
        let (target, metric) = &self.targets[index];
        let lab = Lab::from_xyz(xyz, white);
        let difference = [lab.lightness - target.lightness, lab.a - target.a, lab.b - target.b];
        (metric.apply(difference), metric.after(&Lab::slopes_over_xyz(xyz, white)))
    }

    fn add_film(&self, index: usize, found: &EffectiveQuadrature, rows: &mut SparseRows) {
        let n = self.nodes();
        let parts = &self.films.films[index].parts;
        let [absorption, scattering] = found.mixed(parts);
        let at_nodes: Vec<[f64; 3]> =
            (0..n).map(|i| self.reflectance(index, i, absorption[i], scattering[i])).collect();
        let (residual, slopes) = self.residual(index, sum(&at_nodes, &found.rule.weights));
        let mut sorted = parts.clone();
        sorted.sort_by_key(|(pigment, _)| *pigment);
        let of_pigment = |(pigment, _): &(PigmentId, f64)| {
            let first = self.place(pigment.index(), 0);
            first..first + 2 * n
        };
        let runs: Vec<Range<usize>> =
            std::iter::once(0..3 * (n - 1)).chain(sorted.iter().map(of_pigment)).collect();
        let slopes = slopes.0;
        let mut derivatives = Vec::with_capacity(runs.iter().map(|run| run.len()).sum());
        for [value, ..] in &at_nodes[..n - 1] {
            let more = value - at_nodes[n - 1][0];
            derivatives.extend((0..3).map(|channel| slopes.map(|slope| slope[channel] * more)));
        }
        for (pigment, part) in &sorted {
            let (absorption, scattering) =
                (&found.absorption[pigment.index()], &found.scattering[pigment.index()]);
            for (node, [_, over_k, over_s]) in at_nodes.iter().enumerate() {
                let weights = found.rule.weights[node];
                let along = slopes.map(|slope| slope.iter().zip(weights).map(|(s, w)| s * w).sum());
                derivatives.push(along.map(|along: f64| along * over_k * part * absorption[node]));
                derivatives.push(along.map(|along: f64| along * over_s * part * scattering[node]));
            }
        }
        rows.push(residual, &runs, &derivatives);
    }

    fn equations(&self, point: &DVector<f64>) -> NormalEquations {
        let found = self.at(point);
        let indices: Vec<usize> = (0..self.films.len()).collect();
        let mut parts: Vec<SparseRows> = indices
            .par_chunks(CHUNK)
            .map(|chunk| {
                let mut rows = SparseRows::default();
                chunk.iter().for_each(|&index| self.add_film(index, &found, &mut rows));
                rows
            })
            .collect();
        let mut prior = SparseRows::default();
        for place in 3 * (self.nodes() - 1)..point.len() {
            let weight = PRIOR.sqrt();
            prior.push(
                [weight * point[place], 0.0, 0.0],
                std::slice::from_ref(&(place..place + 1)),
                &[[weight, 0.0, 0.0]],
            );
        }
        parts.push(prior);
        NormalEquations::of_rows(point.len(), &parts)
    }

    fn cost(&self, point: &DVector<f64>) -> f64 {
        let found = self.at(point);
        let indices: Vec<usize> = (0..self.films.len()).collect();
        let costs: Vec<f64> = indices
            .par_chunks(CHUNK)
            .map(|chunk| chunk.iter().map(|&index| self.film_cost(index, &found)).sum())
            .collect();
        let changes = point.rows_range(3 * (self.nodes() - 1)..);
        costs.iter().sum::<f64>() + 0.5 * PRIOR * changes.norm_squared()
    }

    fn film_cost(&self, index: usize, found: &EffectiveQuadrature) -> f64 {
        let [absorption, scattering] = found.mixed(&self.films.films[index].parts);
        let at_nodes: Vec<[f64; 3]> = (0..self.nodes())
            .map(|i| self.reflectance(index, i, absorption[i], scattering[i]))
            .collect();
        let (residual, _) = self.residual(index, sum(&at_nodes, &found.rule.weights));
        0.5 * residual.iter().map(|r| r * r).sum::<f64>()
    }
}

fn sum(at_nodes: &[[f64; 3]], weights: &[[f64; 3]]) -> Xyz {
    let mut xyz = [0.0; 3];
    for ([value, ..], weights) in at_nodes.iter().zip(weights) {
        for (total, weight) in xyz.iter_mut().zip(weights) {
            *total += value * weight;
        }
    }
    xyz.into()
}
