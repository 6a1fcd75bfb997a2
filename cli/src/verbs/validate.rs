//! `impasto validate`: measures how well mixtures outside the fit are predicted.

use std::time::Instant;

use calibrate::ValidationOptions;
use calibrate::validation::Validation;
use clap::Args;

use super::calibration_options::{CalibrationOptions, prepare_fit};
use super::fit_report;
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::ViewingOptions;
use crate::progress::Progress;

/// Leave each mixture out in turn, refit, and predict it
///
/// Measures the error of a calibration on mixtures that it was not fitted to. Masstones are never
/// left out. A mixture without which a pigment could not be identified is named and not counted.
#[derive(Debug, Args)]
pub(crate) struct Validate {
    #[command(flatten)]
    options: CalibrationOptions,
    /// Leave out mixtures in this many seeded groups instead of one at a time [absolute amounts: 10]
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
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let start = Instant::now();
        if self.folds.is_some_and(|folds| folds < 2) {
            return Err(Failure::usage("--folds needs at least 2 groups", "try --folds 10"));
        }
        let options = ValidationOptions {
            fit: self.options.fit_options(self.viewing.viewing()?)?,
            folds: self.folds,
            with: self.with,
        };
        let readings = self.options.readings(console)?;
        let prepared = prepare_fit(&readings, &options.fit, console)?;
        let progress =
            Progress::new(prepared.mixtures(&options)?, "leaving out", console.screen.progress);
        let validation = prepared.validate(&options, &|| progress.step())?;
        progress.done();
        let warnings = validation.warnings();
        if self.json {
            let Validation { rms, delta_e, per_sample, .. } = &validation.errors;
            let pigments = validation.fit.library.pigments.len();
            let seconds = start.elapsed().as_secs_f64();
            return console.json(&fit_report::to_json(
                pigments, *rms, delta_e, per_sample, &warnings, seconds,
            ));
        }
        console.warnings(&warnings)?;
        console.line(validation.report().to_string())
    }
}
