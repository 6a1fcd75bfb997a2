//! `impasto report`: draws a library and its measurements as one page of figures.

use std::path::PathBuf;

use calibrate::Readings;
use calibrate::validation::Validation;
use clap::{Arg, ArgAction, Args};
use reports::{ReportError, ReportRequest, STEPS, Subject};
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::Result;
use crate::library_choice::{ChosenLibrary, chosen, split};
use crate::output::{Output, OutputFolder};
use crate::progress::Progress;
use crate::readings::{ReadingOptions, ViewingOptions, measurements, remark_coverage};
use crate::request_options::{CommandLine, RequestOptions, refusal};

impl CommandLine for ReportRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "pair" => option.action(ArgAction::Set).num_args(2).value_names(["A", "B"]),
            _ => option,
        }
    }
}

/// Draw a library and its measurements: one page, and each figure as SVG, PNG and CSV
///
/// Without readings only the library is drawn. With readings, every sample is compared with the
/// library's prediction, and each mixture is left out in turn and predicted by a fit to the others,
/// as `validate` does. The page is FOLDER/report.html; the figures are in FOLDER/figures.
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto report [OPTIONS] --output <FOLDER> [LIBRARY] [READINGS]...",
    mut_arg("white_reading", |option| option.alias("white"))
)]
pub(crate) struct Report {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then measurement files, as for `fit`; without them only
    /// the library is drawn
    #[arg(value_name = "[LIBRARY] [READINGS]")]
    words: Vec<String>,
    /// Folder for the page and its figures; created if missing
    #[arg(short, long, alias = "out", value_name = "FOLDER")]
    output: PathBuf,
    #[command(flatten)]
    request: RequestOptions<ReportRequest>,
    /// Recipes of the samples in a separate CSV, as for `fit`
    #[arg(long, value_name = "FILE", requires = "words")]
    recipes: Option<PathBuf>,
    /// Heading of a column that is a pigment, as for `fit` (may be repeated): the others are ignored
    #[arg(long, value_name = "NAME", requires = "words")]
    pigments: Vec<String>,
    #[command(flatten)]
    reading: ReadingOptions,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: page, figures (name, title, svg, png, csv), samples, delta_e, left_out, absent
    #[arg(long)]
    json: bool,
    /// Print the figures with their files as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Report {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let request =
            ReportRequest { viewing: self.viewing.viewing(console)?, ..self.request.request()? };
        let (path, _) = split(&self.words, true);
        let ChosenLibrary { library, path } = chosen(path.as_deref(), console)?;
        remark_coverage(library.grid, console)?;
        let readings = self.readings(console)?;
        let prepared = request.prepare(&library, readings.as_ref(), console.command.as_str());
        let prepared = prepared.map_err(|error| match error {
            ReportError::Request(error) => refusal::<ReportRequest>(error),
            error => error.into(),
        })?;
        if let Some(comparison) = prepared.comparison() {
            console.warnings(&reports::absences(comparison))?;
        }
        let inputs = self.inputs(path);
        let figures = self.folders(&inputs)?;

        let mixtures = prepared.mixtures();
        let progress = Progress::new(mixtures + STEPS, "drawing", console.shows_progress());
        let subject = prepared.subject(&progress.task(0))?;
        let report = reports::Report::draw(&subject, &progress.task(mixtures))?;
        progress.done();
        self.write(&report, &figures, &inputs, console)?;
        self.print(&report, &subject, console)
    }

    /// Reads the measurements, if files are given.
    fn readings(&self, console: &mut Console<'_>) -> Result<Option<Readings>> {
        let files = self.files();
        if files.is_empty() {
            return Ok(None);
        }
        let recipes = self.recipes.as_deref();
        measurements(&files, recipes, &self.pigments, &self.reading, console).map(Some)
    }

    /// Measurement files.
    fn files(&self) -> Vec<PathBuf> {
        split(&self.words, true).1.iter().map(PathBuf::from).collect()
    }

    /// Paths of all files that are read.
    fn inputs(&self, library: Option<PathBuf>) -> Vec<PathBuf> {
        let files = self.files().into_iter().chain(self.recipes.clone()).chain(library);
        files.chain(self.reading.files()).collect()
    }

    /// Checks, before the slow part, that the page and its figures can be written. Returns the folder
    /// of the figures.
    fn folders(&self, inputs: &[PathBuf]) -> Result<OutputFolder> {
        OutputFolder::open(&self.output, inputs)?.check([PAGE.to_owned()])?;
        OutputFolder::open(&self.output.join("figures"), inputs)
    }

    /// Writes the figures, then the page that shows them.
    fn write(
        &self,
        report: &reports::Report,
        figures: &OutputFolder,
        inputs: &[PathBuf],
        console: &mut Console<'_>,
    ) -> Result<()> {
        figures.make()?;
        // All files are opened first, so that nothing is written if one cannot be.
        let mut outputs = Vec::new();
        for (path, content) in report.files() {
            outputs.push((Output::open(&self.output.join(&path), inputs)?, content));
        }
        outputs.into_iter().try_for_each(|(output, content)| output.put(content))?;
        console.wrote(&self.output.join(PAGE))?;
        figures.told(console)
    }

    /// Prints the errors and the paths of the report.
    fn print(
        &self,
        report: &reports::Report,
        subject: &Subject<'_>,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let path = |inside: &str| self.output.join(inside).display().to_string();
        let Subject { comparison, validation, .. } = subject;
        let figures = report.figures().map(|figure| {
            let [svg, png, csv] = ["svg", "png", "csv"]
                .map(|ending| path(&format!("figures/{}.{ending}", figure.name)));
            json!({
                "name": figure.name,
                "title": figure.title,
                "svg": svg,
                "png": png,
                "csv": csv,
            })
        });
        if self.csv {
            return console.csv_rows(&figures.collect::<Vec<Value>>());
        }
        if self.json {
            let absent = comparison.iter().flat_map(|c| &c.absent);
            let absent = absent.map(|(s, lacks)| json!({"sample": s, "pigments": lacks}));
            return console.json(&json!({
                "page": path(PAGE),
                "figures": figures.collect::<Vec<Value>>(),
                "samples": comparison.as_ref().map(|c| c.sure().count()),
                "delta_e": comparison.as_ref().map(|c| c.delta_e.rounded()),
                "left_out": validation.as_ref().map(|v| v.delta_e.rounded()),
                "absent": absent.collect::<Vec<Value>>(),
            }));
        }
        let summary =
            |subject: (&str, &str), count: usize, errors: &calibrate::evaluate::Summary| {
                let (noun, what) = subject;
                let count = documents::counted(count, noun);
                format!("{count}{what}: mean {:.2}, largest {:.2}", errors.mean, errors.max)
            };
        if let Some(comparison) = comparison {
            let samples = comparison.sure().count();
            console.line(summary(
                ("sample", ", CIEDE2000 of the fit"),
                samples,
                &comparison.delta_e,
            ))?;
        }
        if let Some(Validation { per_sample, delta_e, .. }) = validation {
            console.line(summary(
                ("mixture", " left out, CIEDE2000"),
                per_sample.len(),
                delta_e,
            ))?;
        }
        let figures = documents::counted(report.figures().count(), "figure");
        console.line(format!("{figures}: {}", path("figures")))?;
        console.line(format!("page: {}", path(PAGE)))
    }
}

/// File name of the page.
const PAGE: &str = "report.html";
