//! `impasto validate`: measures how well mixtures outside the fit are predicted.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use calibrate::library::AmountKind;
use calibrate::remark::Remark;
use calibrate::{FittingError, LeaveOut, ValidationRequest};
use clap::{Arg, Args};
use serde_json::json;

use super::fit;
use super::fit::{CalibrationOptions, fit_of_all, prepare_fit};
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::Output;
use crate::progress::Progress;
use crate::readings::ViewingOptions;
use crate::request_options::{CommandLine, RequestOptions};

/// Leave each mixture out in turn, refit, and predict it
///
/// Measures the error of a calibration on mixtures that it was not fitted to. With --leave-out you
/// leave out masstones too, all films over a ground, all samples of one pigment, or a whole file. A
/// sample without which a pigment could not be identified is named and not counted.
#[derive(Debug, Args)]
pub(crate) struct Validate {
    #[command(flatten)]
    options: CalibrationOptions,
    #[command(flatten)]
    validation: RequestOptions<ValidationRequest>,
    /// Write measured and predicted reflectances of the mixtures as JSON, for `impasto map --residuals`
    ///
    /// The reflectances are of films that hide, at each wavelength. The file also holds the settings of the
    /// fit and the hashes of the measurements. It tells a pigment map how far predictions of the library err.
    #[arg(long, value_name = "FILE")]
    residuals: Option<PathBuf>,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: samples, pigments, rms, delta_e, per_sample, shares_of_squares, warnings,
    /// seconds, strength_free, strengths, by_pigment
    #[arg(long)]
    json: bool,
    /// Print the error of every mixture as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl CommandLine for ValidationRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        option.value_name(match key {
            "folds" => "N",
            "leave_out" => "WHAT",
            _ => "PIGMENT",
        })
    }
}

impl Validate {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let start = Instant::now();
        let options = ValidationRequest {
            fit: self.options.request(self.viewing.viewing(console)?)?,
            ..self.validation.request()?
        };
        if options.folds.is_some_and(|folds| folds < 2) {
            return Err(Failure::usage("--folds needs at least 2 groups", "try --folds 10"));
        }
        if self.residuals.is_some() && options.fit.amounts == AmountKind::Absolute {
            return Err(FittingError::AbsoluteResiduals.into());
        }
        if self.residuals.is_some()
            && options.leave_out.is_some_and(|leave_out| leave_out != LeaveOut::Mixture)
        {
            return Err(FittingError::ResidualsOfMixtures.into());
        }
        let residuals = self
            .residuals
            .as_deref()
            .map(|path| Output::open(path, &self.options.files()))
            .transpose()?;
        let readings = self.options.readings(console)?;
        let prepared = prepare_fit(&readings, &options.fit, console)?;
        let mixtures = prepared.mixtures(&options)?;
        let fit_start = Instant::now();
        let fit = fit_of_all(&prepared, console)?;
        let by_groups = options.folds.is_some() || options.fit.amounts == AmountKind::Absolute;
        if let Some(advice) = folds_advice(mixtures, fit_start.elapsed(), by_groups) {
            console.remarks(&[advice])?;
        }
        let progress = Progress::new(mixtures, "leaving out", console.shows_progress());
        let validation = prepared.validate_fit(fit, &options, &progress.task(0))?;
        progress.done();
        if let Some(output) = residuals {
            output.write(validation.residuals()?.to_json(), console)?;
        }
        let warnings = validation.warnings();
        if self.csv {
            console.warnings(&warnings)?;
            return console.csv_rows(&fit::rows(&validation.errors.per_sample));
        }
        if self.json {
            let seconds = start.elapsed().as_secs_f64();
            let mut errors = fit::timed(validation.errors_json(), seconds);
            errors["strength_free"] = json!(validation.errors.strength_free);
            errors["strengths"] = json!(validation.errors.strengths);
            errors["by_pigment"] = json!(validation.errors.by_pigment);
            return console.json(&errors);
        }
        console.warnings(&warnings)?;
        console.lines(validation.report().to_string())
    }
}

/// Time of a fit without one mixture divided by the time of the full fit. Such a fit starts from
/// the estimates of the full fit, and computes no standard deviations. With the oils we measured
/// 0.22 on two cores, and less on more cores.
const REFIT: f64 = 0.25;
/// If a validation is expected to take longer than this, in seconds, we advise to validate in
/// groups.
const LONG: f64 = 120.0;
/// Number of groups that is advised.
const FOLDS: usize = 10;

/// Advises to leave out groups if leaving out mixtures one by one would take minutes. We judge this
/// by the time of the full fit.
fn folds_advice(mixtures: usize, fit: Duration, by_groups: bool) -> Option<Remark> {
    let seconds = |fits: usize| REFIT * fit.as_secs_f64() * fits as f64;
    let long = !by_groups && mixtures > FOLDS && seconds(mixtures) > LONG;
    long.then(|| {
        let minutes = (seconds(mixtures) / 60.0).ceil();
        let note = format!("{mixtures} mixtures left out one by one take about {minutes} minutes");
        Remark::note(note).with_hint(format!(
            "[folds={FOLDS}] leaves them out in {FOLDS} groups, about {:.0} s",
            seconds(FOLDS).ceil()
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_advised_where_one_by_one_takes_minutes() {
        let advised = |mixtures, seconds, by_groups| {
            folds_advice(mixtures, Duration::from_secs(seconds), by_groups)
        };
        let advice = advised(2000, 30, false).unwrap();
        assert!(advice.text.contains("250 minutes"), "{advice:?}");
        assert!(format!("{advice:?}").contains("folds=10"), "{advice:?}");
        assert!(advised(2000, 30, true).is_none());
        assert!(advised(40, 1, false).is_none());
    }
}
