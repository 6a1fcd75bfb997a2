//! Films of every pigment and of every pair in thirteen ratios, by which a search begins.

use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

use super::nearest::{DIMENSIONS, Nearest, Point};
use crate::films::film::Films;
use crate::films::noise::{Noise, Scale};
use crate::films::paints::Paints;
use crate::films::whitening::Spectrum;

/// Ratios of a pair, evenly spaced in their logarithm.
const RATIOS: i32 = 13;
/// Greatest logarithm of a ratio, to each side of the middle.
const GREATEST: f64 = 5.0;
/// Greatest shift of the middle towards the weaker pigment, as a logarithm.
const SHIFT: f64 = 2.0;

/// Films by which pixels are linearised and differences whitened.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    /// Internal reflectance and 1/S of each film.
    films: Vec<(Spectrum, Spectrum)>,
    pub(crate) projection: Projection,
    nearest: Nearest,
}

impl Table {
    pub(crate) fn new(paints: &Paints, films: &Films, noise: &Noise) -> Self {
        let recipes = recipes(paints);
        let projection = Projection::new(paints, noise, &recipes);
        let points: Vec<Point> = recipes
            .iter()
            .map(|recipe| {
                let reflectance = paints.reflectance(recipe);
                projection.of(&reflectance.iter().map(|r| *r as f32).collect::<Vec<f32>>())
            })
            .collect();
        Self {
            films: recipes
                .iter()
                .map(|recipe: &Vec<(usize, f64)>| {
                    let shares: Vec<(usize, f32)> =
                        recipe.iter().map(|&(p, share)| (p, share as f32)).collect();
                    films.film(&shares)
                })
                .collect(),
            projection,
            nearest: Nearest::new(&points),
        }
    }

    /// Place of the film that is nearest to a projected pixel.
    pub(crate) fn nearest(&self, point: &Point) -> usize {
        let [(_, place)] = self.nearest.find::<1>(point);
        place as usize
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

/// Slope of the fourth root of reflectance by the logarithm of K/S, about, for films of middle lightness.
const ROOT_SLOPE: f64 = 0.15;

/// Few coordinates of a spectrum in which distances tell films apart: the main axes of all films of the
/// table, in fourth roots of reflectance that are whitened by the library's error.
#[derive(Debug, Clone)]
pub(crate) struct Projection {
    /// Weights by band, each for all coordinates.
    weights: Vec<Point>,
}

impl Projection {
    fn new(paints: &Paints, noise: &Noise, recipes: &[Vec<(usize, f64)>]) -> Self {
        let bands = paints.bands();
        let root = |recipe: &Vec<(usize, f64)>| {
            let reflectance = paints.reflectance(recipe);
            DVector::from_iterator(bands, reflectance.into_iter().map(|r| r.max(0.0).sqrt().sqrt()))
        };
        let roots: Vec<DVector<f64>> = recipes.iter().map(root).collect();
        let scale = match noise.scale {
            Scale::FourthRoot => 1.0,
            Scale::LogRatio => ROOT_SLOPE,
        };
        let covariance = DMatrix::from_fn(bands, bands, |i, j| {
            let common: f64 =
                noise.curves[i].iter().zip(&noise.curves[j]).map(|(a, b)| a * b).sum();
            // The sensor's noise on the fourth root of a reflectance of 0.1.
            let own =
                if i == j { noise.own[i] * scale * scale + 2.0 * noise.sensor[i] } else { 0.0 };
            common * scale * scale + own
        });
        let factor = Cholesky::new(covariance).map(|cholesky| cholesky.l());
        let inverse =
            factor.and_then(|l| l.solve_lower_triangular(&DMatrix::identity(bands, bands)));
        let whitening = inverse.unwrap_or_else(|| DMatrix::identity(bands, bands));
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
            let root = reflectance.max(0.0).sqrt().sqrt();
            for (sum, weight) in point.iter_mut().zip(weights) {
                *sum += weight * root;
            }
        }
        point
    }
}
