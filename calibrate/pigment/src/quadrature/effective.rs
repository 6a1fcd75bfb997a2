//! A quadrature with effective K and S of every pigment at its wavelengths. We fit it to films that hide
//! their ground or lie over one, with their exact colours.

use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1};
use rayon::prelude::*;
use serde_json::{Value, json};
use spectra::TristimulusWeights;
use spectra::color::{Lab, Xyz, delta_e_ciede2000};
use spectra::optics::{Layer, Surface, infinite_film};

use super::rule::{Quadrature, QuadratureError};
use crate::library::PigmentLibrary;
use crate::recipe::{Curves, PigmentId};

/// A quadrature that carries K and S of every pigment of a library at its wavelengths.
///
/// A wavelength of a quadrature stands for a band of the spectrum. The K and S of a pigment at the
/// wavelength itself are not the best ones for this band. If we fit them, we keep the colours of mixtures
/// and films several times better. We call fitted ones effective.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectiveQuadrature {
    /// Wavelengths and weights.
    pub rule: Quadrature,
    /// K of every pigment at each wavelength, in the order of the library's pigments.
    pub absorption: Vec<Vec<f64>>,
    /// S of every pigment at each wavelength, in the order of the library's pigments.
    pub scattering: Vec<Vec<f64>>,
}

impl EffectiveQuadrature {
    /// `rule` with the K and S of `library` interpolated at its wavelengths.
    #[must_use]
    pub fn interpolated(rule: Quadrature, library: &PigmentLibrary) -> Self {
        let absorption =
            library.pigments.iter().map(|p| rule.at_nodes(library.grid, &p.absorption)).collect();
        let scattering =
            library.pigments.iter().map(|p| rule.at_nodes(library.grid, &p.scattering)).collect();
        Self { rule, absorption, scattering }
    }

    /// K and S at each wavelength of a mixture of pigments in these parts.
    ///
    /// # Panics
    /// If a pigment belongs to another library.
    #[must_use]
    pub fn mixed(&self, parts: &[(PigmentId, f64)]) -> [Vec<f64>; 2] {
        [&self.absorption, &self.scattering].map(|curves| {
            let mut sum = vec![0.0; self.rule.nodes_nm.len()];
            for (pigment, part) in parts {
                for (total, value) in sum.iter_mut().zip(&curves[pigment.index()]) {
                    *total += part * value;
                }
            }
            sum
        })
    }

    /// Colour error against full integration over `films` of the library that it was made for.
    #[must_use]
    pub fn error(&self, library: &PigmentLibrary, films: &FilmSet) -> QuadratureError {
        QuadratureError::of(&self.errors(library, films))
    }

    pub(super) fn errors(&self, library: &PigmentLibrary, films: &FilmSet) -> Vec<f64> {
        films
            .films
            .par_iter()
            .map(|film| {
                let found = Lab::from_xyz(self.xyz(library, film), self.rule.white);
                delta_e_ciede2000(found, Lab::from_xyz(film.xyz, films.white))
            })
            .collect()
    }

    fn xyz(&self, library: &PigmentLibrary, film: &Film) -> Xyz {
        let [absorption, scattering] = self.mixed(&film.parts);
        let pairs = absorption.iter().zip(&scattering);
        let internal: Vec<f64> = match &film.over {
            None => pairs.map(|(&k, &s)| infinite_film(k, s)).collect(),
            Some((thickness, ground)) => pairs
                .zip(self.rule.at_nodes(library.grid, ground))
                .map(|((&k, &s), below)| Layer::new(k, s, *thickness).over(below))
                .collect(),
        };
        let surface = library.saunderson;
        let seen: Vec<f64> =
            internal.into_iter().map(|r| surface.measured_from_internal(r)).collect();
        self.rule.xyz(&seen)
    }
}

/// Films over a ground have optical thicknesses (K + S) d in this range, as the mean over wavelengths: from
/// a stain to a film that hides. We chose it by eye.
const THICKNESSES: [f64; 2] = [0.03, 10.0];

/// The weaker pigment of a tint has at least this share. We chose it by eye.
const LEAST_TINT: f64 = 0.003;

/// We fit films over even grounds of these internal reflectances: black and white paper.
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

/// Generator of random films.
struct Draw<'a> {
    library: &'a PigmentLibrary,
    random: ChaCha8Rng,
}

impl FilmSet {
    /// Draws `count` films that hide their ground, of one to four pigments. Each number of pigments is
    /// equally likely. We draw the pigments uniformly, and the shares are uniform over all that sum to 1.
    /// You get the same films from the same seed.
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

    /// Draws `count` random films, mixed like the films of [`FilmSet::hiding`], of optical thicknesses
    /// (K + S) d from 0.03 to 10. The ground of each has the colour of another random mixture. We lighten
    /// this colour in half of the films.
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

    /// Draws films for fitting: every pigment alone, mixtures, tints, and films over black and
    /// white. Their random numbers are independent of [`FilmSet::hiding`] and
    /// [`FilmSet::over_grounds`], so that you can test a fit with those.
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

    /// Draws films like [`FilmSet::hiding`] and [`FilmSet::over_grounds`] do, half of each, but
    /// with other random numbers.
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

    /// Two pigments, of which one has a small share. Each order of magnitude is equally likely.
    fn tint(&mut self) -> Parts {
        let pigments = self.library.pigments.len();
        if pigments < 2 {
            return vec![(PigmentId(0), 1.0)];
        }
        let pair = index::sample(&mut self.random, pigments, 2);
        let share = LEAST_TINT.powf(self.random.random::<f64>()) / 2.0;
        vec![(PigmentId(pair.index(0)), 1.0 - share), (PigmentId(pair.index(1)), share)]
    }

    /// Draws a thickness for these parts. We draw the optical thickness evenly in its logarithm.
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
        .map(|((&k, &s), &below)| {
            surface.measured_from_internal(Layer::new(k, s, thickness).over(below))
        })
        .collect()
}

impl Quadrature {
    /// The wavelengths `nodes_nm` with their `weights`, and the `error` over mixtures, null without one.
    #[must_use]
    pub fn to_json(&self, error: Option<QuadratureError>) -> Value {
        json!({ "nodes_nm": self.nodes_nm, "weights": self.weights, "error": error })
    }
}

impl EffectiveQuadrature {
    /// The rule as [`Quadrature::to_json`] with its `error` over films that hide, `error_over_grounds`, and
    /// K and S of each pigment at the wavelengths. Pass the `library` for which you fitted the quadrature.
    #[must_use]
    pub fn to_json(
        &self,
        library: &PigmentLibrary,
        [hiding, over_grounds]: [Option<QuadratureError>; 2],
    ) -> Value {
        let curves = self.absorption.iter().zip(&self.scattering);
        let pigments = library.pigments.iter().zip(curves);
        let pigments: Vec<Value> = pigments
            .map(|(p, (k, s))| json!({ "name": p.name, "absorption": k, "scattering": s }))
            .collect();
        json!({
            "nodes_nm": self.rule.nodes_nm,
            "weights": self.rule.weights,
            "error": hiding,
            "error_over_grounds": over_grounds,
            "pigments": pigments,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::Viewing;
    use documents::Task;
    use spectra::{Illuminant, Observer};

    fn viewing(illuminant: &str) -> Viewing {
        let illuminant = Illuminant::named(illuminant).unwrap();
        Viewing { illuminant, observer: Observer::Cie1931Deg2 }
    }

    /// Errors over films to which nothing was fitted: films that hide, and films over grounds.
    fn unseen(
        light: &str,
        quadrature: &EffectiveQuadrature,
        library: &PigmentLibrary,
    ) -> [QuadratureError; 2] {
        let weights = viewing(light).weights(library.grid).unwrap();
        let hiding = FilmSet::hiding(library, &weights, 5000, 11);
        let over = FilmSet::over_grounds(library, &weights, 5000, 11);
        [hiding, over].map(|films| quadrature.error(library, &films))
    }

    #[test]
    fn unseen_films_keep_their_colours_better_than_by_interpolation() {
        let oils = PigmentLibrary::van_gogh_oils();
        let rule = Quadrature::library(&viewing("D65"), &oils, 8).unwrap();
        let interpolated = EffectiveQuadrature::interpolated(rule, &oils);
        let effective =
            EffectiveQuadrature::of(&viewing("D65"), &oils, 8, &Task::default()).unwrap();
        let [hiding, over] = unseen("D65", &effective, &oils);
        let [before, before_over] = unseen("D65", &interpolated, &oils);
        assert!(hiding.mean < 0.5 * before.mean, "{hiding:?} {before:?}");
        assert!(over.mean < 0.7 * before_over.mean, "{over:?} {before_over:?}");
    }

    #[test]
    fn unseen_films_keep_their_colours_under_any_light() {
        let oils = PigmentLibrary::van_gogh_oils();
        for light in ["A", "D50", "D65", "E", "FL2", "FL11", "HP1", "LED-B3"] {
            let effective =
                EffectiveQuadrature::of(&viewing(light), &oils, 8, &Task::default()).unwrap();
            let [hiding, over] = unseen(light, &effective, &oils);
            let summary = format!("{light}: {hiding:?}, over grounds {over:?}");
            assert!(hiding.mean < 0.05 && hiding.p95 < 0.17 && hiding.max < 0.70, "{summary}");
            assert!(over.mean < 0.10 && over.p95 < 0.28 && over.max < 1.45, "{summary}");
        }
    }

    #[test]
    fn interpolated_coefficients_have_the_error_of_the_rule() {
        let oils = PigmentLibrary::van_gogh_oils();
        let rule = Quadrature::moments(&viewing("A"), 8).unwrap();
        let weights = viewing("A").weights(oils.grid).unwrap();
        let masstones = crate::quadrature::MixtureSet::masstones(&oils, &weights);
        let films = oils.ids().map(|id| (vec![(id, 1.0)], None)).collect();
        let films = FilmSet::of(&oils, &weights, films);
        let wanted = rule.error(&masstones);
        let found = EffectiveQuadrature::interpolated(rule, &oils).error(&oils, &films);
        assert!((found.mean - wanted.mean).abs() < 1e-9 && (found.max - wanted.max).abs() < 1e-9);
    }

    #[test]
    fn white_stays_white_and_coefficients_stay_above_zero() {
        let oils = PigmentLibrary::van_gogh_oils();
        let effective =
            EffectiveQuadrature::of(&viewing("FL11"), &oils, 8, &Task::default()).unwrap();
        let white = effective.rule.xyz(&[1.0; 8]).to_array();
        for (found, wanted) in white.into_iter().zip(effective.rule.white.to_array()) {
            assert!((found - wanted).abs() < 1e-8, "{found} for {wanted}");
        }
        assert!(effective.rule.nodes_nm.is_sorted(), "{:?}", effective.rule.nodes_nm);
        let all = effective.absorption.iter().chain(&effective.scattering).flatten();
        assert!(all.clone().count() == 320 && all.clone().all(|v| v.is_finite() && *v > 0.0));
    }

    #[test]
    fn any_number_of_threads_fits_the_same_bits() {
        let oils = PigmentLibrary::van_gogh_oils();
        let [one, three] = [1, 3].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                EffectiveQuadrature::of(&viewing("D65"), &oils, 5, &Task::default()).unwrap()
            })
        });
        assert_eq!(one, three);
    }

    #[test]
    fn a_library_of_one_pigment_is_fitted_too() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments.truncate(1);
        library.reference = None;
        let effective =
            EffectiveQuadrature::of(&viewing("D65"), &library, 3, &Task::default()).unwrap();
        let [hiding, over] = unseen("D65", &effective, &library);
        assert!(hiding.max < 0.22 && over.max < 4.4, "{hiding:?} {over:?}");
        // Eight wavelengths have more unknowns than one masstone determines.
        let eight =
            EffectiveQuadrature::of(&viewing("D65"), &library, 8, &Task::default()).unwrap();
        let [hiding, over] = unseen("D65", &eight, &library);
        assert!(hiding.max < 0.01 && over.max < 0.2, "{hiding:?} {over:?}");
    }
}
