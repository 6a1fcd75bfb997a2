//! `impasto report`: draws a library and its measurements as one page of figures.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use calibrate::comparison::{Comparable, Comparison};
use calibrate::library::PigmentLibrary;
use calibrate::palette::Cards;
use calibrate::quadrature::QuadratureTrial;
use calibrate::validation::Validation;
use clap::Args;
use reports::{STEPS, Subject};
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::{ViewingOptions, color_weights, library};
use crate::output::{Output, create_folder};
use crate::progress::Progress;
use crate::readings::{ReadingOptions, measurements};

/// Draw a library and its measurements: one page, and each figure as SVG, PNG and CSV
///
/// Without readings only the library is drawn. With readings, every sample is compared with the
/// library's prediction, and each mixture is left out in turn and predicted by a fit to the others,
/// as `validate` does. The page is FOLDER/report.html; the figures are in FOLDER/figures.
#[derive(Debug, Args)]
pub(crate) struct Report {
    /// The pigment library (JSON)
    library: PathBuf,
    /// Measurement files, as for `fit`; without them only the library is drawn
    #[arg(value_name = "READINGS")]
    files: Vec<PathBuf>,
    /// Folder for the page and its figures; created if missing
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// Two pigments whose graded mixture is drawn [default: chosen from the library]
    #[arg(long, num_args = 2, value_names = ["A", "B"])]
    pair: Vec<String>,
    /// Skip leaving mixtures out, which takes most of the time
    #[arg(long)]
    no_validation: bool,
    /// Recipes of the samples in a separate CSV, as for `fit`
    #[arg(long, value_name = "FILE", requires = "files")]
    recipes: Option<PathBuf>,
    /// Heading of a column that is a pigment, as for `fit` (may be repeated): the others are ignored
    #[arg(long, value_name = "NAME", requires = "files")]
    pigments: Vec<String>,
    #[command(flatten)]
    reading: ReadingOptions,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: page, figures (name, title, svg, png, csv), samples, delta_e, left_out, absent
    #[arg(long)]
    json: bool,
}

impl Report {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing()?;
        let library = library(&self.library)?;
        let weights = color_weights(&viewing, library.grid, console)?;
        let pair = match self.pair.as_slice() {
            [first, second] => Some((library.find(first)?, library.find(second)?)),
            _ => None,
        };
        if let Some((first, second)) = pair
            && first == second
        {
            return Err(Failure::usage(
                format!(
                    "--pair takes two different pigments, found `{}` twice",
                    library[first].name
                ),
                "replace one of them by another pigment",
            ));
        }
        let measured = self.comparable(&library, console)?;
        let comparison = measured.as_ref().map(|set| set.with(&library, &viewing)).transpose()?;
        if let Some(comparison) = &comparison {
            console.warnings(&reports::absences(comparison))?;
        }
        let cards = measured.as_ref().map(|measured| measured.set.cards(&weights));
        let cards = cards.unwrap_or_else(|| Cards::standard(library.grid));
        let page = self.page()?;

        let measured = measured.filter(|_| !self.no_validation);
        let mixtures = measured.as_ref().map_or(0, |set| set.mixtures(&library));
        let progress = Progress::new(mixtures + STEPS, "drawing", console.screen.progress);
        let step = || progress.step();
        // In parallel, so that cores that finish one task help with the other.
        let (validation, quadratures) = std::thread::scope(|scope| {
            let trials = scope.spawn(|| QuadratureTrial::all(&viewing, &library, &COUNTS));
            let left_out = measured.map(|set| set.left_out(&library, &viewing, &step));
            (left_out.transpose(), trials.join().expect("quadrature trials do not panic"))
        });
        let (validation, quadratures) = (validation?, quadratures?);
        let subject = Subject {
            library: &library,
            viewing: &viewing,
            weights,
            command: console.command.clone(),
            comparison,
            validation: validation.flatten(),
            cards,
            quadratures,
            pair,
        };
        let report = reports::Report::draw(&subject, &step)?;
        progress.done();
        self.write(&report, page)?;
        self.print(&report, &subject, console)
    }

    /// Reads the measurements for comparison with `library`; `None` if no files are given.
    fn comparable(
        &self,
        library: &PigmentLibrary,
        console: &mut Console<'_>,
    ) -> Result<Option<Comparable>> {
        if self.files.is_empty() {
            return Ok(None);
        }
        let recipes = self.recipes.as_deref();
        let readings = measurements(&self.files, recipes, &self.pigments, &self.reading, console)?;
        Ok(Some(Comparable::of(&readings.swatches()?, library)?))
    }

    /// Paths of all files that are read.
    fn inputs(&self) -> Vec<PathBuf> {
        let files = self.files.iter().chain(&self.recipes).chain([&self.library]).cloned();
        files.chain(self.reading.files()).collect()
    }

    /// Creates the folders and checks that the page can be written, before the slow part.
    fn page(&self) -> Result<Output> {
        let figures = self.out.join("figures");
        create_folder(&figures)?;
        Output::open(&self.out.join(PAGE), &self.inputs())
    }

    /// Writes the figures, then the page that shows them.
    fn write(&self, report: &reports::Report, page: Output) -> Result<()> {
        let inputs = self.inputs();
        let mut outputs = Vec::new();
        let mut page = Some(page);
        for (path, content) in report.files() {
            let output = match page.take_if(|_| path == PAGE) {
                Some(page) => page,
                None => Output::open(&self.out.join(&path), &inputs)?,
            };
            outputs.push((output, content));
        }
        // All files are opened first, so that nothing is written if one cannot be.
        outputs.into_iter().try_for_each(|(output, content)| output.write(content))
    }

    /// Prints the errors and the paths of the report.
    fn print(
        &self,
        report: &reports::Report,
        subject: &Subject<'_>,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let path = |inside: &str| self.out.join(inside).display().to_string();
        let Subject { comparison, validation, .. } = subject;
        if self.json {
            let figures = report.figures().map(|figure| {
                let file = |ending: &str| path(&format!("figures/{}.{ending}", figure.name));
                json!({
                    "name": figure.name,
                    "title": figure.title,
                    "svg": file("svg"),
                    "png": file("png"),
                    "csv": file("csv"),
                })
            });
            let absent = |c: &Comparison| -> Vec<Value> {
                let samples = c.absent.iter();
                samples.map(|(s, lacks)| json!({"sample": s, "pigments": lacks})).collect()
            };
            return console.json(&json!({
                "page": path(PAGE),
                "figures": figures.collect::<Vec<Value>>(),
                "samples": comparison.as_ref().map(|c| c.sure().count()),
                "delta_e": comparison.as_ref().map(|c| c.delta_e.rounded()),
                "left_out": validation.as_ref().map(|v| v.delta_e.rounded()),
                "absent": comparison.as_ref().map_or_else(Vec::new, absent),
            }));
        }
        let summary = |subject: &str, count: usize, errors: &calibrate::evaluate::Summary| {
            format!("{count} {subject}: mean {:.2}, largest {:.2}", errors.mean, errors.max)
        };
        if let Some(comparison) = comparison {
            let samples = comparison.sure().count();
            console.line(summary("samples, CIEDE2000 of the fit", samples, &comparison.delta_e))?;
        }
        if let Some(Validation { per_sample, delta_e, .. }) = validation {
            console.line(summary("mixtures left out, CIEDE2000", per_sample.len(), delta_e))?;
        }
        console.line(format!("{} figures: {}", report.figures().count(), path("figures")))?;
        console.line(format!("page: {}", path(PAGE)))
    }
}

/// Numbers of wavelengths that are tried with every quadrature method; chosen by eye.
const COUNTS: RangeInclusive<usize> = 3..=16;
/// File name of the page.
const PAGE: &str = "report.html";
