//! Validation of a fit from readings: each mixture predicted without its own measurement.

use crate::calibration::CalibrationError;
use crate::fit::{FitError, FitStage, Watch};
use crate::fitting::{FilmModel, Fit, FitOptions, PreparedFit, index_of};
use crate::fitting_error::FittingError;
use crate::observation::{Observation, observations};
use crate::readings::Readings;
use crate::report::ErrorReport;
use crate::residuals::{LeftOutMixture, Residuals};
use crate::validation::{
    DEFAULT_FOLDS, Validation, ValidationPlan, leave_out, leave_out_films, left_out_mixture,
};
use pigment::PigmentId;
use pigment::evaluate::Viewing;
use pigment::library::{AmountKind, PigmentLibrary};
use rayon::prelude::*;

/// Pigments that a report names for their part of the error.
const NAMED_PIGMENTS: usize = 4;

/// Options of [`validate`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ValidationOptions {
    /// Options of the fits.
    pub fit: FitOptions,
    /// Number of seeded groups that are left out in turn, 2 and up. Default: each mixture by itself;
    /// for absolute amounts 10 groups.
    pub folds: Option<usize>,
    /// Names of pigments; only mixtures with one of them are left out. Default: all mixtures.
    pub with: Vec<String>,
}

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
    /// Number of groups that were left out in turn; `None` for each mixture by itself.
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
            None => "one by one".to_owned(),
        };
        let light = [self.viewing.illuminant.name(), self.viewing.observer.name()];
        let title = format!("{}, left out {manner}", documents::counted(count, "mixture"));
        ErrorReport::new(title, delta_e, *rms, light, per_sample).with_lines(self.findings())
    }

    /// Measured and predicted films of the mixtures that were left out, rounded as their file has them: by
    /// these, pigment maps know how far the library's predictions err.
    ///
    /// # Errors
    /// [`FittingError::AbsoluteResiduals`] for absolute amounts, whose films do not hide.
    pub fn residuals(&self) -> Result<Residuals, FittingError> {
        let library = &self.fit.library;
        if library.amounts == AmountKind::Absolute {
            return Err(FittingError::AbsoluteResiduals);
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

    /// Which pigments carry the error, and how much of it is strength.
    fn findings(&self) -> Vec<String> {
        let pigments: Vec<String> = (self.errors.by_pigment.iter().take(NAMED_PIGMENTS))
            .map(|p| format!("{} {:.0} % in {}", p.pigment, 100.0 * p.share, p.mixtures))
            .collect();
        let by_pigment = (!pigments.is_empty())
            .then(|| format!("by pigment, in number of mixtures: {}", pigments.join(", ")));
        let strength = self.errors.strength_free.map(|free| {
            format!("with the strength of each mixture free the mean would be {:.2}", free.mean)
        });
        by_pigment.into_iter().chain(strength).collect()
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

/// Leaves each mixture of two pigments or more out in turn, fits the rest, and predicts it: the error of
/// mixtures that a fit has not seen.
///
/// ```no_run
/// use calibrate::{Readings, ValidationOptions};
///
/// let readings = Readings::open("swatches.csv")?;
/// let validation = calibrate::validate(&readings, &ValidationOptions::default())?;
/// println!("{}", validation.report());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FittingError`] as for [`crate::fit()`], or if no mixture can be left out.
pub fn validate(
    readings: &Readings,
    options: &ValidationOptions,
) -> Result<FitValidation, FittingError> {
    let prepared = PreparedFit::new(readings, &options.fit, Watch::default())?;
    prepared.validate(options, Watch::default())
}

impl PreparedFit {
    /// Number of mixtures that [`Self::validate`] leaves out at most.
    ///
    /// # Errors
    /// [`FittingError`] if a name of `options` is unknown, or options exclude each other.
    pub fn mixtures(&self, options: &ValidationOptions) -> Result<usize, FittingError> {
        let chosen = self.chosen(options)?;
        let is_mixture = |amounts: &[f64]| amounts.iter().filter(|a| **a > 0.0).count() > 1;
        let amounts = self.set.swatches.iter().map(|swatch| swatch.amounts.as_slice());
        Ok(amounts.filter(|amounts| is_mixture(amounts) && chosen.selects(amounts)).count())
    }

    /// Validates like [`validate`], with these readings and fit options. `watch` is told the stages of the
    /// first fit and [`FitStage::LeftOut`] after each mixture, and may end the work.
    ///
    /// # Errors
    /// [`FittingError`] if a name is unknown, a fit fails or is ended, or no mixture can be left out.
    pub fn validate(
        &self,
        options: &ValidationOptions,
        watch: Watch<'_>,
    ) -> Result<FitValidation, FittingError> {
        self.validate_fit(self.fit_watched(watch)?, options, watch)
    }

    /// Validates like [`Self::validate`], where `fit` is the fit of all samples that [`Self::fit`] made.
    ///
    /// # Errors
    /// [`FittingError`] if a name is unknown, a fit fails or is ended, or no mixture can be left out.
    pub fn validate_fit(
        &self,
        fit: Fit,
        options: &ValidationOptions,
        watch: Watch<'_>,
    ) -> Result<FitValidation, FittingError> {
        if let Some(folds) = options.folds.filter(|folds| *folds < 2) {
            return Err(FittingError::Folds { folds });
        }
        let chosen = self.chosen(options)?;
        let folds = match self.model {
            FilmModel::Relative { .. } => options.folds,
            FilmModel::Absolute(_) => options.folds.or(Some(DEFAULT_FOLDS)),
        };
        let viewing = self.viewing().clone();
        let plan = ValidationPlan {
            settings: &self.settings,
            viewing: &viewing,
            state: fit.state,
            folds,
            watch,
        };
        let errors = match self.model {
            FilmModel::Relative { reference, surface } => {
                leave_out(&self.set, reference, surface, &plan, |o: &Observation| {
                    chosen.selects(&o.shares)
                })?
            }
            FilmModel::Absolute(film) => leave_out_films(&self.set, film, &plan)?,
        };
        if errors.per_sample.is_empty() {
            return Err(FittingError::NothingToLeaveOut { needed: errors.needed });
        }
        Ok(FitValidation { errors, fit, folds, viewing })
    }

    /// Leaves out each mixture of two pigments or more in turn, on all cores, like [`Self::validate`], and
    /// returns the library of each fit. Mixtures without which the rest cannot be fitted, or a pigment would
    /// not be identified, are passed over, as are films of absolute amounts, which do not hide. `watch` is told
    /// [`FitStage::LeftOut`] after each, from any thread.
    ///
    /// # Errors
    /// [`FittingError`] if readings cannot be used, the fit of all samples fails, or the work was cancelled.
    pub fn left_out(&self, watch: Watch<'_>) -> Result<Vec<LeftOut>, FittingError> {
        let FilmModel::Relative { reference, surface } = self.model else {
            return Ok(Vec::new());
        };
        let set = &self.set;
        let settings = &self.settings;
        let observations = observations(set, surface, settings.below_surface);
        let observations = observations.map_err(CalibrationError::from)?;
        let state = self.fit_watched(watch.quiet())?.state;
        let viewing = self.viewing();
        let plan = ValidationPlan { settings, viewing, state, folds: None, watch };
        let refits = plan.refits(set, &observations, reference, surface);
        let mixtures: Vec<usize> = refits.mixtures().collect();
        let left_out = |&index: &usize| -> Result<Option<LeftOut>, FittingError> {
            let target = &observations[index];
            let refit = refits.without(&[index]);
            watch.tell(FitStage::LeftOut);
            let refit = match refit {
                Err(CalibrationError::Fit(error)) if !matches!(error, FitError::Cancelled(_)) => {
                    return Ok(None);
                }
                other => other?,
            };
            Ok(refit.identifies(target).then(|| LeftOut {
                mixture: left_out_mixture(set, target, &refit.film(target, surface, 1.0)),
                library: refits.library(&refit),
            }))
        };
        let found = mixtures.par_iter().map(left_out).collect::<Result<Vec<_>, _>>()?;
        Ok(found.into_iter().flatten().collect())
    }

    /// One half of the readings, ready to be fitted: all films of one pigment, and every second mixture,
    /// from mixture `half` (0 or 1) on.
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

    fn chosen(&self, options: &ValidationOptions) -> Result<ChosenPigments, FittingError> {
        if !options.with.is_empty() && matches!(self.model, FilmModel::Absolute(_)) {
            return Err(FittingError::AbsoluteWith);
        }
        let with = options.with.iter().map(|name| index_of(&self.set.pigments, name, "pigment"));
        with.collect::<Result<_, _>>().map(ChosenPigments)
    }
}

/// Pigments of which a mixture must contain one; none for every mixture.
struct ChosenPigments(Vec<usize>);

impl ChosenPigments {
    fn selects(&self, amounts: &[f64]) -> bool {
        self.0.is_empty() || self.0.iter().any(|&pigment| amounts[pigment] > 0.0)
    }
}
