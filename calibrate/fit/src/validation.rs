//! Validation of a fit: each mixture is predicted by a fit without its own measurement.
//!
//! We also compute here the fits without some of the samples, their errors, and these errors as JSON.

use std::collections::BTreeSet;

use documents::Task;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Map, Value, json};
use spectra::Grid;
use spectra::optics::{Surface, UnevenFilm};

use crate::absolute::{all_but, films, folds};
use crate::calibration::{CalibrationError, pigment, solve, without};
use crate::fit::{
    FitError, FitSettings, MeasuredFilm, Problem, RefinedState, Refinement, Unidentified,
    fit_finite, unidentified,
};
use crate::fitting::{FilmModel, Fit, FittingError, PreparedFit, index_of};
use crate::leave_out::{Candidate, LeaveOut, is_mixture};
use crate::observation::{Observation, observations};
use crate::readings::Readings;
use crate::report::{ErrorReport, Scores, shares_of_squares};
use crate::request::ValidationRequest;
use crate::residuals::{LeftOutMixture, Residuals};
use crate::strength::{Mixed, StrengthChange, Strengths};
use crate::swatch::SwatchSet;
use pigment::evaluate::{Summary, Viewing};
use pigment::library::{AmountKind, Evidence, PigmentLibrary, SampleEvidence};
use pigment::{Curves, PigmentId};

/// We leave out this many groups in turn for absolute amounts, where each film by itself would take too
/// long (chosen by eye).
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
    /// Summary of the colour errors that remain if, in each mixture, one common factor for all
    /// pigments except the white may be chosen freely (or except the main one, if there is no white).
    /// These are the errors that do not come from tinting strength. `None` for absolute amounts.
    pub strength_free: Option<Summary>,
    /// Factors of the strength that mixtures of a file have in common. Empty for absolute amounts.
    pub strengths: Vec<StrengthChange>,
    /// Pigments by their part of the error, the greatest first. Empty for absolute amounts.
    pub by_pigment: Vec<PigmentError>,
    /// Measured and predicted films of the mixtures. Empty for absolute amounts, because their films do not
    /// hide.
    #[serde(skip)]
    pub mixtures: Vec<LeftOutMixture>,
}

/// How much of the error of a validation comes from mixtures with one pigment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PigmentError {
    /// Name of the pigment.
    pub pigment: String,
    /// Number of mixtures with it that were left out.
    pub mixtures: usize,
    /// Share of these mixtures in the sum of all squared colour errors, 0 to 1. A mixture counts for each
    /// of its pigments, so the shares do not sum to 1.
    pub share: f64,
}

/// Stage of a validation, reported after each mixture.
const LEFT_OUT: &str = "mixture left out";

/// Settings of a validation: the fit, and the mixtures that are left out.
#[derive(Debug)]
pub struct ValidationPlan<'a> {
    /// Settings of the fits.
    pub settings: &'a FitSettings,
    /// Light and observer of the colour errors.
    pub viewing: &'a Viewing,
    /// Estimates from the fit of all samples, which are reused rather than estimated in each fit. On the
    /// Van Gogh oils this changes the mean error by 0.004 CIEDE2000.
    pub state: Option<RefinedState>,
    /// Samples that are left out at a time.
    pub leave_out: LeaveOut,
    /// Number of groups into which we deal what would be left out at a time, at random (the same every
    /// time), to leave out one group at a time instead.
    pub folds: Option<usize>,
    /// Counts the samples that were left out.
    pub task: &'a Task,
}

impl ValidationPlan<'_> {
    pub(crate) fn refits<'a>(
        &'a self,
        set: &'a SwatchSet,
        observations: &'a [Observation],
        reference: PigmentId,
        surface: Surface,
    ) -> Refits<'a> {
        let settings = self.settings;
        let state = self.state;
        let task = self.task.quiet();
        Refits { set, observations, reference, surface, settings, state, task }
    }

    /// Indices of the films that are left out together.
    fn groups<'a>(
        &self,
        candidates: impl Iterator<Item = Candidate<'a>>,
        pigments: &'a [String],
    ) -> Vec<Vec<usize>> {
        let groups = self.leave_out.groups(candidates, pigments);
        let Some(count) = self.folds else { return groups };
        let dealt = folds(groups.len(), count);
        dealt
            .into_iter()
            .map(|fold| fold.iter().flat_map(|&i| groups[i].clone()).collect())
            .collect()
    }

    /// Predictions of each group left out, on all cores, in order of the file.
    fn predictions<'a>(
        &self,
        groups: &[Vec<usize>],
        predict: impl Fn(&Vec<usize>) -> Result<Vec<Prediction<'a>>, CalibrationError> + Sync,
    ) -> Result<Vec<Prediction<'a>>, CalibrationError> {
        let predicted = groups.par_iter().map(&predict).collect::<Result<Vec<_>, _>>()?;
        let mut predictions: Vec<Prediction<'a>> = predicted.into_iter().flatten().collect();
        predictions.sort_by_key(|prediction| prediction.index);
        Ok(predictions)
    }
}

/// Refits without the samples that `plan` leaves out and `chosen` selects, on all cores, and predicts them
/// as films that hide.
///
/// # Errors
/// [`CalibrationError`] from reading or from any fit.
pub fn leave_out_samples(
    set: &SwatchSet,
    reference: PigmentId,
    surface: Surface,
    plan: &ValidationPlan<'_>,
    chosen: impl Fn(&Observation) -> bool,
) -> Result<Validation, CalibrationError> {
    let observations = observations(set, surface, plan.settings.below_surface)?;
    let refits = plan.refits(set, &observations, reference, surface);
    let candidates = refits.identified().filter(|&index| chosen(&observations[index]));
    let candidates =
        candidates.map(|index| Candidate { index, swatch: &set.swatches[index], ground: "" });
    let groups = plan.groups(candidates, &set.pigments);
    let weights = plan.viewing.weights(set.grid).expect("the method fits the grid");
    let strengths = Strengths { grid: set.grid, surface, weights: &weights };
    let left_out = plan.task.steps_of(LEFT_OUT, groups.iter().map(Vec::len).sum());
    let predictions = plan.predictions(&groups, |group| {
        let refit = match refits.without(group) {
            Err(CalibrationError::Fit(FitError::Empty | FitError::Reference)) => None,
            other => Some(other?),
        };
        let predictions = group.iter().map(|&index| {
            left_out.step();
            let target = &observations[index];
            let refit = refit.as_ref().filter(|refit| refit.identifies(target));
            let predicted = refit.map(|refit| {
                let mixed = refit.mixed(target, reference, &set.swatches[index].file);
                let film = strengths.film(&mixed);
                let is_mixture = mixed.parts.len() > 1;
                let strength_free = is_mixture.then(|| strengths.least_error(&mixed));
                Predicted { film, strength_free, mixed: is_mixture.then_some(mixed) }
            });
            Prediction { index, predicted }
        });
        Ok(predictions.collect())
    })?;
    let found = predictions.iter().filter_map(|prediction: &Prediction<'_>| {
        Some((&observations[prediction.index], &prediction.predicted.as_ref()?.film))
    });
    let (mixtures, films): (Vec<&Observation>, Vec<LeftOutMixture>) =
        found.map(|(target, film)| (target, left_out_mixture(set, target, film))).unzip();
    let mixed = predictions
        .iter()
        .filter_map(|prediction: &Prediction<'_>| prediction.predicted.as_ref()?.mixed.as_ref());
    let changes = strengths.changes(&mixed.collect::<Vec<_>>(), &set.pigments, reference);
    let errors = summary(set, plan, predictions, |index: usize| {
        (observations[index].sample.clone(), observations[index].as_read.as_slice())
    });
    let by_pigment = by_pigment(set, &mixtures, &errors.per_sample);
    Ok(Validation { strengths: changes, by_pigment, mixtures: films, ..errors })
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

/// How much of the error comes from mixtures with each pigment.
fn by_pigment(
    set: &SwatchSet,
    mixtures: &[&Observation],
    errors: &[SampleEvidence],
) -> Vec<PigmentError> {
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

fn square(error: &SampleEvidence) -> f64 {
    error.delta_e * error.delta_e
}

/// Refits without the films that `plan` leaves out, for absolute amounts, and predicts them.
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
    let candidates =
        problem.films.iter().enumerate().map(|(index, film): (usize, &MeasuredFilm)| Candidate {
            index,
            swatch: &set.swatches[film.swatch],
            ground: &film.backing,
        });
    let groups = plan.groups(candidates, &set.pigments);
    let how = Refinement::prediction(plan.settings.smoothness, plan.state);
    let task = plan.task.quiet();
    let left_out = plan.task.steps_of(LEFT_OUT, groups.iter().map(Vec::len).sum());
    let predictions = plan.predictions(&groups, |group| {
        let part = problem.with_films(&all_but(count, group));
        let known: BTreeSet<PigmentId> =
            part.films.iter().flat_map(|film| film.recipe.pigments()).collect();
        // Without any film of a pigment there is nothing to predict it from.
        let fit = if part.films.is_empty() {
            None
        } else {
            Some(fit_finite(&part, film, &weights, how, &task)?)
        };
        let predictions = group.iter().map(|&index| {
            left_out.step();
            let is_known = problem.films[index].recipe.pigments().all(|p| known.contains(&p));
            let fit = fit.as_ref().filter(|_| is_known);
            let predicted = fit.map(|fit| Predicted {
                film: problem.predicted(fit, film, index),
                strength_free: None,
                mixed: None,
            });
            Prediction { index, predicted }
        });
        Ok(predictions.collect())
    })?;
    Ok(summary(set, plan, predictions, |index: usize| {
        (problem.films[index].name.clone(), problem.films[index].reflectance.as_slice())
    }))
}

/// Prediction of a left-out film, or `None` if a pigment would not be identified without it.
struct Prediction<'a> {
    index: usize,
    predicted: Option<Predicted<'a>>,
}

struct Predicted<'a> {
    film: Vec<f64>,
    /// Colour error that remains if the strength of the mixture is free.
    strength_free: Option<f64>,
    /// The mixture, if its strength can differ.
    mixed: Option<Mixed<'a>>,
}

fn summary<'a>(
    set: &SwatchSet,
    plan: &ValidationPlan<'_>,
    predictions: Vec<Prediction<'_>>,
    sample: impl Fn(usize) -> (String, &'a [f64]),
) -> Validation {
    let weights = plan.viewing.weights(set.grid).expect("the method fits the grid");
    let mut films = Vec::new();
    let mut needed = Vec::new();
    let mut strength_free = Vec::new();
    for Prediction { index, predicted } in predictions {
        let (name, measured) = sample(index);
        match predicted {
            Some(predicted) => {
                films.push((name, measured, predicted.film));
                strength_free.extend(predicted.strength_free);
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
        strengths: Vec::new(),
        by_pigment: Vec::new(),
        mixtures: Vec::new(),
    }
}

/// Data that all fits without some of the samples share.
pub(crate) struct Refits<'a> {
    pub(crate) set: &'a SwatchSet,
    pub(crate) observations: &'a [Observation],
    pub(crate) reference: PigmentId,
    pub(crate) surface: Surface,
    pub(crate) settings: &'a FitSettings,
    pub(crate) state: Option<RefinedState>,
    pub(crate) task: Task,
}

pub(crate) struct Refit {
    grid: Grid,
    curves: Vec<Curves>,
    /// For each of `curves`, index of its pigment in the set.
    identified: Vec<PigmentId>,
    unknown: Vec<Unidentified>,
}

impl Refits<'_> {
    /// Samples with pigments that the full fit identifies.
    fn identified(&self) -> impl Iterator<Item = usize> {
        let shares = self.observations.iter().map(|o| o.shares.as_slice());
        let unknown = unidentified(shares, self.reference);
        (0..self.observations.len()).filter(move |&i| {
            unknown.iter().all(|u| self.observations[i].shares[u.pigment.index()] == 0.0)
        })
    }

    /// Mixtures that can be left out. They have two pigments or more, and the full fit identifies all of
    /// these.
    pub(crate) fn mixtures(&self) -> impl Iterator<Item = usize> {
        self.identified().filter(|&index| is_mixture(&self.observations[index].shares))
    }

    pub(crate) fn without(&self, group: &[usize]) -> Result<Refit, CalibrationError> {
        let rest: Vec<Observation> = all_but(self.observations.len(), group)
            .iter()
            .map(|&i| self.observations[i].clone())
            .collect();
        let unknown = unidentified(rest.iter().map(|o| o.shares.as_slice()), self.reference);
        let (solvable, identified) = without(&rest, &unknown);
        let among =
            identified.iter().position(|&p| p == self.reference).ok_or(FitError::Reference)?;
        let problem = Problem::new(self.set.grid, self.surface, &solvable, PigmentId(among))?;
        let how = Refinement::prediction(self.settings.smoothness, self.state);
        let curves = solve(&problem, self.settings.method, how, &self.task)?.curves;
        Ok(Refit { grid: self.set.grid, curves, identified, unknown })
    }

    /// Library of a fit of this set. Title, licence, source and evidence are empty.
    pub(crate) fn library(&self, refit: &Refit) -> PigmentLibrary {
        let names = &self.set.pigments;
        let pigments = refit.identified.iter().zip(&refit.curves);
        let pigments = pigments.map(|(id, curves)| pigment(&names[id.index()], curves, None));
        PigmentLibrary {
            reference: Some(names[self.reference.index()].clone()),
            settings: Some(self.settings.clone()),
            pigments: pigments.collect(),
            ..PigmentLibrary::empty(self.set.grid, self.surface)
        }
    }
}

impl Refit {
    /// Whether K and S of every pigment of `target` are known.
    pub(crate) fn identifies(&self, target: &Observation) -> bool {
        self.unknown.iter().all(|u| target.shares[u.pigment.index()] == 0.0)
    }

    /// The parts of `target`, a sample of `file`.
    fn mixed<'a>(&self, target: &'a Observation, white: PigmentId, file: &'a str) -> Mixed<'a> {
        let parts = self.identified.iter().zip(&self.curves).filter_map(|(&pigment, curves)| {
            let share = target.shares[pigment.index()];
            (share > 0.0).then(|| (pigment, share, curves.clone()))
        });
        let parts: Vec<(PigmentId, f64, Curves)> = parts.collect();
        // The first of equal shares.
        let main = parts.iter().rev().max_by(|a, b| a.1.total_cmp(&b.1));
        let with_white = parts.iter().find(|(pigment, _, _)| *pigment == white);
        let base = with_white.or(main).map_or(white, |(pigment, _, _)| *pigment);
        Mixed { file, measured: &target.as_read, base, parts }
    }

    /// Predicted reflectance of `target` in a film that hides.
    pub(crate) fn film(&self, target: &Observation, surface: Surface) -> Vec<f64> {
        let parts = self.identified.iter().zip(&self.curves).map(|(pigment, curves)| {
            let (absorption, scattering) = curves.as_slices();
            (target.shares[pigment.index()], absorption, scattering)
        });
        Curves::weighted_sum(self.grid, parts).hiding(surface)
    }
}

/// A report names this many pigments for their part of the error.
const NAMED_PIGMENTS: usize = 4;

/// A measured mixture, and a library that was fitted to all other samples.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// Measured and predicted film of the mixture.
    pub mixture: LeftOutMixture,
    /// Library of the other samples.
    pub library: PigmentLibrary,
}

/// Errors of mixtures that were predicted without their own measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct FitValidation {
    /// Errors of the mixtures that were left out.
    pub errors: Validation,
    /// Fit of all samples.
    pub fit: Fit,
    /// Samples that were left out at a time.
    pub leave_out: LeaveOut,
    /// Number of groups that were left out in turn, or `None` for each mixture by itself.
    pub folds: Option<usize>,
    viewing: Viewing,
}

impl FitValidation {
    /// Report of the colour errors of all mixtures.
    #[must_use]
    pub fn report(&self) -> ErrorReport<'_> {
        let Validation { rms, delta_e, per_sample, .. } = &self.errors;
        let count = per_sample.len();
        let manner = match self.folds {
            Some(folds) => format!("in {}", documents::counted(folds.min(count), "group")),
            None => self.leave_out.manner().to_owned(),
        };
        let light = [self.viewing.illuminant.name(), self.viewing.observer.name()];
        let title =
            format!("{}, left out {manner}", documents::counted(count, self.leave_out.noun()));
        ErrorReport::new(title, delta_e, *rms, light, per_sample).with_lines(self.findings())
    }

    /// Measured and predicted films of the mixtures that were left out, rounded as in their file. Pigment
    /// maps learn from these how far the library's predictions err.
    ///
    /// # Errors
    /// [`FittingError::AbsoluteResiduals`] for absolute amounts, because their films do not hide, and
    /// [`FittingError::ResidualsOfMixtures`] if something else than each mixture was left out.
    pub fn residuals(&self) -> Result<Residuals, FittingError> {
        let library = &self.fit.library;
        if library.amounts == AmountKind::Absolute {
            return Err(FittingError::AbsoluteResiduals);
        }
        if self.leave_out != LeaveOut::Mixture {
            return Err(FittingError::ResidualsOfMixtures);
        }
        let residuals = Residuals {
            grid: library.grid,
            saunderson: library.saunderson,
            settings: library.settings.clone().unwrap_or_default(),
            folds: self.folds,
            inputs: library.inputs.clone(),
            mixtures: self.errors.mixtures.clone(),
        };
        Ok(residuals.rounded())
    }

    /// Sentences about the pigments with the largest errors, the error that remains with free tinting
    /// strength, and strengths that mixtures have in common.
    fn findings(&self) -> Vec<String> {
        let pigments: Vec<String> = (self.errors.by_pigment.iter().take(NAMED_PIGMENTS))
            .map(|p| format!("{} {:.0} % in {}", p.pigment, 100.0 * p.share, p.mixtures))
            .collect();
        let by_pigment = (!pigments.is_empty())
            .then(|| format!("by pigment, in number of mixtures: {}", pigments.join(", ")));
        let strength = self.errors.strength_free.map(|free| {
            format!("with the strength of each mixture free the mean would be {:.2}", free.mean)
        });
        let common = self.errors.strengths.iter().map(|change| format!("strength: {change}"));
        by_pigment.into_iter().chain(strength).chain(common).collect()
    }

    /// Names the mixtures that could not be left out.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        self.errors
            .needed
            .iter()
            .map(|sample: &String| {
                format!("{sample}: not left out, a pigment would not be identified without it")
            })
            .collect()
    }
}

/// Leaves each mixture of two pigments or more out in turn, fits the rest, and predicts it. This shows you
/// the error of mixtures that a fit has not seen.
///
/// ```no_run
/// use calibrate::{Readings, ValidationRequest};
///
/// let readings = Readings::open("swatches.csv")?;
/// let validation = calibrate::validate(&readings, &ValidationRequest::default())?;
/// println!("{}", validation.report());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FittingError`] as for [`crate::fit()`], or if no mixture can be left out.
pub fn validate(
    readings: &Readings,
    options: &ValidationRequest,
) -> Result<FitValidation, FittingError> {
    options.run(readings, &Task::default())
}

impl ValidationRequest {
    /// Predicts each mixture without its own measurement. You see the stages of the first fit in
    /// `task`, then each mixture, and may cancel it.
    ///
    /// # Errors
    /// [`FittingError`] as for [`validate`], or if `task` was cancelled.
    pub fn run(&self, readings: &Readings, task: &Task) -> Result<FitValidation, FittingError> {
        PreparedFit::new(readings, &self.fit, task)?.validate(self, task)
    }
}

impl PreparedFit {
    /// Number of samples that [`Self::validate`] leaves out at most.
    ///
    /// # Errors
    /// [`FittingError`] if a name of `options` is unknown, or options exclude each other.
    pub fn mixtures(&self, options: &ValidationRequest) -> Result<usize, FittingError> {
        let chosen = self.chosen(options)?;
        let leave_out = self.leave_out(options)?;
        let swatches = self.set.swatches.iter().filter(|swatch| chosen.selects(&swatch.amounts));
        Ok(swatches.filter(|swatch| leave_out.selects(&swatch.amounts)).count())
    }

    /// Samples that a validation with these options leaves out at a time.
    fn leave_out(&self, options: &ValidationRequest) -> Result<LeaveOut, FittingError> {
        if options.leave_out == Some(LeaveOut::Ground)
            && !matches!(self.model, FilmModel::Absolute(_))
        {
            return Err(FittingError::RelativeGround);
        }
        let files: BTreeSet<&str> = self.set.swatches.iter().map(|s| &*s.file).collect();
        if options.leave_out == Some(LeaveOut::File) && files.len() < 2 {
            return Err(FittingError::OneFile(files.first().map_or("", |file| *file).to_owned()));
        }
        Ok(options.leave_out.unwrap_or_else(|| LeaveOut::usual(&self.set)))
    }

    /// Validates like [`validate`], with these readings and fit options. Use `task` to follow the stages of
    /// the first fit and the mixtures that were left out.
    ///
    /// # Errors
    /// [`FittingError`] if a name is unknown, a fit fails or is ended, or no mixture can be left out.
    pub fn validate(
        &self,
        options: &ValidationRequest,
        task: &Task,
    ) -> Result<FitValidation, FittingError> {
        self.validate_fit(self.fit(task)?, options, task)
    }

    /// Validates like [`Self::validate`]. Use this if you have `fit`, the fit of all samples by
    /// [`Self::fit`], already.
    ///
    /// # Errors
    /// [`FittingError`] if a name is unknown, a fit fails or is ended, or no mixture can be left out.
    pub fn validate_fit(
        &self,
        fit: Fit,
        options: &ValidationRequest,
        task: &Task,
    ) -> Result<FitValidation, FittingError> {
        if let Some(folds) = options.folds.filter(|folds| *folds < 2) {
            return Err(FittingError::Folds(folds));
        }
        let chosen = self.chosen(options)?;
        let leave_out = self.leave_out(options)?;
        let is_long = matches!(self.model, FilmModel::Absolute(_)) && leave_out.is_single();
        let folds = options.folds.or(is_long.then_some(DEFAULT_FOLDS));
        let viewing = self.viewing().clone();
        let plan = ValidationPlan {
            settings: &self.settings,
            viewing: &viewing,
            state: fit.state,
            leave_out,
            folds,
            task,
        };
        let errors = match self.model {
            FilmModel::Relative { reference, surface } => {
                leave_out_samples(&self.set, reference, surface, &plan, |o: &Observation| {
                    chosen.selects(&o.shares)
                })?
            }
            FilmModel::Absolute(film) => leave_out_films(&self.set, film, &plan)?,
        };
        if errors.per_sample.is_empty() {
            let what = leave_out.noun();
            return Err(FittingError::NothingToLeaveOut { what, needed: errors.needed });
        }
        Ok(FitValidation { errors, fit, leave_out, folds, viewing })
    }

    /// Leaves out each mixture of two pigments or more in turn, on all cores, like [`Self::validate`], and
    /// returns the library of each fit. We pass over a mixture if we could not fit the rest or identify
    /// every pigment without it. We also pass over films of absolute amounts, because they do not hide.
    /// `task` counts the mixtures that were left out.
    ///
    /// # Errors
    /// [`FittingError`] if readings cannot be used, the fit of all samples fails, or the work was cancelled.
    pub fn left_out(&self, task: &Task) -> Result<Vec<LeftOut>, FittingError> {
        let FilmModel::Relative { reference, surface } = self.model else {
            return Ok(Vec::new());
        };
        let set = &self.set;
        let settings = &self.settings;
        let observations = observations(set, surface, settings.below_surface);
        let observations = observations.map_err(CalibrationError::from)?;
        let state = self.fit(&task.quiet())?.state;
        let viewing = self.viewing();
        let leave_out = LeaveOut::Mixture;
        let plan = ValidationPlan { settings, viewing, state, leave_out, folds: None, task };
        let refits = plan.refits(set, &observations, reference, surface);
        let mixtures: Vec<usize> = refits.mixtures().collect();
        let steps = task.steps_of(LEFT_OUT, mixtures.len());
        let found = mixtures.par_iter().map(|&index| -> Result<Option<LeftOut>, FittingError> {
            let target = &observations[index];
            let refit = refits.without(&[index]);
            steps.step();
            let refit = match refit {
                Err(CalibrationError::Fit(error)) if !matches!(error, FitError::Cancelled(_)) => {
                    return Ok(None);
                }
                other => other?,
            };
            Ok(refit.identifies(target).then(|| LeftOut {
                mixture: left_out_mixture(set, target, &refit.film(target, surface)),
                library: refits.library(&refit),
            }))
        });
        let found = found.collect::<Result<Vec<_>, _>>()?;
        Ok(found.into_iter().flatten().collect())
    }

    /// One half of the readings, ready to be fitted. You get all samples of a single pigment, and every
    /// second mixture, beginning with mixture `half` (0 or 1).
    #[must_use]
    pub fn half(&self, half: usize) -> Self {
        let mixtures: Vec<&str> = (self.set.swatches.iter())
            .filter(|swatch| swatch.shares.iter().filter(|share| **share > 0.0).count() > 1)
            .map(|swatch| swatch.sample.as_str())
            .collect();
        let out: Vec<&str> = mixtures.iter().copied().skip(1 - half % 2).step_by(2).collect();
        let mut part = self.clone();
        part.set = self.set.retaining(|swatch| !out.contains(&swatch.sample.as_str()));
        if let FilmModel::Relative { reference, .. } = &mut part.model {
            let white = &self.set.pigments[reference.index()];
            let place = part.set.pigments.iter().position(|name| name == white);
            *reference = PigmentId(place.unwrap_or(reference.index()));
        }
        part
    }

    fn chosen(&self, options: &ValidationRequest) -> Result<ChosenPigments, FittingError> {
        if !options.with.is_empty() && matches!(self.model, FilmModel::Absolute(_)) {
            return Err(FittingError::AbsoluteWith);
        }
        let with = options.with.iter().map(|name| index_of(&self.set.pigments, name, "pigment"));
        with.collect::<Result<_, _>>().map(ChosenPigments)
    }
}

/// A mixture must contain one of these pigments. If the list is empty, every mixture will do.
struct ChosenPigments(Vec<usize>);

impl ChosenPigments {
    fn selects(&self, amounts: &[f64]) -> bool {
        self.0.is_empty() || self.0.iter().any(|&pigment| amounts[pigment] > 0.0)
    }
}

impl Fit {
    /// Errors of the fit as JSON: `samples` and `pigments` as numbers, `rms`, `delta_e`, `per_sample`,
    /// `shares_of_squares` of the colour errors with the greatest first, `warnings`.
    #[must_use]
    pub fn errors_json(&self) -> Map<String, Value> {
        let Evidence { rms, delta_e, per_sample, warnings, .. } = self.evidence();
        errors_json(self.library.pigments.len(), *rms, delta_e, per_sample, warnings)
    }
}

impl FitValidation {
    /// Errors of the mixtures that were left out, with the keys of [`Fit::errors_json`].
    #[must_use]
    pub fn errors_json(&self) -> Map<String, Value> {
        let pigments = self.fit.library.pigments.len();
        let errors = &self.errors;
        errors_json(pigments, errors.rms, &errors.delta_e, &errors.per_sample, &self.warnings())
    }
}

fn errors_json(
    pigments: usize,
    rms: f64,
    delta_e: &Summary,
    per_sample: &[SampleEvidence],
    warnings: &[String],
) -> Map<String, Value> {
    let shares = shares_of_squares(per_sample)
        .into_iter()
        .map(|(sample, share): (&str, f64)| json!({ "sample": sample, "share": share }));
    let pairs = [
        ("samples", json!(per_sample.len())),
        ("pigments", json!(pigments)),
        ("rms", json!(rms)),
        ("delta_e", json!(delta_e)),
        ("per_sample", json!(per_sample)),
        ("shares_of_squares", shares.collect()),
        ("warnings", json!(warnings)),
    ];
    pairs.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}
