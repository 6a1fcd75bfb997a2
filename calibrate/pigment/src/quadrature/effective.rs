//! A quadrature with effective K and S of every pigment at its wavelengths.

use rayon::prelude::*;
use spectra::color::{Lab, Xyz, delta_e_ciede2000};
use spectra::optics::{Layer, infinite_film};

use super::films::{Film, FilmSet};
use super::rule::{Quadrature, QuadratureError};
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// A quadrature that carries K and S of every pigment of a library at its wavelengths.
///
/// A wavelength of a quadrature stands for a band of the spectrum. The K and S of a pigment at the
/// wavelength itself are not the best that stand for the band: fitted ones, called effective here,
/// keep the colours of mixtures and films several times better.
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
        let at = |values: &[f64]| rule.at_nodes(library.grid, values);
        let absorption = library.pigments.iter().map(|p| at(&p.absorption)).collect();
        let scattering = library.pigments.iter().map(|p| at(&p.scattering)).collect();
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

    /// Colour error of each film.
    pub(super) fn errors(&self, library: &PigmentLibrary, films: &FilmSet) -> Vec<f64> {
        films
            .films
            .par_iter()
            .map(|film: &Film| {
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

#[cfg(test)]
mod tests {
    use spectra::{Illuminant, Observer};

    use super::*;
    use crate::evaluate::Viewing;

    fn viewing(illuminant: &str) -> Viewing {
        let illuminant = Illuminant::named(illuminant).unwrap();
        Viewing { illuminant, observer: Observer::Cie1931Deg2 }
    }

    /// Errors of hiding films and of films over grounds that nothing was fitted to.
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
        let effective = EffectiveQuadrature::of(&viewing("D65"), &oils, 8).unwrap();
        let [hiding, over] = unseen("D65", &effective, &oils);
        let [before, before_over] = unseen("D65", &interpolated, &oils);
        assert!(hiding.mean < 0.5 * before.mean, "{hiding:?} {before:?}");
        assert!(over.mean < 0.7 * before_over.mean, "{over:?} {before_over:?}");
    }

    #[test]
    fn unseen_films_keep_their_colours_under_any_light() {
        let oils = PigmentLibrary::van_gogh_oils();
        for light in ["A", "D50", "D65", "E", "FL2", "FL11", "HP1", "LED-B3"] {
            let effective = EffectiveQuadrature::of(&viewing(light), &oils, 8).unwrap();
            let [hiding, over] = unseen(light, &effective, &oils);
            let told = format!("{light}: {hiding:?}, over grounds {over:?}");
            assert!(hiding.mean < 0.05 && hiding.p95 < 0.17 && hiding.max < 0.70, "{told}");
            assert!(over.mean < 0.10 && over.p95 < 0.28 && over.max < 1.35, "{told}");
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
        let effective = EffectiveQuadrature::of(&viewing("FL11"), &oils, 8).unwrap();
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
        let fitted = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| EffectiveQuadrature::of(&viewing("D65"), &oils, 5).unwrap())
        };
        assert_eq!(fitted(1), fitted(3));
    }

    #[test]
    fn a_library_of_one_pigment_is_fitted_too() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments.truncate(1);
        library.reference = None;
        let effective = EffectiveQuadrature::of(&viewing("D65"), &library, 3).unwrap();
        let [hiding, over] = unseen("D65", &effective, &library);
        assert!(hiding.max < 0.20 && over.max < 4.0, "{hiding:?} {over:?}");
        // Eight wavelengths have more unknowns than one masstone can tell apart.
        let eight = EffectiveQuadrature::of(&viewing("D65"), &library, 8).unwrap();
        let [hiding, over] = unseen("D65", &eight, &library);
        assert!(hiding.max < 0.01 && over.max < 0.2, "{hiding:?} {over:?}");
    }
}
