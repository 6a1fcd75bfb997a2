//! How well films that a fit has not seen are predicted.

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
use pigment::mixture::Mixture;

/// Errors of mixtures predicted without their own measurement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Validation {
    /// Root mean square error of measured reflectance.
    pub rms: f64,
    /// Summary of the colour errors.
    pub delta_e: Summary,
    /// By mixture, in order of the file.
    pub per_sample: Vec<SampleEvidence>,
    /// Mixtures that could not be left out, since a pigment would not be
    /// identified without them.
    pub needed: Vec<String>,
}

/// How to fit, and what to leave out.
pub struct ValidationPlan<'a> {
    /// The fit's settings.
    pub settings: &'a FitSettings,
    /// Light and observer of the errors.
    pub viewing: &'a Viewing,
    /// What the fit of all samples found out about the noise; spares estimating
    /// it anew. On the Van Gogh oils this moves the mean error by 0.004.
    pub state: Option<RefinedState>,
    /// Leave out this many seeded groups, instead of each mixture by itself.
    pub folds: Option<usize>,
    /// Called after each mixture.
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

    /// What `predict` makes of each group left out, on all cores, in order.
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

/// Refits without each mixture (two pigments or more) that `chosen` admits, on
/// all cores, and predicts its film that hides.
///
/// # Errors
/// [`CalibrationError`] from reading or from any fit.
pub fn validate(
    set: &SwatchSet,
    reference: usize,
    surface: Surface,
    plan: &ValidationPlan<'_>,
    chosen: impl Fn(&Observation) -> bool,
) -> Result<Validation, CalibrationError> {
    let observations = observations(set, surface, plan.settings.below_surface)?;
    let shares = |some: &[&Observation]| -> Vec<Vec<f64>> {
        some.iter().map(|o| o.shares.clone()).collect()
    };
    let unknown = unidentified(&shares(&observations.iter().collect::<Vec<_>>()), reference);
    let is_mixture = |o: &Observation| o.shares.iter().filter(|s| **s > 0.0).count() > 1;
    let candidates: Vec<usize> = (0..observations.len())
        .filter(|&i| is_mixture(&observations[i]) && chosen(&observations[i]))
        .filter(|&i| unknown.iter().all(|u| observations[i].shares[u.pigment] == 0.0))
        .collect();
    let predict = |group: &Vec<usize>| -> Result<Vec<Prediction>, CalibrationError> {
        let rest: Vec<Observation> =
            all_but(observations.len(), group).iter().map(|&i| observations[i].clone()).collect();
        let unknown = unidentified(&shares(&rest.iter().collect::<Vec<_>>()), reference);
        let (solvable, identified) = without(&rest, &unknown);
        let among = identified.iter().position(|&p| p == reference).ok_or(FitError::Reference)?;
        let problem = Problem::new(set.grid, surface, &solvable, among)?;
        let how = Refinement::prediction(plan.settings.smoothness, plan.state);
        let solution = solve(&problem, plan.settings.method, how)?;
        let predictions = group.iter().map(|&index| {
            (plan.progress)();
            let target = &observations[index];
            let needed = unknown.iter().any(|u| target.shares[u.pigment] > 0.0);
            let parts = identified.iter().enumerate().map(|(place, &pigment)| {
                let curves = (&solution.absorption[place], &solution.scattering[place]);
                (target.shares[pigment], curves.0.as_slice(), curves.1.as_slice())
            });
            let predicted = Mixture::of(set.grid.count(), parts).hiding(surface);
            Prediction { index, predicted: (!needed).then_some(predicted) }
        });
        Ok(predictions.collect())
    };
    let predictions = plan.predictions(&candidates, predict)?;
    let sample = |index: usize| {
        (observations[index].sample.clone(), observations[index].reflectance.as_slice())
    };
    Ok(summary(set, plan, predictions, sample))
}

/// The same for absolute amounts: each film of two pigments or more.
///
/// # Errors
/// [`CalibrationError`] from reading or from any fit.
pub fn validate_absolute(
    set: &SwatchSet,
    film: UnevenFilm,
    plan: &ValidationPlan<'_>,
) -> Result<Validation, CalibrationError> {
    let (problem, names) = films(set)?;
    let weights = Viewing::default().weights(set.grid).expect("the method fits the grid");
    let count = problem.recipes.len();
    let candidates: Vec<usize> = (0..count).filter(|&i| problem.recipes[i].len() > 1).collect();
    let predict = |group: &Vec<usize>| -> Result<Vec<Prediction>, CalibrationError> {
        let how = Refinement::prediction(plan.settings.smoothness, plan.state);
        let part = problem.of(&all_but(count, group));
        let fit = fit_finite(&part, film, &weights, how)?;
        let predictions = group.iter().map(|&index| {
            (plan.progress)();
            Prediction { index, predicted: Some(problem.predicted(&fit, film, index)) }
        });
        Ok(predictions.collect())
    };
    let predictions = plan.predictions(&candidates, predict)?;
    let sample = |index: usize| (names[index].clone(), problem.reflectance[index].as_slice());
    Ok(summary(set, plan, predictions, sample))
}

/// What was predicted of a left-out sample; nothing if it was needed.
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
