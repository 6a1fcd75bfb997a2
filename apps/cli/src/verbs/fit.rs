//! `impasto fit` fits a pigment library to measurements. The options for measurement files and for
//! the fit are here, because `validate` has them too, and so is the JSON of both.

use std::path::{Path, PathBuf};
use std::time::Instant;

use calibrate::evaluate::Viewing;
use calibrate::library::{AmountKind, SampleEvidence};
use calibrate::{Fit as CalibrationOptionsFit, FitRequest, PreparedFit, Provenance, Readings};
use clap::{Arg, ArgAction, Args};
use serde_json::{Map, Value, json};
use spectra::instrument::split_file_and_name;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::Output;
use crate::progress::{Progress, Waiting};
use crate::readings::{ReadingOptions, ViewingOptions, library, measurements};
use crate::request_options::{CommandLine, RequestOptions, without_value_help};

/// Heading of the options for the file that is written.
const WRITTEN: &str = "The library that is written";

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
    #[arg(short, long, value_name = "FILE", help_heading = WRITTEN)]
    output: Option<PathBuf>,
    #[command(flatten)]
    provenance: RequestOptions<Provenance>,
    /// Fit to all films of a single pigment, but only to half of the mixtures: the first, third, fifth ..
    /// (0), or the second, fourth .. (1). To see how far maps can be trusted, paint with the library
    /// of one half and map with the library of the other
    #[arg(long, value_name = "0|1", value_parser = clap::value_parser!(u8).range(0..=1),
          hide_short_help = true)]
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
        let provenance = self.provenance.request()?;
        let request = self.options.request(self.viewing.viewing(console)?)?;
        let request = FitRequest { provenance, ..request };
        let output = self
            .output
            .as_deref()
            .map(|path| Output::open(path, &self.options.files()))
            .transpose()?;
        let readings = self.options.readings(console)?;
        let mut prepared = prepare_fit(&readings, &request, console)?;
        if let Some(half) = self.half {
            prepared = prepared.half(usize::from(half));
        }
        let fit = fit_of_all(&prepared, console)?;
        console.remarks(&fit.remarks)?;
        let wrote = output.is_some();
        if let Some(output) = output {
            output.write(fit.library.to_json(), console)?;
        }
        if self.csv {
            console.warnings(fit.warnings())?;
            return console.csv_rows(&rows(&fit.evidence().per_sample));
        }
        if self.json {
            return console.json(&timed(fit.errors_json(), start.elapsed().as_secs_f64()));
        }
        console.warnings(fit.warnings())?;
        console.lines(fit.report().to_string())?;
        if !wrote {
            console.remark("Wrote nothing; give --output LIBRARY.json to keep the library")?;
        }
        Ok(())
    }
}

impl CommandLine for FitRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            // It was the option of a white reading once: a file is still taken for one.
            "reference" => {
                let white = option.long("white").alias("reference").value_name("PIGMENT");
                white.action(ArgAction::Append)
            }
            "surface" => option.long("saunderson").value_name("K1,K2"),
            "specular" => without_value_help(option),
            "below_surface" => option.value_name("HOW"),
            "smoothness" => option.value_name("WEIGHT"),
            "unevenness" => option.value_name("DEVIATION"),
            "exclude" => option.value_name("SAMPLE"),
            _ => option,
        }
    }
}

impl CommandLine for Provenance {
    fn adapted(_key: &str, option: Arg) -> Arg {
        option.value_name("TEXT").help_heading(WRITTEN)
    }
}

/// Measurement files and settings of the fit.
#[derive(Debug, Args)]
pub(super) struct CalibrationOptions {
    /// Measurement files: CSV or .xlsx (columns sample, film, backing, one for each pigment,
    /// then wavelengths), or an instrument's files with --recipes
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Recipes for measurement files that hold none (CSV): a column `sample`, then one column for each
    /// pigment
    ///
    /// Joined to the readings by name. Further columns: film, backing, thickness_mm as in the
    /// measurement CSV, and `reading`, the name in the measurement file, where one sample was read
    /// several times (over white, over black, bare).
    #[arg(long, value_name = "FILE")]
    recipes: Option<PathBuf>,
    /// Heading of a column that is a pigment (may be repeated): the others are ignored
    ///
    /// [default: every column that is not known as something else and holds amounts]
    #[arg(long, value_name = "NAME")]
    pigments: Vec<String>,
    #[command(flatten)]
    fit: RequestOptions<FitRequest>,
    /// Take the surface of this library (JSON), so that both can be merged: its k1, k2 and specular
    /// reflection, and the unevenness of absolute amounts
    ///
    /// Readings below k1 are then read as black, unless --below-surface says otherwise.
    #[arg(long, value_name = "LIBRARY")]
    surface_of: Option<PathBuf>,
    #[command(flatten)]
    reading: ReadingOptions,
}

impl CalibrationOptions {
    /// Paths of all files that are read.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        let reading = self.reading.with_white_reading(self.old_white_reading());
        let others = self.recipes.iter().chain(&self.surface_of);
        self.files.iter().chain(others).cloned().chain(reading.files()).collect()
    }

    /// The file of a white reading, if `--white` names one, as it did in older versions.
    fn old_white_reading(&self) -> Option<String> {
        self.fit.clone().take("reference").into_iter().find(|text| is_reading(text))
    }

    /// Reads the measurement files and prints remarks on them.
    pub(super) fn readings(&self, console: &mut Console<'_>) -> Result<Readings> {
        let white = self.old_white_reading();
        if let Some(file) = &white {
            console
                .remark(format!("{file} is read as --white-reading; --white names a pigment"))?;
        }
        let reading = self.reading.with_white_reading(white);
        measurements(&self.files, self.recipes.as_deref(), &self.pigments, &reading, console)
    }

    /// The request; colour errors are computed under `viewing`.
    pub(super) fn request(&self, viewing: Viewing) -> Result<FitRequest> {
        let mut options = self.fit.clone();
        let whites = options.take("reference");
        let mut named = whites.into_iter().filter(|text| !is_reading(text));
        let reference = named.next();
        if let (Some(first), Some(second)) = (&reference, named.next()) {
            return Err(Failure::usage(
                format!("--white takes one pigment, found `{first}` and `{second}`"),
                "leave one of them out",
            ));
        }
        // Without a surface there is no specular reflection to exclude.
        if options.is("surface", "none") {
            options.take("specular");
        }
        let request = FitRequest { reference, viewing, ..options.request()? };
        let Some(path) = &self.surface_of else { return Ok(request) };
        if request.surface.is_some() {
            return Err(Failure::usage(
                "--surface-of and --saunderson both state the surface",
                "leave one of them out",
            ));
        }
        Ok(request.with_surface_of(&library(path)?))
    }
}

/// Chooses the options of a fit that were left open, and prints the choices.
pub(super) fn prepare_fit(
    readings: &Readings,
    options: &FitRequest,
    console: &mut Console<'_>,
) -> Result<PreparedFit> {
    let chooses_model = options.amounts == AmountKind::Absolute
        && options.surface.is_none()
        && options.unevenness.is_none();
    let steps = if chooses_model { PreparedFit::MODEL_FITS } else { 0 };
    let progress =
        Progress::new(steps, "choosing the film model", console.shows_progress() && chooses_model);
    let prepared = PreparedFit::new(readings, options, &progress.task(0))?;
    progress.done();
    console.remarks(&prepared.remarks)?;
    Ok(prepared)
}

/// Fits all samples, and shows the stages of the fit.
pub(super) fn fit_of_all(
    prepared: &PreparedFit,
    console: &Console<'_>,
) -> Result<CalibrationOptionsFit> {
    let waiting = Waiting::new("fitting", console.shows_progress());
    Ok(prepared.fit(&waiting.task("fitting"))?)
}

/// Whether the value of `--white` names the file of a reading (FILE or FILE#NAME) and not a
/// pigment.
fn is_reading(text: &str) -> bool {
    Path::new(split_file_and_name(text).0).is_file()
}

/// Completes the errors of a fit or validation by the `seconds` that it took, rounded to 1 ms.
pub(super) fn timed(mut errors: Map<String, Value>, seconds: f64) -> Value {
    errors.insert("seconds".to_owned(), json!((seconds * 1e3).round() / 1e3));
    Value::Object(errors)
}

/// Samples with their colour errors, one row each.
pub(super) fn rows(per_sample: &[SampleEvidence]) -> Vec<Value> {
    per_sample
        .iter()
        .map(|s: &SampleEvidence| json!({"sample": s.sample, "ciede2000": s.delta_e}))
        .collect()
}
