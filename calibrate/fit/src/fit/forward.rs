//! The two optical models that predict films in a fit: films that hide, and films over a known backing.

use nalgebra::DMatrix;
use rayon::prelude::*;
use spectra::optics::{Surface, UnevenFilm, infinite_film, infinite_film_slope};

use super::curves::{CurveTable, Layout};
use super::problem::Problem;

/// Model of the measured reflectance of a film, from K and S of its mixture.
pub(super) trait Forward: Sync {
    /// Reflectance of sample `index` at wavelength `at`.
    fn reflectance(&self, index: usize, at: usize, k: f64, s: f64) -> f64;

    /// Reflectance with its derivatives over K and over S.
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

/// Model of films of unit thickness over known backings. The thickness is contained in the amounts.
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
    /// Standard deviation of repeated readings in measured reflectance; 0 if unknown.
    pub(super) reading_sd: f64,
    /// Places of each sample's unknowns within a wavelength.
    places: Vec<Vec<usize>>,
}

/// A model linearised at a point: values, and slopes over the unknowns.
pub(super) struct Linear {
    /// Predicted reflectance by sample and wavelength.
    pub(super) values: Vec<Vec<f64>>,
    /// By sample: for each wavelength in turn, one slope for each of the sample's places.
    pub(super) slopes: Vec<Vec<f64>>,
}

impl<'a> Data<'a, Hiding> {
    /// The mixtures of a problem, modelled as films that hide.
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

    /// Normal matrix of the slopes at one wavelength, all samples having equal weight.
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

    /// Places of the unknowns of sample `index` within a wavelength.
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

    /// Linearises the model at `curves`, with slopes over log K and log S.
    pub(super) fn linear(&self, curves: &CurveTable) -> Linear {
        let samples = (0..self.recipes.len()).into_par_iter();
        let (values, slopes) = samples.map(|index| self.linear_of_sample(curves, index)).unzip();
        Linear { values, slopes }
    }

    /// Values and slopes of one sample.
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
