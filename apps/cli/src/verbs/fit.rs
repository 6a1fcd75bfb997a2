//! `impasto fit`: fits a pigment library to measurements.
//!
//! Options that `fit` and `validate` share: measurement files and settings of the fit.
//!
//! JSON of `fit` and `validate`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use calibrate::evaluate::Viewing;
use calibrate::fit::{Method, Smoothness};
use calibrate::library::{AmountKind, SampleEvidence};
use calibrate::observation::BelowSurface;
use calibrate::{Fit as CalibrationOptionsFit, FitOptions, PreparedFit, Readings};
use clap::{Args, ValueEnum};
use serde_json::{Map, Value, json};
use spectra::instrument::split_file_and_name;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::Output;
use crate::progress::{Progress, Waiting};
use crate::readings::{ReadingOptions, ViewingOptions, measurements};
use crate::surface::SurfaceOptions;

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
        console.line(fit.report().to_string())?;
        if !wrote {
            console.remark("Wrote nothing; give --output LIBRARY.json to keep the library")?;
        }
        Ok(())
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MethodName {
    /// The published quadratic program, unweighted (Baxter, Wendt and Lin 2004)
    Qp,
    /// The quadratic program, its rows weighted to approximate errors of reflectance
    Weighted,
    /// Robust nonlinear refinement of `weighted`, in measured reflectance
    Refined,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Amounts {
    /// Shares of a mixture, for films that hide or are read over two backings
    Relative,
    /// Amounts (mL, g) spread on a fixed area of a known backing
    Absolute,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Below {
    /// Fail with an error that names sample and wavelength
    Refuse,
    /// Treat the reading as black
    Floor,
}

/// Measurement files and settings of the fit.
#[derive(Debug, Args)]
pub(super) struct CalibrationOptions {
    /// Measurement files: CSV or .xlsx (columns sample, film, backing, one per pigment, then
    /// wavelengths), or an instrument's files with --recipes
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Recipes of samples whose files hold none (CSV): columns sample, one per pigment
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
    /// Method of the fit
    #[arg(long, value_enum, default_value = "refined")]
    method: MethodName,
    /// Meaning of the amounts
    #[arg(long, value_enum, default_value = "relative")]
    amounts: Amounts,
    /// The white whose S is 1 [default: the pigment called white that occurs in most samples]
    // It was the option of a white reading once: a file is still taken for one.
    #[arg(long, alias = "reference", value_name = "PIGMENT")]
    white: Vec<String>,
    #[command(flatten)]
    surface: SurfaceOptions,
    /// Treatment of a reading below k1 [default: refuse]; without --saunderson, k1 stays 0.03
    #[arg(long, value_enum)]
    below_surface: Option<Below>,
    /// Smoothness of K and S over wavelength: auto, none, or a weight such as 10
    #[arg(long, value_name = "WEIGHT", default_value = "auto", allow_hyphen_values = true)]
    smoothness: String,
    /// Unevenness of films of absolute amounts: auto, or the standard deviation of log thickness
    /// such as 0.25
    #[arg(long, value_name = "DEVIATION", default_value = "auto", allow_hyphen_values = true)]
    unevenness: String,
    /// A sample to leave out (may be repeated)
    #[arg(long, value_name = "SAMPLE")]
    exclude: Vec<String>,
    #[command(flatten)]
    reading: ReadingOptions,
}

impl CalibrationOptions {
    /// Paths of all files that are read.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        let reading = self.reading.with_white_reading(self.old_white_reading());
        self.files.iter().chain(&self.recipes).cloned().chain(reading.files()).collect()
    }

    /// The file of a white reading by the option that named it before.
    fn old_white_reading(&self) -> Option<String> {
        self.white.iter().find(|text| is_reading(text)).cloned()
    }

    /// The pigment whose S is 1, if one is named.
    fn reference(&self) -> Result<Option<String>> {
        let mut named = self.white.iter().filter(|text| !is_reading(text));
        match (named.next(), named.next()) {
            (Some(first), Some(second)) => Err(Failure::usage(
                format!("--white takes one pigment, found `{first}` and `{second}`"),
                "leave one of them out",
            )),
            (first, _) => Ok(first.cloned()),
        }
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

    /// Options of the fit; colour errors are computed under `viewing`.
    pub(super) fn fit_options(&self, viewing: Viewing) -> Result<FitOptions> {
        Ok(FitOptions {
            amounts: match self.amounts {
                Amounts::Relative => AmountKind::Relative,
                Amounts::Absolute => AmountKind::Absolute,
            },
            method: match self.method {
                MethodName::Qp => Method::Qp,
                MethodName::Weighted => Method::Weighted,
                MethodName::Refined => Method::Refined,
            },
            reference: self.reference()?,
            surface: self.surface.surface()?,
            specular: self.surface.specular(),
            below_surface: self.below_surface.map(|below| match below {
                Below::Refuse => BelowSurface::Refuse,
                Below::Floor => BelowSurface::Floor,
            }),
            smoothness: self.smoothness()?,
            unevenness: self.unevenness()?,
            exclude: self.exclude.clone(),
            viewing,
            ..FitOptions::default()
        })
    }

    fn smoothness(&self) -> Result<Smoothness> {
        Ok(match self.smoothness.as_str() {
            "auto" => Smoothness::Auto,
            "none" => Smoothness::None,
            text => Smoothness::Fixed(at_least_zero("--smoothness", text)?),
        })
    }

    fn unevenness(&self) -> Result<Option<f64>> {
        Ok(match self.unevenness.as_str() {
            "auto" => None,
            text => Some(at_least_zero("--unevenness", text)?),
        })
    }
}

/// Chooses the options of a fit that were left open, and prints the choices.
pub(super) fn prepare_fit(
    readings: &Readings,
    options: &FitOptions,
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

/// Parses a finite number of 0 and up.
fn at_least_zero(option: &str, text: &str) -> Result<f64> {
    text.parse().ok().filter(|v: &f64| v.is_finite() && *v >= 0.0).ok_or_else(|| {
        Failure::usage(
            format!("{option} takes a word or a number not below 0, found `{text}`"),
            format!("try {option} auto"),
        )
    })
}

/// Whether the value of `--white` is the file of a reading, FILE or FILE#NAME, and no pigment.
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
