//! Errors of predictions for films that the fit has not seen.

use rayon::prelude::*;
use serde::Serialize;
use spectra::optics::{Surface, UnevenFilm};

use crate::absolute::{all_but, films, folds};
use crate::calibration::CalibrationError;
use crate::fit::{FitSettings, FitStage, RefinedState, Refinement, Watch, fit_finite};
use crate::observation::{Observation, observations};
use crate::refit::Refits;
use crate::residuals::LeftOutMixture;
use crate::scores::Scores;
use crate::swatch::SwatchSet;
use pigment::PigmentId;
use pigment::evaluate::{Summary, Viewing, delta_e};
use pigment::library::SampleEvidence;

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
    /// Summary of the colour errors that would remain if the amounts of all pigments of each mixture but
    /// its main one were free by one common factor: the part of the errors that is not strength. `None`
    /// for absolute amounts.
    pub strength_free: Option<Summary>,
    /// Pigments by their part of the error, the greatest first; empty for absolute amounts.
    pub by_pigment: Vec<PigmentError>,
    /// Measured and predicted films of the mixtures; empty for absolute amounts, whose films do not hide.
    #[serde(skip)]
    pub mixtures: Vec<LeftOutMixture>,
}

/// Part of the errors of a validation in mixtures with one pigment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PigmentError {
    /// Name of the pigment.
    pub pigment: String,
    /// Number of mixtures with it that were left out.
    pub mixtures: usize,
    /// Their share in the sum of all squared colour errors, 0 to 1. A mixture counts for each of its
    /// pigments, so that the shares do not sum to 1.
    pub share: f64,
}

/// Settings of a validation: the fit, and the mixtures that are left out.
#[derive(Debug)]
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
    /// Told [`FitStage::LeftOut`] after each mixture, from any thread; may end the work.
    pub watch: Watch<'a>,
}

impl ValidationPlan<'_> {
    /// Fits of parts of `set` with these settings.
    pub(crate) fn refits<'a>(
        &'a self,
        set: &'a SwatchSet,
        observations: &'a [Observation],
        reference: PigmentId,
        surface: Surface,
    ) -> Refits<'a> {
        let settings = self.settings;
        let state = self.state;
        let watch = self.watch.quiet();
        Refits { set, observations, reference, surface, settings, state, watch }
    }

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
    let refits = plan.refits(set, &observations, reference, surface);
    let candidates: Vec<usize> = refits.mixtures().filter(|&i| chosen(&observations[i])).collect();
    let weights = plan.viewing.weights(set.grid).expect("the method fits the grid");
    let predict = |group: &Vec<usize>| -> Result<Vec<Prediction>, CalibrationError> {
        let refit = refits.without(group)?;
        let predictions = group.iter().map(|&index| {
            plan.watch.tell(FitStage::LeftOut);
            let target = &observations[index];
            let film = |strength: f64| refit.film(target, surface, strength);
            Prediction {
                index,
                predicted: refit.identifies(target).then(|| {
                    (
                        film(1.0),
                        Some(least_error(|strength: f64| {
                            delta_e(&weights, &target.as_read, &film(strength))
                        })),
                    )
                }),
            }
        });
        Ok(predictions.collect())
    };
    let predictions = plan.predictions(&candidates, predict)?;
    let found = predictions.iter().filter_map(|prediction| {
        Some((&observations[prediction.index], &prediction.predicted.as_ref()?.0))
    });
    let (mixtures, films): (Vec<&Observation>, Vec<LeftOutMixture>) =
        found.map(|(target, film)| (target, left_out_mixture(set, target, film))).unzip();
    let errors = summary(set, plan, predictions, |index: usize| {
        (observations[index].sample.clone(), observations[index].as_read.as_slice())
    });
    let by_pigment = by_pigment(set, &mixtures, &errors.per_sample);
    Ok(Validation { by_pigment, mixtures: films, ..errors })
}

/// Measured and predicted films of a mixture, both of which hide.
pub(crate) fn left_out_mixture(
    set: &SwatchSet,
    target: &Observation,
    predicted: &[f64],
) -> LeftOutMixture {
    let shares = set.pigments.iter().zip(&target.shares).filter(|(_, share)| **share > 0.0);
    LeftOutMixture {
        sample: target.sample.clone(),
        shares: shares.map(|(name, share)| (name.clone(), *share)).collect(),
        measured: target.reflectance.clone(),
        predicted: predicted.to_vec(),
    }
}

/// Factors of the strength that are tried, from 1/4 to 4, evenly spaced in their logarithm.
const STRENGTHS: i32 = 33;
/// Steps in which the best of them is refined, each of which halves the distance.
const HALVINGS: usize = 12;

/// Least `error` of any strength from 1/4 to 4.
fn least_error(error: impl Fn(f64) -> f64) -> f64 {
    let range = 4f64.ln();
    let at = |log: f64| (error(log.exp()), log);
    let nearer = |a: (f64, f64), b: (f64, f64)| if b.0 < a.0 { b } else { a };
    let last = f64::from(STRENGTHS - 1);
    let coarse = (0..STRENGTHS).map(|i| at(range * (2.0 * f64::from(i) / last - 1.0)));
    let mut best = coarse.reduce(nearer).expect("there are strengths");
    let mut step = range / last;
    for _ in 0..HALVINGS {
        best = [best.1 - step, best.1 + step].map(at).into_iter().fold(best, nearer);
        step /= 2.0;
    }
    best.0
}

/// Part of the errors in mixtures with each pigment.
fn by_pigment(
    set: &SwatchSet,
    mixtures: &[&Observation],
    errors: &[SampleEvidence],
) -> Vec<PigmentError> {
    let square = |error: &SampleEvidence| error.delta_e * error.delta_e;
    let total: f64 = errors.iter().map(square).sum();
    let all = set.pigments.iter().enumerate().map(|(index, name): (usize, &String)| {
        let pairs = mixtures.iter().zip(errors).filter(|(mixture, _)| mixture.shares[index] > 0.0);
        let (count, sum) =
            pairs.fold((0, 0.0), |(count, sum), (_, error)| (count + 1, sum + square(error)));
        let share = if total > 0.0 { sum / total } else { 0.0 };
        PigmentError { pigment: name.clone(), mixtures: count, share }
    });
    let mut found: Vec<PigmentError> = all.filter(|pigment| pigment.mixtures > 0).collect();
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
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
    let how = Refinement::prediction(plan.settings.smoothness, plan.state);
    let how = Refinement { watch: plan.watch.quiet(), ..how };
    let predict = |group: &Vec<usize>| -> Result<Vec<Prediction>, CalibrationError> {
        let part = problem.with_films(&all_but(count, group));
        let fit = fit_finite(&part, film, &weights, how)?;
        let predictions = group.iter().map(|&index| {
            plan.watch.tell(FitStage::LeftOut);
            Prediction { index, predicted: Some((problem.predicted(&fit, film, index), None)) }
        });
        Ok(predictions.collect())
    };
    let predictions = plan.predictions(&candidates, predict)?;
    Ok(summary(set, plan, predictions, |index: usize| {
        (problem.films[index].name.clone(), problem.films[index].reflectance.as_slice())
    }))
}

/// Prediction of a left-out sample; `None` if a pigment would not be identified without it.
struct Prediction {
    index: usize,
    /// Predicted reflectance, and the colour error that remains if the strength is free.
    predicted: Option<(Vec<f64>, Option<f64>)>,
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
    let mut strength_free = Vec::new();
    for Prediction { index, predicted } in predictions {
        let (name, measured) = sample(index);
        match predicted {
            Some((predicted, free)) => {
                films.push((name, measured, predicted));
                strength_free.extend(free);
            }
            None => needed.push(name),
        }
    }
    let Scores { rms, delta_e, per_sample } = Scores::of(&weights, films);
    let strength_free = (!strength_free.is_empty()).then(|| Summary::of(&strength_free));
    Validation {
        rms,
        delta_e,
        per_sample,
        needed,
        strength_free,
        by_pigment: Vec::new(),
        mixtures: Vec::new(),
    }
}
