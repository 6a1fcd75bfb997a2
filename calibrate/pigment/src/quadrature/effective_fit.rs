//! Fits effective K and S together with the weights and the wavelengths. We fit them to films of a library,
//! by least squares.

use std::ops::Range;

use documents::Task;
use nalgebra::DVector;
use rayon::prelude::*;
use spectra::Grid;
use spectra::color::{Lab, Matrix3, Xyz, ciede2000_metric};
use spectra::optics::{Layer, infinite_film_from_ratio, infinite_film_slope};

use super::effective::{EffectiveQuadrature, Film, FilmSet};
use super::rule::{NODE_BAND_NM, Quadrature, QuadratureFailure, on_line};
use crate::evaluate::Viewing;
use crate::least_squares::{NormalEquations, SparseRows, Stop, minimise};
use crate::library::PigmentLibrary;

/// The training set has this many films for each pigment, and at least `LEAST_FILMS` in all.
const FILMS_A_PIGMENT: usize = 120;
const LEAST_FILMS: usize = 2000;
/// We draw this many further films for each pigment, and at least `LEAST_CANDIDATES` in all. The ones with
/// the largest errors after the first fit join the training.
const CANDIDATES_A_PIGMENT: usize = 400;
const LEAST_CANDIDATES: usize = 8000;
/// This share of the further films joins the training. Any share from 1.5 to 3 % does as well.
const WORST: f64 = 0.02;
const SEED: u64 = 2004;
/// Stopping rules of the two fits. Further steps would gain less than a better choice of the films.
const FIRST_STOP: Stop = Stop { iterations: 100, relative_decrease: 1e-3 };
const SECOND_STOP: Stop = Stop { iterations: 20, ..FIRST_STOP };

impl EffectiveQuadrature {
    /// Fits wavelengths, weights, and K and S of every pigment, so that films of `library` keep their
    /// colours. This is least squares in CIEDE2000 over films that hide, tints, and thin films over black
    /// and white.
    ///
    /// We fit twice. The first fit keeps the wavelengths of [`Quadrature::library`]. The second begins
    /// where it ends, moves the wavelengths too, and adds the worst of many further films, which we judge
    /// by their colour error after the first fit. Few films show the edge of a pigment's absorption next to
    /// a line of a lamp, and a small random set misses them.
    ///
    /// Many wavelengths of many pigments take minutes. You can end the fit before with `task`.
    ///
    /// # Errors
    /// [`QuadratureFailure`] for 0 nodes, or more than 32, or if `task` was cancelled.
    pub fn of(
        viewing: &Viewing,
        library: &PigmentLibrary,
        count: usize,
        task: &Task,
    ) -> Result<Self, QuadratureFailure> {
        let start = Quadrature::library(viewing, library, count)?;
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let pigments = library.pigments.len();

        let films = LEAST_FILMS.max(FILMS_A_PIGMENT * pigments);
        let films = FilmSet::for_fitting(library, &weights, films, SEED);
        let mut problem = Problem::new(start, library, films);
        let first = problem.solve(problem.first_point(), Nodes::Fixed, FIRST_STOP, task);
        task.check()?;

        let count = LEAST_CANDIDATES.max(CANDIDATES_A_PIGMENT * pigments);
        let candidates = FilmSet::candidates(library, &weights, count, SEED);
        let errors = problem.at(&first).errors(library, &candidates);
        problem.add_worst(candidates, &errors, (WORST * count as f64) as usize);
        let second = problem.solve(first, Nodes::Free, SECOND_STOP, task);
        task.check()?;
        Ok(problem.at(&second))
    }
}

/// Greatest absolute value of a weight. `fitted.rs` has the same limit.
const LARGEST_WEIGHT: f64 = 1e3;
/// Greatest change of the logarithm of K or S.
const LARGEST_CHANGE: f64 = 6.0;
/// Weight of the squared change of each logarithm. If no film shows a K or S, this keeps it at the value of
/// the library.
const PRIOR: f64 = 1e-3;
/// Least K or S that can change, relative to the sum of both at the wavelength.
const LEAST: f64 = 1e-5;
/// One task adds up this many films. The number is fixed, so that sums do not depend on the number of
/// threads.
const CHUNK: usize = 128;

/// Whether the wavelengths may move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Nodes {
    /// They stay where the rule has them.
    Fixed,
    /// Each moves at most to the middle between it and its neighbour, so that their order stays.
    Free,
}

/// Films that a quadrature should give the right colours. The unknowns are, in this order, three weights
/// for each wavelength but the last (we get its weights from the white), the wavelengths, and the changes
/// of log K and log S by pigment and wavelength.
#[derive(Debug)]
pub(super) struct Problem {
    start: EffectiveQuadrature,
    grid: Grid,
    films: FilmSet,
    /// Target and metric of each film.
    targets: Vec<(Lab, Matrix3)>,
}

impl Problem {
    pub(super) fn new(rule: Quadrature, library: &PigmentLibrary, films: FilmSet) -> Self {
        let mut start = EffectiveQuadrature::interpolated(rule, library);
        for (absorption, scattering) in start.absorption.iter_mut().zip(&mut start.scattering) {
            for (k, s) in absorption.iter_mut().zip(scattering) {
                let least = LEAST * (*k + *s);
                (*k, *s) = (k.max(least), s.max(least));
            }
        }
        let targets = films.films.iter().map(|film| target(film, films.white)).collect();
        Self { start, grid: library.grid, films, targets }
    }

    /// Adds the `count` films of `candidates` with the largest errors.
    pub(super) fn add_worst(&mut self, candidates: FilmSet, errors: &[f64], count: usize) {
        let mut worst: Vec<(Film, f64)> =
            candidates.films.into_iter().zip(errors.iter().copied()).collect();
        // We use a stable sort. Of films with the same error, we take the one drawn first.
        worst.sort_by(|a, b| b.1.total_cmp(&a.1));
        worst.truncate(count);
        for (film, _) in worst {
            self.targets.push(target(&film, self.films.white));
            self.films.films.push(film);
        }
    }

    fn nodes(&self) -> usize {
        self.start.rule.nodes_nm.len()
    }

    /// Index of the change of log K of a pigment at a wavelength. The change of log S follows it.
    fn place(&self, pigment: usize, node: usize) -> usize {
        self.shared() + 2 * (pigment * self.nodes() + node)
    }

    /// Number of unknowns that all films share: the weights and the wavelengths.
    fn shared(&self) -> usize {
        4 * self.nodes() - 3
    }

    pub(super) fn first_point(&self) -> DVector<f64> {
        let n = self.nodes();
        let rule = &self.start.rule;
        let mut point = DVector::zeros(self.place(self.start.absorption.len(), 0));
        for (i, weights) in rule.weights[..n - 1].iter().enumerate() {
            point.rows_mut(3 * i, 3).copy_from_slice(weights);
        }
        point.rows_mut(3 * (n - 1), n).copy_from_slice(&rule.nodes_nm);
        point
    }

    /// Fits from `point`. If you cancel it, you get the point that it has reached.
    pub(super) fn solve(
        &self,
        point: DVector<f64>,
        nodes: Nodes,
        stop: Stop,
        task: &Task,
    ) -> DVector<f64> {
        let (lower, upper) = self.bounds(nodes);
        minimise(
            point,
            (&lower, &upper),
            stop,
            task,
            |point: &_| self.equations(point),
            |point: &_| self.cost(point),
        )
        .point
    }

    fn bounds(&self, nodes: Nodes) -> (DVector<f64>, DVector<f64>) {
        let n = self.nodes();
        let count = self.place(self.start.absorption.len(), 0);
        let mut upper = DVector::from_element(count, LARGEST_CHANGE);
        upper.rows_mut(0, 3 * (n - 1)).fill(LARGEST_WEIGHT);
        let mut lower = -&upper;
        let nm = &self.start.rule.nodes_nm;
        let between: Vec<f64> = nm.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).collect();
        for (i, &here) in nm.iter().enumerate() {
            let [low, high] = match nodes {
                Nodes::Fixed => [here, here],
                Nodes::Free => [
                    if i == 0 { NODE_BAND_NM[0].min(here) } else { between[i - 1] },
                    if i + 1 == n { NODE_BAND_NM[1].max(here) } else { between[i] },
                ],
            };
            (lower[3 * (n - 1) + i], upper[3 * (n - 1) + i]) = (low, high);
        }
        (lower, upper)
    }

    pub(super) fn at(&self, point: &DVector<f64>) -> EffectiveQuadrature {
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
        found.rule.nodes_nm.copy_from_slice(point.rows(3 * (n - 1), n).as_slice());
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

    /// Measured reflectance of a film at a wavelength, and its derivatives with respect to K and S of the
    /// mixture and to the wavelength, on which the ground depends.
    fn reflectance(&self, film: &Film, nm: f64, k: f64, s: f64) -> [f64; 4] {
        let [internal, over_k, over_s, over_nm] = match &film.over {
            None => {
                let internal = infinite_film_from_ratio(k / s);
                let slope = infinite_film_slope(internal) / s;
                [internal, slope, -slope * k / s, 0.0]
            }
            Some((thickness, ground)) => {
                let (below, rise) = on_line(self.grid, ground, nm);
                let [internal, over_k, over_s] =
                    Layer::over_with_slopes(thickness * k, thickness * s, below);
                let over_nm = rise * Layer::new(k, s, *thickness).over_slope(below);
                [internal, thickness * over_k, thickness * over_s, over_nm]
            }
        };
        let surface = self.films.surface;
        let slope = surface.measured_slope(internal);
        [surface.measured_from_internal(internal), slope * over_k, slope * over_s, slope * over_nm]
    }

    /// [`Self::reflectance`] of a film at each wavelength of the quadrature.
    fn at_nodes(&self, index: usize, found: &EffectiveQuadrature) -> Vec<[f64; 4]> {
        let film = &self.films.films[index];
        let [absorption, scattering] = found.mixed(&film.parts);
        let nodes = found.rule.nodes_nm.iter().zip(absorption.into_iter().zip(scattering));
        nodes.map(|(&nm, (k, s))| self.reflectance(film, nm, k, s)).collect()
    }

    /// Residual of a film and its derivatives with respect to XYZ.
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
        let at_nodes = self.at_nodes(index, found);
        let (residual, slopes) = self.residual(index, sum(&at_nodes, &found.rule.weights));
        let mut sorted = parts.clone();
        sorted.sort_by_key(|(pigment, _)| *pigment);
        let runs: Vec<Range<usize>> = std::iter::once(0..self.shared())
            .chain(sorted.iter().map(|(pigment, _)| {
                let first = self.place(pigment.index(), 0);
                first..first + 2 * n
            }))
            .collect();
        let slopes = slopes.0;
        let mut derivatives = Vec::with_capacity(runs.iter().map(|run| run.len()).sum());
        for [value, ..] in &at_nodes[..n - 1] {
            let more = value - at_nodes[n - 1][0];
            derivatives.extend((0..3).map(|channel| slopes.map(|slope| slope[channel] * more)));
        }
        let along: Vec<[f64; 3]> = found.rule.weights[..n]
            .iter()
            .map(|weights| {
                slopes.map(|slope| slope.iter().zip(weights).map(|(s, w)| s * w).sum::<f64>())
            })
            .collect();
        for ([.., over_nm], along) in at_nodes.iter().zip(&along) {
            derivatives.push(along.map(|along| along * over_nm));
        }
        for (pigment, part) in &sorted {
            let absorption = &found.absorption[pigment.index()];
            let scattering = &found.scattering[pigment.index()];
            for (node, ([_, over_k, over_s, _], along)) in at_nodes.iter().zip(&along).enumerate() {
                derivatives.push(along.map(|along| along * over_k * part * absorption[node]));
                derivatives.push(along.map(|along| along * over_s * part * scattering[node]));
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
        for place in self.shared()..point.len() {
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
        let changes = point.rows_range(self.shared()..);
        costs.iter().sum::<f64>() + 0.5 * PRIOR * changes.norm_squared()
    }

    fn film_cost(&self, index: usize, found: &EffectiveQuadrature) -> f64 {
        let xyz = sum(&self.at_nodes(index, found), &found.rule.weights);
        let (residual, _) = self.residual(index, xyz);
        0.5 * residual.iter().map(|r| r * r).sum::<f64>()
    }
}

fn target(film: &Film, white: Xyz) -> (Lab, Matrix3) {
    let lab = Lab::from_xyz(film.xyz, white);
    (lab, ciede2000_metric(lab))
}

fn sum(at_nodes: &[[f64; 4]], weights: &[[f64; 3]]) -> Xyz {
    let mut xyz = [0.0; 3];
    for ([value, ..], weights) in at_nodes.iter().zip(weights) {
        for (total, weight) in xyz.iter_mut().zip(weights) {
            *total += value * weight;
        }
    }
    xyz.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::Viewing;
    use spectra::{Illuminant, Observer};

    #[test]
    fn the_gradient_is_the_limit_of_difference_quotients() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments.truncate(3);
        library.reference = None;
        let illuminant = Illuminant::named("A").unwrap();
        let viewing = Viewing { illuminant, observer: Observer::Cie1931Deg2 };
        let weights = viewing.weights(library.grid).unwrap();
        let films = FilmSet::for_fitting(&library, &weights, 40, 1);
        let rule = Quadrature::moments(&viewing, 4).unwrap();
        let problem = Problem::new(rule, &library, films);
        let mut point = problem.first_point();
        for place in problem.shared()..point.len() {
            point[place] = 0.2 * (place as f64).sin();
        }
        let gradient = problem.equations(&point).gradient;
        assert_eq!(gradient.len(), 13 + 24);
        for place in 0..point.len() {
            let step = 1e-5 * point[place].abs().max(1.0);
            let [above, below] = [step, -step].map(|step| {
                let mut moved = point.clone();
                moved[place] += step;
                problem.cost(&moved)
            });
            let quotient = (above - below) / (2.0 * step);
            let tolerance = 1e-4 * quotient.abs().max(1.0);
            let found = gradient[place];
            assert!((found - quotient).abs() < tolerance, "{place}: {found} for {quotient}");
        }
    }

    #[test]
    fn wavelengths_that_are_free_keep_their_order_and_fixed_ones_their_place() {
        let library = PigmentLibrary::van_gogh_oils();
        let viewing = Viewing::default();
        let weights = viewing.weights(library.grid).unwrap();
        let films = FilmSet::for_fitting(&library, &weights, 1, 1);
        let rule = Quadrature::moments(&viewing, 5).unwrap();
        let nm = rule.nodes_nm.clone();
        let problem = Problem::new(rule, &library, films);
        let (lower, upper) = problem.bounds(Nodes::Fixed);
        assert_eq!(lower.rows(12, 5), upper.rows(12, 5));
        assert_eq!(lower.rows(12, 5).as_slice(), nm);
        let (lower, upper) = problem.bounds(Nodes::Free);
        assert_eq!((lower[12], upper[16]), (360.0, 830.0));
        for i in 0..4 {
            let middle = f64::midpoint(nm[i], nm[i + 1]);
            assert_eq!((upper[12 + i], lower[13 + i]), (middle, middle));
        }
    }

    #[test]
    fn the_worst_of_the_candidates_are_added() {
        let library = PigmentLibrary::van_gogh_oils();
        let viewing = Viewing::default();
        let weights = viewing.weights(library.grid).unwrap();
        let rule = Quadrature::moments(&viewing, 5).unwrap();
        let films = FilmSet::for_fitting(&library, &weights, 10, 1);
        let candidates = FilmSet::candidates(&library, &weights, 5, 1);
        let mut problem = Problem::new(rule, &library, films.clone());
        problem.add_worst(candidates.clone(), &[0.1, 0.7, 0.2, 0.7, 0.3], 3);
        let added = &problem.films.films[films.len()..];
        let wanted = [1, 3, 4].map(|number| candidates.films[number].clone());
        assert_eq!(added, wanted);
        assert_eq!(problem.targets.len(), problem.films.len());
        assert_eq!(problem.targets.last().unwrap().0, Lab::from_xyz(wanted[2].xyz, films.white));
    }
}
