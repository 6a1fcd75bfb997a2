//! Errors of predictions for films that the fit has not seen.

use rayon::prelude::*;
use serde::Serialize;
use spectra::optics::{Surface, UnevenFilm};

use crate::absolute::{all_but, films, folds};
use crate::calibration::{CalibrationError, solve, without};
use crate::fit::{
    FitError, FitSettings, Problem, RefinedState, Refinement, fit_finite, unidentified,
};
use crate::observation::{Observation, observations};
use crate::scores::Scores;
use crate::swatch::SwatchSet;
use pigment::evaluate::{Summary, Viewing};
use pigment::library::SampleEvidence;
use pigment::{Curves, PigmentId};

/// Groups that are left out in turn for absolute amounts, where each film by itself would take too long;
/// chosen by eye.
pub const DEFAULT_FOLDS: usize = 10;

/// Errors of mixtures that were predicted without their own measurement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Validation {
    /// Root mean square error of measured reflectance.
    pub rms: f64,
    /// Summary of the colour errors in CIEDE2000.
    pub delta_e: Summary,
    /// Colour error of each mixture, in order of the file.
    pub per_sample: Vec<SampleEvidence>,
    /// Mixtures that could not be left out, since a pigment would not be identified without them.
    pub needed: Vec<String>,
}

/// Settings of a validation: the fit, and the mixtures that are left out.
pub struct ValidationPlan<'a> {
    /// Settings of the fits.
    pub settings: &'a FitSettings,
    /// Light and observer of the colour errors.
    pub viewing: &'a Viewing,
    /// Estimates from the fit of all samples, which are reused rather than estimated in each fit. On the
    /// Van Gogh oils this moves the mean error by 0.004.
    pub state: Option<RefinedState>,
    /// Number of seeded groups that are left out in turn; `None` for each mixture by itself.
    pub folds: Option<usize>,
    /// Called after each mixture, from any thread.
    pub progress: &'a (dyn Fn() + Sync),
}

impl std::fmt::Debug for ValidationPlan<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ValidationPlan")
            .field("settings", &self.settings)
            .field("folds", &self.folds)
            .finish_non_exhaustive()
    }
}

impl ValidationPlan<'_> {
    fn groups(&self, candidates: &[usize]) -> Vec<Vec<usize>> {
        let Some(count) = self.folds else { return candidates.iter().map(|&c| vec![c]).collect() };
        let dealt = folds(candidates.len(), count);
        dealt.into_iter().map(|group| group.into_iter().map(|i| candidates[i]).collect()).collect()
    }

    /// Predictions of each group left out, on all cores, in order of the file.
    fn predictions(
        &self,
        candidates: &[usize],
        predict: impl Fn(&Vec<usize>) -> Result<Vec<Prediction>, CalibrationError> + Sync,
    ) -> Result<Vec<Prediction>, CalibrationError> {
        let groups = self.groups(candidates);
        let predicted = groups.par_iter().map(&predict).collect::<Result<Vec<_>, _>>()?;
        let mut predictions: Vec<Prediction> = predicted.into_iter().flatten().collect();
        predictions.sort_by_key(|prediction| prediction.index);
        Ok(predictions)
    }
}

/// Refits without each mixture (of two pigments or more) that `chosen` selects, on all cores, and predicts
/// it as a film that hides.
///
/// # Errors
/// [`CalibrationError`] from reading or from any fit.
pub fn leave_out(
    set: &SwatchSet,
    reference: PigmentId,
    surface: Surface,
    plan: &ValidationPlan<'_>,
    chosen: impl Fn(&Observation) -> bool,
) -> Result<Validation, CalibrationError> {
    let observations = observations(set, surface, plan.settings.below_surface)?;
    let unknown = unidentified(observations.iter().map(|o| o.shares.as_slice()), reference);
    let is_mixture = |o: &Observation| o.shares.iter().filter(|s| **s > 0.0).count() > 1;
    let candidates: Vec<usize> = (0..observations.len())
        .filter(|&i| is_mixture(&observations[i]) && chosen(&observations[i]))
        .filter(|&i| unknown.iter().all(|u| observations[i].shares[u.pigment.index()] == 0.0))
        .collect();
    let predict = |group: &Vec<usize>| -> Result<Vec<Prediction>, CalibrationError> {
        let rest: Vec<Observation> =
            all_but(observations.len(), group).iter().map(|&i| observations[i].clone()).collect();
        let unknown = unidentified(rest.iter().map(|o| o.shares.as_slice()), reference);
        let (solvable, identified) = without(&rest, &unknown);
        let among = identified.iter().position(|&p| p == reference).ok_or(FitError::Reference)?;
        let problem = Problem::new(set.grid, surface, &solvable, PigmentId(among))?;
        let how = Refinement::prediction(plan.settings.smoothness, plan.state);
        let solution = solve(&problem, plan.settings.method, how)?;
        let predictions = group.iter().map(|&index| {
            (plan.progress)();
            let target = &observations[index];
            let needed = unknown.iter().any(|u| target.shares[u.pigment.index()] > 0.0);
            let parts = identified.iter().zip(&solution.curves).map(|(pigment, curves)| {
                let (absorption, scattering) = curves.as_slices();
                (target.shares[pigment.index()], absorption, scattering)
            });
            let predicted = Curves::weighted_sum(set.grid, parts).hiding(surface);
            Prediction { index, predicted: (!needed).then_some(predicted) }
        });
        Ok(predictions.collect())
    };
    let predictions = plan.predictions(&candidates, predict)?;
    let sample =
        |index: usize| (observations[index].sample.clone(), observations[index].as_read.as_slice());
    Ok(summary(set, plan, predictions, sample))
}

/// Refits without each film of two pigments or more, for absolute amounts, and predicts it.
///
/// # Errors
/// [`CalibrationError`] from reading or from any fit.
pub fn leave_out_films(
    set: &SwatchSet,
    film: UnevenFilm,
    plan: &ValidationPlan<'_>,
) -> Result<Validation, CalibrationError> {
    let problem = films(set)?;
    let weights = Viewing::default().weights(set.grid).expect("the method fits the grid");
    let count = problem.films.len();
    let candidates: Vec<usize> =
        (0..count).filter(|&i| problem.films[i].recipe.len() > 1).collect();
    let predict = |group: &Vec<usize>| -> Result<Vec<Prediction>, CalibrationError> {
        let how = Refinement::prediction(plan.settings.smoothness, plan.state);
        let part = problem.with_films(&all_but(count, group));
        let fit = fit_finite(&part, film, &weights, how)?;
        let predictions = group.iter().map(|&index| {
            (plan.progress)();
            Prediction { index, predicted: Some(problem.predicted(&fit, film, index)) }
        });
        Ok(predictions.collect())
    };
    let predictions = plan.predictions(&candidates, predict)?;
    let sample = |index: usize| {
        (problem.films[index].name.clone(), problem.films[index].reflectance.as_slice())
    };
    Ok(summary(set, plan, predictions, sample))
}

/// Prediction of a left-out sample; `None` if a pigment would not be identified without it.
struct Prediction {
    index: usize,
    predicted: Option<Vec<f64>>,
}

fn summary<'a>(
    set: &SwatchSet,
    plan: &ValidationPlan<'_>,
    predictions: Vec<Prediction>,
    sample: impl Fn(usize) -> (String, &'a [f64]),
) -> Validation {
    let weights = plan.viewing.weights(set.grid).expect("the method fits the grid");
    let mut films = Vec::new();
    let mut needed = Vec::new();
    for Prediction { index, predicted } in predictions {
        let (name, measured) = sample(index);
        match predicted {
            Some(predicted) => films.push((name, measured, predicted)),
            None => needed.push(name),
        }
    }
    let Scores { rms, delta_e, per_sample } = Scores::of(&weights, films);
    Validation { rms, delta_e, per_sample, needed }
}
