//! Calibration from films whose amounts are absolute: ladders and glazes of
//! watercolor on one known backing.

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use spectra::TristimulusWeights;
use spectra::optics::{Surface, UnevenFilm};

use crate::calibration::{Calibration, CalibrationError};
use crate::findings;
use crate::fit::{
    FiniteProblem, FitError, FitSettings, Refined, Refinement, Smoothness, fit_finite,
    root_mean_square,
};
use crate::measurement::MeasurementError;
use crate::scores::Scores;
use crate::swatch::SwatchSet;
use pigment::digits::rounded;
use pigment::evaluate::{Viewing, delta_e};
use pigment::library::{AmountKind, Evidence, Pigment, PigmentLibrary};

/// Every film of `set` that lies on a backing of known reflectance, by name.
///
/// # Errors
/// [`MeasurementError::NoBareBacking`] for the first film whose backing has no
/// bare reading, [`MeasurementError::NoFilms`] if there is no film.
pub fn films(set: &SwatchSet) -> Result<(FiniteProblem, Vec<String>), MeasurementError> {
    let mut problem = FiniteProblem {
        grid: set.grid,
        pigments: set.pigments.len(),
        reading_sd: root_mean_square(
            set.swatches.iter().flat_map(|s| &s.films).filter_map(|film| film.spread),
        ),
        recipes: Vec::new(),
        reflectance: Vec::new(),
        bare: Vec::new(),
    };
    let mut names = Vec::new();
    for swatch in &set.swatches {
        for film in &swatch.films {
            let bare = film.bare.clone().ok_or_else(|| MeasurementError::NoBareBacking {
                file: swatch.file.to_string(),
                row: swatch.row,
                sample: swatch.sample.clone(),
                backing: film.backing.clone(),
            })?;
            let amounts = swatch.amounts.iter().copied().enumerate();
            problem.recipes.push(amounts.filter(|(_, amount)| *amount > 0.0).collect());
            problem.reflectance.push(film.reflectance.clone());
            problem.bare.push(bare);
            names.push(if swatch.films.len() > 1 {
                format!("{} on {}", swatch.sample, film.backing)
            } else {
                swatch.sample.clone()
            });
        }
    }
    if names.is_empty() {
        return Err(MeasurementError::NoFilms);
    }
    Ok((problem, names))
}

/// Fits K and S per unit of amount, see [`fit_finite`].
///
/// # Errors
/// [`CalibrationError`]; a reading below the surface's own reflection is
/// refused as for shares.
pub fn calibrate_absolute(
    set: &SwatchSet,
    film: UnevenFilm,
    settings: &FitSettings,
    viewing: &Viewing,
) -> Result<Calibration, CalibrationError> {
    let (problem, names) = films(set)?;
    let dark = findings::below_surface(set, film.surface, settings.below_surface)?;
    let own = Viewing::default().weights(set.grid).expect("the method fits the grid");
    let fit = fit_finite(&problem, film, &own, Refinement::whole(settings.smoothness))?;

    let weights = viewing.weights(set.grid).expect("the method fits the grid");
    let films = names.into_iter().enumerate().map(|(index, name)| {
        let predicted = problem.predicted(&fit, film, index);
        (name, problem.reflectance[index].as_slice(), predicted)
    });
    let Scores { rms, delta_e, per_sample } = Scores::of(&weights, films).rounded();
    let undetermined = undetermined(&fit);
    let evidence = Evidence {
        illuminant: viewing.illuminant.name().to_owned(),
        observer: viewing.observer.name().to_owned(),
        rms,
        delta_e,
        warnings: findings::absolute_warnings(set, &undetermined, dark, &per_sample),
        per_sample,
    };
    let curve = |values: &[f64]| values.iter().map(|&v| rounded(v)).collect();
    let pigments = set.pigments.iter().enumerate().map(|(index, name)| Pigment {
        name: name.clone(),
        color_index: None,
        absorption: curve(&fit.absorption[index]),
        scattering: curve(&fit.scattering[index]),
        absorption_sd: curve(&fit.absorption_sd[index]),
        scattering_sd: curve(&fit.scattering_sd[index]),
        identified: true,
        guessed: false,
        notes: if undetermined.contains(&index) {
            vec!["these films tell little of S: the backing outshines its scattering".to_owned()]
        } else {
            Vec::new()
        },
    });
    Ok(Calibration {
        library: PigmentLibrary {
            title: String::new(),
            licence: String::new(),
            source: String::new(),
            grid: set.grid,
            amounts: AmountKind::Absolute,
            reference: None,
            saunderson: film.surface,
            unevenness: film.unevenness,
            inputs: Vec::new(),
            settings: Some(settings.clone()),
            pigments: pigments.collect(),
            evidence: Some(evidence),
        },
        observations: Vec::new(),
        condition: None,
        state: Some(fit.state),
    })
}

/// Pigments of whose S less than half of what is known comes from the films.
fn undetermined(fit: &Refined) -> Vec<usize> {
    let known = fit.scattering_known.iter().enumerate();
    known.filter(|(_, share)| **share < 0.5).map(|(pigment, _)| pigment).collect()
}

/// The film model that predicts unseen films best.
///
/// Tried are the share k2 that the surface turns back (0, 0.3, 0.6; k1 as
/// given), then the unevenness of the films (0, 0.25, 0.5), each by five-fold
/// cross-validation over seeded folds, scored by mean CIEDE2000. A model gives
/// way to a better one only for a gain of 3 %; for fewer than 20 films the plain
/// one (0 and 0) is taken untried. Such a k2 serves prediction; it is no
/// measurement of the surface, which unevenness imitates.
///
/// # Errors
/// [`FitError`] as [`fit_finite`].
pub fn chosen_film(
    problem: &FiniteProblem,
    surface: Surface,
    progress: &(impl Fn() + Sync),
) -> Result<UnevenFilm, FitError> {
    let plain = UnevenFilm { surface: Surface { k2: 0.0, ..surface }, unevenness: 0.0 };
    if problem.recipes.len() < 4 * FOLDS {
        // Too few to hold any back.
        return Ok(plain);
    }
    let weights = Viewing::default().weights(problem.grid).expect("the method fits the grid");
    let score = |film: UnevenFilm| -> Result<f64, FitError> {
        let folds = folds(problem.recipes.len(), FOLDS);
        let errors: Vec<Vec<f64>> = folds
            .par_iter()
            .map(|left_out| {
                let kept = all_but(problem.recipes.len(), left_out);
                let part = problem.of(&kept);
                let fit = fit_finite(
                    &part,
                    film,
                    &weights,
                    Refinement::prediction(Smoothness::None, None),
                )?;
                progress();
                Ok(errors(problem, &fit, film, left_out, &weights))
            })
            .collect::<Result<_, FitError>>()?;
        let errors: Vec<f64> = errors.into_iter().flatten().collect();
        Ok(errors.iter().sum::<f64>() / errors.len() as f64)
    };
    let with =
        |k2: f64, unevenness: f64| UnevenFilm { surface: Surface { k2, ..surface }, unevenness };
    // The best of some models replaces the one kept if it gains 3 %.
    let replaced = |kept: (f64, UnevenFilm), models: [UnevenFilm; 2]| {
        let mut best = (0.97 * kept.0, None);
        for model in models {
            let score = score(model)?;
            if score < best.0 {
                best = (score, Some(model));
            }
        }
        Ok(best.1.map_or(kept, |model| (best.0, model)))
    };
    let kept = replaced((score(plain)?, plain), [with(0.3, 0.0), with(0.6, 0.0)])?;
    let k2 = kept.1.surface.k2;
    Ok(replaced(kept, [with(k2, 0.25), with(k2, 0.5)])?.1)
}

/// Fits that [`chosen_film`] makes.
pub const CHOICE_FITS: usize = 5 * FOLDS;
const FOLDS: usize = 5;

pub(crate) fn errors(
    problem: &FiniteProblem,
    fit: &Refined,
    film: UnevenFilm,
    of: &[usize],
    weights: &TristimulusWeights,
) -> Vec<f64> {
    let error = |&index: &usize| {
        let predicted = problem.predicted(fit, film, index);
        delta_e(weights, &problem.reflectance[index], &predicted)
    };
    of.iter().map(error).collect()
}

/// `count` indices in seeded order, dealt into `folds` hands.
pub(crate) fn folds(count: usize, folds: usize) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..count).collect();
    order.shuffle(&mut ChaCha8Rng::seed_from_u64(2004));
    (0..folds.min(count))
        .map(|fold| order.iter().copied().skip(fold).step_by(folds).collect())
        .collect()
}

pub(crate) fn all_but(count: usize, left_out: &[usize]) -> Vec<usize> {
    (0..count).filter(|index| !left_out.contains(index)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folds_deal_every_index_once_and_the_rest_is_all_but_them() {
        let dealt = folds(23, 5);
        let mut all: Vec<usize> = dealt.iter().flatten().copied().collect();
        all.sort_unstable();
        assert_eq!(all, (0..23).collect::<Vec<_>>());
        for left_out in &dealt {
            let kept = all_but(23, left_out);
            assert_eq!(kept.len() + left_out.len(), 23);
            assert!(kept.iter().all(|index| !left_out.contains(index)), "{kept:?} {left_out:?}");
        }
    }
}
