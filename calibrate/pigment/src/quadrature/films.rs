//! Films of a library's pigments that hide their ground or lie over one, with their exact colours.

use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1};
use rayon::prelude::*;
use spectra::TristimulusWeights;
use spectra::color::Xyz;
use spectra::optics::{Layer, Surface};

use crate::curves::Curves;
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// Optical thicknesses (K + S) d of films over a ground, as the mean over wavelengths: from a
/// stain to a film that hides. Chosen by eye.
const THICKNESSES: [f64; 2] = [0.03, 10.0];

/// Least share of the weaker pigment of a tint. Chosen by eye.
const LEAST_TINT: f64 = 0.003;

/// Internal reflectances of the even grounds that films are fitted over: black and white paper.
const EVEN_GROUNDS: [f64; 2] = [0.0, 0.85];

/// Pigments with their shares, which sum to 1, or with their amounts.
type Parts = Vec<(PigmentId, f64)>;

/// Thickness of a film, and the internal reflectance of its ground on the library's grid.
type Over = (f64, Vec<f64>);

/// A film of several pigments.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Film {
    pub(super) parts: Parts,
    /// `None` for a film that hides its ground.
    pub(super) over: Option<Over>,
    /// Colour by full integration over the library's grid.
    pub(super) xyz: Xyz,
}

/// Films of one library under one light.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmSet {
    pub(super) surface: Surface,
    pub(super) white: Xyz,
    pub(super) films: Vec<Film>,
}

/// Draws of films.
struct Draw<'a> {
    library: &'a PigmentLibrary,
    random: ChaCha8Rng,
}

impl FilmSet {
    /// Draws `count` films that hide their ground, of one to four pigments. Each number of pigments is
    /// equally likely, the pigments are drawn uniformly, and the shares are uniform over all that sum to
    /// 1. The same seed gives the same films.
    #[must_use]
    pub fn hiding(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
    ) -> Self {
        let mut draw = Draw::new(library, seed, 2);
        let films = (0..count).map(|_| draw.film(false)).collect();
        Self::of(library, weights, films)
    }

    /// Draws `count` films like those of [`FilmSet::hiding`], of optical thicknesses (K + S) d from 0.03
    /// to 10, each over the colour of another such mixture, in half of them lightened.
    #[must_use]
    pub fn over_grounds(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
    ) -> Self {
        let mut draw = Draw::new(library, seed, 3);
        let films = (0..count).map(|_| draw.film(true)).collect();
        Self::of(library, weights, films)
    }

    /// Films for fitting, from other random streams than the films of the public draws: every
    /// pigment alone, mixtures, tints, and films over black and white.
    pub(super) fn for_fitting(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
    ) -> Self {
        let mut draw = Draw::new(library, seed, 4);
        let mut films = Vec::new();
        for id in library.ids() {
            films.push((vec![(id, 1.0)], None));
        }
        for number in 0..count {
            let parts = if number % 2 == 0 { draw.shares() } else { draw.tint() };
            let over = match number % 4 {
                0 | 1 => None,
                _ if number % 8 < 4 => Some((draw.thickness(&parts), draw.ground())),
                _ => {
                    let even = EVEN_GROUNDS[draw.random.random_range(0..EVEN_GROUNDS.len())];
                    Some((draw.thickness(&parts), vec![even; library.grid.count()]))
                }
            };
            films.push((parts, over));
        }
        Self::of(library, weights, films)
    }

    /// Films like those of the public draws, from other random streams: half of them hide, half lie over a
    /// ground.
    pub(super) fn candidates(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        count: usize,
        seed: u64,
    ) -> Self {
        let mut draw = Draw::new(library, seed, 5);
        let films = (0..count).map(|number| draw.film(number % 2 == 0)).collect();
        Self::of(library, weights, films)
    }

    /// Number of films.
    #[must_use]
    pub fn len(&self) -> usize {
        self.films.len()
    }

    /// Whether the set holds no film.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.films.is_empty()
    }

    pub(super) fn of(
        library: &PigmentLibrary,
        weights: &TristimulusWeights,
        films: Vec<(Parts, Option<Over>)>,
    ) -> Self {
        let surface = library.saunderson;
        let colored = films.into_par_iter().map(|(parts, over)| {
            let curves = mixed(library, &parts);
            let reflectance = match &over {
                None => curves.hiding(surface),
                Some((thickness, ground)) => over_ground(&curves, *thickness, ground, surface),
            };
            Film { parts, over, xyz: weights.xyz(&reflectance) }
        });
        Self { surface, white: weights.white(), films: colored.collect() }
    }
}

impl<'a> Draw<'a> {
    fn new(library: &'a PigmentLibrary, seed: u64, stream: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        Self { library, random }
    }

    /// A film that lies over a ground, or hides it.
    fn film(&mut self, over: bool) -> (Parts, Option<Over>) {
        let parts = self.shares();
        if !over {
            return (parts, None);
        }
        let thickness = self.thickness(&parts);
        (parts, Some((thickness, self.ground())))
    }

    /// One to four pigments with shares that sum to 1.
    fn shares(&mut self) -> Parts {
        let pigments = self.library.pigments.len();
        let count = self.random.random_range(1..=pigments.min(4));
        let drawn: Vec<(usize, f64)> = index::sample(&mut self.random, pigments, count)
            .into_iter()
            .map(|pigment| (pigment, Exp1.sample(&mut self.random)))
            .collect();
        // Exponential parts, normalised, are uniform over the simplex.
        let total: f64 = drawn.iter().map(|(_, part)| part).sum();
        drawn.into_iter().map(|(pigment, part)| (PigmentId(pigment), part / total)).collect()
    }

    /// Two pigments, of which one has a small share; each order of magnitude is equally likely.
    fn tint(&mut self) -> Parts {
        let pigments = self.library.pigments.len();
        if pigments < 2 {
            return vec![(PigmentId(0), 1.0)];
        }
        let pair = index::sample(&mut self.random, pigments, 2);
        let share = LEAST_TINT.powf(self.random.random::<f64>()) / 2.0;
        vec![(PigmentId(pair.index(0)), 1.0 - share), (PigmentId(pair.index(1)), share)]
    }

    /// A thickness for these parts, by optical thickness.
    fn thickness(&mut self, parts: &[(PigmentId, f64)]) -> f64 {
        let curves = self.mixed(parts);
        let both = curves.absorption.iter().zip(&curves.scattering);
        let mean = both.map(|(k, s)| k + s).sum::<f64>() / curves.absorption.len() as f64;
        let [least, most] = THICKNESSES;
        least * (most / least).powf(self.random.random()) / mean.max(f64::MIN_POSITIVE)
    }

    /// The internal reflectance of a mixture that hides, in half of the draws lightened.
    fn ground(&mut self) -> Vec<f64> {
        let below = self.shares();
        let lightened = self.random.random::<f64>().mul_add(2.0, -1.0).max(0.0);
        let ground = internal(&self.mixed(&below));
        ground.iter().map(|r| r + lightened * (0.9 - r).max(0.0)).collect()
    }

    fn mixed(&self, parts: &[(PigmentId, f64)]) -> Curves {
        mixed(self.library, parts)
    }
}

fn mixed(library: &PigmentLibrary, parts: &[(PigmentId, f64)]) -> Curves {
    library.mix(parts).expect("parts above 0 make a mixture")
}

/// Internal reflectance of a film that hides.
fn internal(curves: &Curves) -> Vec<f64> {
    curves.hiding(Surface::NONE)
}

fn over_ground(curves: &Curves, thickness: f64, ground: &[f64], surface: Surface) -> Vec<f64> {
    let pairs = curves.absorption.iter().zip(&curves.scattering).zip(ground);
    pairs
        .map(|((&k, &s), &below): ((&f64, &f64), &f64)| {
            surface.measured_from_internal(Layer::new(k, s, thickness).over(below))
        })
        .collect()
}
