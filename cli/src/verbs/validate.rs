//! `impasto validate`: how well unseen mixtures are predicted.

use std::time::Instant;

use calibrate::observation::Observation;
use calibrate::validation::{Validation, ValidationPlan, leave_out, leave_out_films};
use clap::Args;

use super::calibration_options::{CalibrationOptions, Job, Kind};
use super::fit_report;
use crate::console::Console;
use crate::failure::Refusal;
use crate::input::{ViewingOptions, named};
use crate::progress::Progress;

/// Leave each mixture out in turn, refit, and predict it
///
/// The honest error of a calibration: that of mixtures it has not seen. Masstones are never left
/// out. A mixture without which a pigment could not be identified is named and not counted.
#[derive(Debug, Args)]
pub(crate) struct Validate {
    #[command(flatten)]
    options: CalibrationOptions,
    /// Leave out this many seeded groups instead of one mixture at a time [absolute amounts: 10]
    #[arg(long, value_name = "N")]
    folds: Option<usize>,
    /// Leave out only mixtures with this pigment (may be repeated)
    #[arg(long = "with", value_name = "PIGMENT")]
    with: Vec<String>,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: samples, pigments, rms, delta_e, per_sample, warnings, seconds
    #[arg(long)]
    json: bool,
}

impl Validate {
    pub(super) fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        let start = Instant::now();
        let viewing = self.viewing.viewing()?;
        if self.folds.is_some_and(|folds| folds < 2) {
            return Err(Refusal::usage("--folds needs at least 2 groups", "try --folds 10"));
        }
        let job = self.options.job(console)?;
        let with = self.with(&job)?;
        let fitted = job.calibrate(&viewing)?;
        let is_chosen = |amounts: &[f64]| with.is_empty() || with.iter().any(|&p| amounts[p] > 0.0);
        let is_mixture = |amounts: &[f64]| amounts.iter().filter(|a| **a > 0.0).count() > 1;
        let amounts = job.set.swatches.iter().map(|swatch| swatch.amounts.as_slice());
        let count = amounts.filter(|a| is_mixture(a) && is_chosen(a)).count();
        let progress = Progress::new(count, "leaving out", console.screen.progress);
        let step = || progress.step();
        let plan = ValidationPlan {
            settings: &job.settings,
            viewing: &viewing,
            state: fitted.state,
            folds: self.folds,
            progress: &step,
        };
        let validation = match job.kind {
            Kind::Relative(reference, surface) => {
                let chosen = |o: &Observation| is_chosen(&o.shares);
                leave_out(&job.set, reference, surface, &plan, chosen)?
            }
            Kind::Absolute(film) => {
                let plan = ValidationPlan { folds: self.folds.or(Some(10)), ..plan };
                leave_out_films(&job.set, film, &plan)?
            }
        };
        progress.done();
        let Validation { rms, delta_e, per_sample, needed } = &validation;
        if per_sample.is_empty() {
            let what = if needed.is_empty() {
                "there is no mixture to leave out".to_owned()
            } else {
                format!(
                    "no mixture can be left out: without it a pigment would not be identified ({})",
                    needed.join(", ")
                )
            };
            return Err(Refusal::data(
                what,
                "measure more mixtures of each pigment (masstone, two tints, a shade)",
            ));
        }
        let warnings: Vec<String> = needed
            .iter()
            .map(|sample| {
                format!("{sample}: not left out, a pigment would not be identified without it")
            })
            .collect();
        if self.json {
            let pigments = fitted.library.pigments.len();
            let seconds = start.elapsed().as_secs_f64();
            return console.json(&fit_report::to_json(
                pigments, *rms, delta_e, per_sample, &warnings, seconds,
            ));
        }
        console.warnings(&warnings)?;
        let manner = match (self.folds, &job.kind) {
            (Some(folds), _) => format!("in {} groups", folds.min(per_sample.len())),
            (None, Kind::Absolute(_)) => "in 10 groups".to_owned(),
            (None, Kind::Relative(..)) => "one by one".to_owned(),
        };
        console.line(format!("{} mixtures, left out {manner}", per_sample.len()))?;
        fit_report::print_errors(delta_e, *rms, console)?;
        console.line(format!(
            "(CIEDE2000 under {}, observer {}; rms of reflectance)",
            viewing.illuminant.name(),
            viewing.observer
        ))?;
        fit_report::print_samples(per_sample, usize::MAX, console)
    }

    /// The indices of the pigments of `--with`.
    fn with(&self, job: &Job) -> anyhow::Result<Vec<usize>> {
        if !self.with.is_empty() && matches!(job.kind, Kind::Absolute(_)) {
            return Err(Refusal::usage("--with needs relative amounts", "leave out --with"));
        }
        self.with.iter().map(|name| named(&job.set.pigments, name, "pigment")).collect()
    }
}
