//! Calibration from absolute amounts: you paint series of amounts and glazes of watercolour on one known
//! backing.

use documents::Task;
use rand::{SeedableRng, seq::SliceRandom};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use spectra::TristimulusWeights;
use spectra::optics::{Surface, UnevenFilm};

use crate::calibration::{Calibration, CalibrationError, HALF_KNOWN, pigment};
use crate::fit::{
    FiniteProblem, FitError, FitSettings, MeasuredFilm, Refined, Refinement, Smoothness,
    fit_finite, root_mean_square,
};
use crate::measurement::MeasurementError;
use crate::report;
use crate::report::Scores;
use crate::swatch::SwatchSet;
use pigment::PigmentId;
use pigment::evaluate::{Viewing, delta_e};
use pigment::library::{AmountKind, Evidence, Pigment, PigmentLibrary};

/// Collects every film of `set` that lies on a backing with known reflectance. Use this before
/// [`fit_finite`].
///
/// # Errors
/// [`MeasurementError::NoBareBacking`] for the first film on a backing without a bare reading,
/// [`MeasurementError::NoFilms`] if `set` has no films.
pub fn films(set: &SwatchSet) -> Result<FiniteProblem, MeasurementError> {
    let mut problem = FiniteProblem {
        grid: set.grid,
        pigments: set.pigments.len(),
        reading_sd: root_mean_square(
            set.swatches.iter().flat_map(|s| &s.films).filter_map(|film| film.spread),
        ),
        films: Vec::new(),
    };
    for (index, swatch) in set.swatches.iter().enumerate() {
        for film in &swatch.films {
            let bare = film.bare.clone().ok_or_else(|| MeasurementError::NoBareBacking {
                file: swatch.file.to_string(),
                row: swatch.row,
                sample: swatch.sample.clone(),
                backing: film.backing.clone(),
            })?;
            let several = swatch.films.len() > 1;
            let amounts = swatch.amounts.iter().copied().enumerate();
            let amounts = amounts.filter(|(_, amount)| *amount > 0.0);
            problem.films.push(MeasuredFilm {
                name: match several {
                    true => format!("{} on {}", swatch.sample, film.backing),
                    false => swatch.sample.clone(),
                },
                swatch: index,
                backing: film.backing.clone(),
                recipe: amounts.map(|(pigment, amount)| (PigmentId(pigment), amount)).collect(),
                reflectance: film.reflectance.clone(),
                bare,
            });
        }
    }
    if problem.films.is_empty() {
        return Err(MeasurementError::NoFilms);
    }
    Ok(problem)
}

/// Fits K and S per unit of amount by [`fit_finite`].
///
/// # Errors
/// [`CalibrationError`] if readings cannot be used, the fit fails or `task` was cancelled. `settings` say
/// how we treat readings below the surface's own reflection.
pub fn calibrate_absolute(
    set: &SwatchSet,
    film: UnevenFilm,
    settings: &FitSettings,
    viewing: &Viewing,
    task: &Task,
) -> Result<Calibration, CalibrationError> {
    let problem = films(set)?;
    let dark = report::below_surface(set, film.surface, settings.below_surface)?;
    let own = Viewing::default().weights(set.grid).expect("the method fits the grid");
    let how = Refinement::whole(settings.smoothness);
    let fit = fit_finite(&problem, film, &own, how, task)?;

    let weights = viewing.weights(set.grid).expect("the method fits the grid");
    let films = problem.films.iter().enumerate().map(|(index, measured)| {
        let predicted = problem.predicted(&fit, film, index);
        (measured.name.clone(), measured.reflectance.as_slice(), predicted)
    });
    let Scores { rms, delta_e, per_sample } = Scores::of(&weights, films).rounded();
    let undetermined = undetermined(&fit);
    let evidence = Evidence {
        illuminant: viewing.illuminant.name().to_owned(),
        observer: viewing.observer.name().to_owned(),
        rms,
        delta_e,
        warnings: report::absolute_warnings(set, &undetermined, dark, &per_sample),
        per_sample,
    };
    let deviations = fit.deviations.as_deref();
    let pigments = set.pigments.iter().enumerate().map(|(index, name)| Pigment {
        notes: if undetermined.contains(&PigmentId(index)) {
            vec!["these films tell little of S: the backing outshines its scattering".to_owned()]
        } else {
            Vec::new()
        },
        measured_amounts: measured_amounts(&problem, PigmentId(index)),
        ..pigment(name, &fit.curves[index], deviations.map(|all| &all[index]))
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
        scattering_known: Vec::new(),
    })
}

/// Least and greatest amount of a pigment in the films that contain it.
fn measured_amounts(problem: &FiniteProblem, pigment: PigmentId) -> Option<[f64; 2]> {
    let recipes = problem.films.iter().map(|film| &film.recipe);
    let amounts = recipes.flatten().filter(|(known, _)| *known == pigment);
    amounts.fold(None, |range: Option<[f64; 2]>, &(_, amount)| {
        Some(range.map_or([amount; 2], |[least, most]| [least.min(amount), most.max(amount)]))
    })
}

/// Pigments for which less than half of our information on S comes from the films.
fn undetermined(fit: &Refined) -> Vec<PigmentId> {
    let known = fit.scattering_known.iter().enumerate();
    known.filter(|(_, share)| **share < HALF_KNOWN).map(|(pigment, _)| PigmentId(pigment)).collect()
}

/// Chooses the film model that predicts unseen films best.
///
/// We first choose k2, the share of diffuse light that the surface reflects back inside, from 0, 0.3 and
/// 0.6 (k1 stays as given). Then we choose the unevenness of the films from 0, 0.25 and 0.5. The score of a
/// model is its mean CIEDE2000 in five-fold cross-validation, with the same random folds every time. We
/// replace the current model only if the score of another one is lower by more than 3 %. With fewer than 20
/// films you get the plain model (0 and 0) without a test. Use the chosen k2 for prediction only. It does
/// not measure the surface, because unevenness has a similar effect. `task` counts the fits, of which there
/// are [`CHOICE_FITS`].
///
/// # Errors
/// [`FitError`] from any fit, or if `task` was cancelled.
pub fn chosen_film(
    problem: &FiniteProblem,
    surface: Surface,
    task: &Task,
) -> Result<UnevenFilm, FitError> {
    let plain = UnevenFilm { surface: Surface { k2: 0.0, ..surface }, unevenness: 0.0 };
    if problem.films.len() < 4 * FOLDS {
        // There are too few films to leave any out.
        return Ok(plain);
    }
    let weights = Viewing::default().weights(problem.grid).expect("the method fits the grid");
    let quiet = task.quiet();
    let fits = task.steps_of("choice of the film model", CHOICE_FITS);
    let score = |film: UnevenFilm| -> Result<f64, FitError> {
        let folds = folds(problem.films.len(), FOLDS);
        let errors: Vec<Vec<f64>> = folds
            .par_iter()
            .map(|left_out| {
                let kept = all_but(problem.films.len(), left_out);
                let part = problem.with_films(&kept);
                let how = Refinement::prediction(Smoothness::None, None);
                let fit = fit_finite(&part, film, &weights, how, &quiet)?;
                fits.step();
                Ok(errors(problem, &fit, film, left_out, &weights))
            })
            .collect::<Result<_, FitError>>()?;
        let errors: Vec<f64> = errors.into_iter().flatten().collect();
        Ok(errors.iter().sum::<f64>() / errors.len() as f64)
    };
    // The best of the models replaces the current one if it gains 3 %.
    let replaced = |kept: (f64, UnevenFilm), models: [UnevenFilm; 2]| {
        let mut best = (LEAST_GAIN * kept.0, None);
        for model in models {
            let score = score(model)?;
            if score < best.0 {
                best = (score, Some(model));
            }
        }
        Ok::<_, FitError>(best.1.map_or(kept, |model| (best.0, model)))
    };
    let even = [0.3, 0.6].map(|k2| UnevenFilm { surface: Surface { k2, ..surface }, ..plain });
    let kept = replaced((score(plain)?, plain), even)?;
    let surface = kept.1.surface;
    Ok(replaced(kept, [0.25, 0.5].map(|unevenness| UnevenFilm { surface, unevenness }))?.1)
}

/// Number of fits that [`chosen_film`] makes: five models with five folds each.
pub const CHOICE_FITS: usize = 5 * FOLDS;
const FOLDS: usize = 5;
/// Another model replaces the current one only if its score is below this fraction of the current score
/// (chosen by eye).
const LEAST_GAIN: f64 = 0.97;
const FOLD_SEED: u64 = 2004;

pub(crate) fn errors(
    problem: &FiniteProblem,
    fit: &Refined,
    film: UnevenFilm,
    of: &[usize],
    weights: &TristimulusWeights,
) -> Vec<f64> {
    of.iter()
        .map(|&index: &usize| {
            let predicted = problem.predicted(fit, film, index);
            delta_e(weights, &problem.films[index].reflectance, &predicted)
        })
        .collect()
}

/// Deals `count` indices at random into `folds` groups. They are the same every time.
pub(crate) fn folds(count: usize, folds: usize) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..count).collect();
    order.shuffle(&mut ChaCha8Rng::seed_from_u64(FOLD_SEED));
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
    fn folds_hold_every_index_once_and_all_but_is_the_complement() {
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
