//! Films of every pigment and of every pair in thirteen ratios, by which a search begins.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rayon::prelude::*;

use crate::film::{Films, Spectrum, blocked, blocked_length};
use crate::nearest::{DIMENSIONS, Nearest, Point};
use crate::noise::Noise;
use crate::paints::Paints;

/// Ratios of a pair, evenly spaced in their logarithm.
const RATIOS: i32 = 13;
/// Greatest logarithm of a ratio, to each side of the middle.
const GREATEST: f64 = 5.0;
/// Greatest shift of the middle towards the weaker pigment, as a logarithm.
const SHIFT: f64 = 2.0;

/// Films by which pixels are linearised and differences whitened.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    /// Pigments of each film with their shares.
    pub(crate) recipes: Vec<Vec<(usize, f64)>>,
    /// Internal reflectance and 1/S of each film.
    films: Vec<(Spectrum, Spectrum)>,
    whitening: Vec<f32>,
    length: usize,
    pub(crate) projection: Projection,
    nearest: Nearest,
}

impl Table {
    pub(crate) fn new(paints: &Paints, films: &Films, noise: &Noise) -> Self {
        let recipes = recipes(paints);
        let length = blocked_length(films.rows);
        let whitening: Vec<Vec<f32>> =
            recipes.par_iter().map(|recipe| blocked(&noise.whitening(paints, recipe))).collect();
        let projection = Projection::new(paints, noise, &recipes);
        let points: Vec<Point> = recipes
            .iter()
            .map(|recipe| {
                let reflectance = paints.reflectance(recipe);
                projection.of(&reflectance.iter().map(|r| *r as f32).collect::<Vec<f32>>())
            })
            .collect();
        let film = |recipe: &Vec<(usize, f64)>| {
            let shares: Vec<(usize, f32)> = recipe.iter().map(|&(p, share)| (p, share as f32)).collect();
            films.film(&shares)
        };
        Self {
            films: recipes.iter().map(film).collect(),
            whitening: whitening.concat(),
            length,
            projection,
            nearest: Nearest::new(&points),
            recipes,
        }
    }

    /// Place of the film that is nearest to a projected pixel.
    pub(crate) fn nearest(&self, point: &Point) -> usize {
        let [(_, place)] = self.nearest.find::<1>(point);
        place as usize
    }

    /// Whitening matrix near a film.
    pub(crate) fn whitening(&self, place: usize) -> &[f32] {
        &self.whitening[place * self.length..(place + 1) * self.length]
    }

    /// Internal reflectance and 1/S of a film.
    pub(crate) fn film(&self, place: usize) -> (&Spectrum, &Spectrum) {
        let (internal, inverse) = &self.films[place];
        (internal, inverse)
    }
}

fn recipes(paints: &Paints) -> Vec<Vec<(usize, f64)>> {
    let count = paints.count();
    let mut recipes: Vec<Vec<(usize, f64)>> = (0..count).map(|p| vec![(p, 1.0)]).collect();
    for a in 0..count {
        for b in a + 1..count {
            let shift = 0.5 * (paints.strength(b) / paints.strength(a)).ln();
            for step in 0..RATIOS {
                let place = 2.0 * f64::from(step) / f64::from(RATIOS - 1) - 1.0;
                let ratio = (GREATEST * place + shift.clamp(-SHIFT, SHIFT)).exp();
                recipes.push(vec![(a, ratio / (1.0 + ratio)), (b, 1.0 / (1.0 + ratio))]);
            }
        }
    }
    recipes
}

/// Few coordinates of a spectrum in which distances tell films apart: the main axes of all films of the
/// table, in square roots of reflectance whitened by their mean covariance.
#[derive(Debug, Clone)]
pub(crate) struct Projection {
    /// Weights by band, each for all coordinates.
    weights: Vec<Point>,
}

impl Projection {
    fn new(paints: &Paints, noise: &Noise, recipes: &[Vec<(usize, f64)>]) -> Self {
        let bands = paints.bands();
        let root = |recipe: &Vec<(usize, f64)>| {
            DVector::from_iterator(bands, paints.reflectance(recipe).into_iter().map(|r| r.max(0.0).sqrt()))
        };
        let roots: Vec<DVector<f64>> = recipes.iter().map(root).collect();
        let mut covariance = DMatrix::zeros(bands, bands);
        for (recipe, root) in recipes.iter().zip(&roots).take(paints.count()) {
            let own = noise.covariance(paints, recipe);
            covariance += DMatrix::from_fn(bands, bands, |i, j| {
                own[(i, j)] / (4.0 * root[i].max(0.05) * root[j].max(0.05))
            });
        }
        let whitening = crate::noise::inverse_factor(covariance / paints.count() as f64);
        let white: Vec<DVector<f64>> = roots.iter().map(|root| &whitening * root).collect();
        let mean = white.iter().sum::<DVector<f64>>() / white.len() as f64;
        let mut spread = DMatrix::zeros(bands, bands);
        for point in &white {
            let offset = point - &mean;
            spread += &offset * offset.transpose();
        }
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(spread);
        let mut order: Vec<usize> = (0..bands).collect();
        order.sort_by(|&a, &b| eigenvalues[b].total_cmp(&eigenvalues[a]));
        let mut weights = vec![[0.0; DIMENSIONS]; bands];
        for (coordinate, &axis) in order.iter().take(DIMENSIONS).enumerate() {
            let row = eigenvectors.column(axis).transpose() * &whitening;
            for (band, weights) in weights.iter_mut().enumerate() {
                weights[coordinate] = row[band] as f32;
            }
        }
        Self { weights }
    }

    /// Coordinates of a reflectance on the bands.
    pub(crate) fn of(&self, reflectance: &[f32]) -> Point {
        let mut point = [0.0; DIMENSIONS];
        for (weights, &reflectance) in self.weights.iter().zip(reflectance) {
            let root = reflectance.max(0.0).sqrt();
            for (sum, weight) in point.iter_mut().zip(weights) {
                *sum += weight * root;
            }
        }
        point
    }
}
