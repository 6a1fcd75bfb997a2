//! `impasto fit`: fits a pigment library to measurements.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;

use super::calibration_options::{CalibrationOptions, prepare_fit, watched_fit};
use super::fit_report;
use crate::console::Console;
use crate::failure::Result;
use crate::input::ViewingOptions;
use crate::output::Output;

/// Fit K and S of every pigment to measured mixtures, and write the library
///
/// Prints the colour error of every sample: CIEDE2000 between its measured K/S in a film that hides
/// and the fitted mixture (for absolute amounts, between measured and fitted film). K and S do not
/// depend on --illuminant and --observer, which only set the light and observer of the errors.
#[derive(Debug, Args)]
pub(crate) struct Fit {
    #[command(flatten)]
    options: CalibrationOptions,
    /// The library file to write (JSON); without it only errors are printed
    #[arg(short, long, value_name = "LIBRARY")]
    output: Option<PathBuf>,
    /// Title of the library [default: the first file's name]
    #[arg(long)]
    title: Option<String>,
    /// Licence of the library
    #[arg(long, default_value = "not stated")]
    licence: String,
    /// Source of the measurements
    #[arg(long, default_value = "not stated")]
    source: String,
    /// Fit to one half of the mixtures alone: every second, from the first (0) or the second (1) on, with all
    /// films of one pigment. What a painting of the one library looks like to the other shows how far it can be
    /// believed
    #[arg(long, value_name = "0|1", value_parser = clap::value_parser!(u8).range(0..=1))]
    half: Option<u8>,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: samples, pigments, rms, delta_e, per_sample, shares_of_squares, warnings,
    /// seconds
    #[arg(long)]
    json: bool,
    /// Print the error of every sample as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Fit {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let start = Instant::now();
        let mut options = self.options.fit_options(self.viewing.viewing()?)?;
        options.title = self.title;
        options.licence = Some(self.licence);
        options.source = Some(self.source);
        let output = self
            .output
            .as_deref()
            .map(|path| Output::open(path, &self.options.files()))
            .transpose()?;
        let readings = self.options.readings(console)?;
        let mut prepared = prepare_fit(&readings, &options, console)?;
        if let Some(half) = self.half {
            prepared = prepared.half(usize::from(half));
        }
        let fit = watched_fit(&prepared, console)?;
        console.remarks(&fit.remarks)?;
        let wrote = output.is_some();
        if let Some(output) = output {
            output.write(fit.library.to_json(), console)?;
        }
        if self.csv {
            console.warnings(fit.warnings())?;
            return console.csv_rows(&fit_report::rows(&fit.evidence().per_sample));
        }
        if self.json {
            return console
                .json(&fit_report::timed(fit.errors_json(), start.elapsed().as_secs_f64()));
        }
        console.warnings(fit.warnings())?;
        console.line(fit.report().to_string())?;
        if !wrote {
            console.remark("Wrote nothing; give --output LIBRARY.json to keep the library")?;
        }
        Ok(())
    }
}
