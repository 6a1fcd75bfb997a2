//! `impasto plan` plans the swatches to prepare, and prints the plan as text, CSV or JSON.

use std::path::{Path, PathBuf};

use calibrate::plan::{Forecast, MeasurementForm, PaintSet, Plan as PlanReportPlan, PlanRequest};
use clap::{Arg, Args};
use documents::file::is_stream;
use documents::{Task, column_width};
use spectra::Grid;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::split;
use crate::output::Output;
use crate::progress::waited;
use crate::readings::library;
use crate::request_options::{CommandLine, RequestOptions};
use crate::surface::{grid, numbers};

/// Maximum number of wavelengths of a measurement file.
const MAX_WAVELENGTHS: usize = 5001;

/// Plan the swatches to prepare, so that K and S of every pigment can be determined
///
/// Prints the recipe of each swatch in parts and grams, and the total of each paint. With a
/// library of similar paint, the swatches are chosen to determine K and S best (D-optimal), and the
/// expected deviations are predicted. --output writes the measurement file to fill in: bare cards
/// and every swatch over a white and a black card, amounts in grams. It also writes a file of recipes,
/// for an instrument that saves its own files: the column `reading` has the name to give each reading,
/// and `fit` takes the file with --recipes. Replace the amounts by what the balance showed.
#[derive(Debug, Args)]
#[command(override_usage = "impasto plan [OPTIONS] --white <NAME> [LIBRARY] <PIGMENT>...")]
pub(crate) struct Plan {
    /// A pigment library (JSON) of the same or similar paint, to choose the swatches by [default:
    /// none], then the pigments, whose names may be abbreviated with a library
    #[arg(required = true, value_name = "[LIBRARY] PIGMENT")]
    words: Vec<String>,
    /// The white for tints. Its S is the unit
    #[arg(long, value_name = "NAME")]
    white: String,
    #[command(flatten)]
    request: RequestOptions<PlanRequest>,
    /// Old name of LIBRARY
    #[arg(long, value_name = "LIBRARY", hide = true)]
    prior: Option<PathBuf>,
    /// Readings of each film and card in the file
    #[arg(long, value_name = "N", default_value_t = 2)]
    replicates: usize,
    /// Wavelengths of the file in nm: first,last,step
    #[arg(long, value_name = "FIRST,LAST,STEP", default_value = "400,700,10")]
    grid: String,
    /// The empty measurement file to write (CSV)
    #[arg(short, long, value_name = "CSV")]
    output: Option<PathBuf>,
    /// The file of recipes to write, for files of an instrument (CSV) [default: beside the measurement
    /// file, with -recipes added to its name]
    #[arg(long, value_name = "CSV")]
    recipes: Option<PathBuf>,
    /// Print JSON: swatches, totals_g, unknowns, identified, prior (null without), loss (null if none)
    #[arg(long)]
    json: bool,
    /// Print the swatches as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl CommandLine for PlanRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "black" => option.value_name("NAME"),
            "swatches" => option.value_name("N|fewest"),
            "minutes" | "minutes_each" => option.value_name("MINUTES"),
            "noise" => option.value_name("CONSTANT,EVEN").allow_hyphen_values(true),
            _ => option.value_name("G"),
        }
    }
}

impl Plan {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let form = MeasurementForm { grid: self.grid()?, replicates: self.replicates()? };
        let request = self.request.request()?;
        let (first, pigments) = split(&self.words, true);
        let path = match (first, &self.prior) {
            (Some(first), Some(prior)) => {
                let both =
                    format!("{} and {} are both libraries", first.display(), prior.display());
                return Err(Failure::usage(both, "leave one of them out"));
            }
            (first, prior) => first.or_else(|| prior.clone()),
        };
        if pigments.is_empty() {
            return Err(Failure::usage("no pigment is named", "name those to plan for"));
        }
        if request.noise.is_some() && path.is_none() {
            return Err(Failure::usage(
                "--noise works only where a library chooses the swatches",
                "name a library of similar paint first, or leave --noise out",
            ));
        }
        let inputs: Vec<PathBuf> = path.iter().cloned().collect();
        let recipes_path = self.recipes_path();
        let output = self.output.as_deref().map(|path| new_output(path, &inputs)).transpose()?;
        let recipes = recipes_path.as_deref().map(|path| new_output(path, &inputs)).transpose()?;
        let prior = path.as_deref().map(library).transpose()?;
        let request = PlanRequest { prior, ..request };
        let plan = waited("choosing swatches", console, || {
            calibrate::plan(pigments, &self.white, &request, &Task::default())
        })?;
        console.remarks(&plan.remarks)?;
        if let Some(output) = output {
            output.write(plan.form(&form), console)?;
        }
        if let Some(recipes) = recipes {
            recipes.write(plan.recipes(&form), console)?;
        }
        if self.csv {
            let whole = plan.to_json();
            return console.csv_rows(whole["swatches"].as_array().map_or(&[], Vec::as_slice));
        }
        if self.json {
            return console.json(&plan.to_json());
        }
        print_swatches(&plan, console)?;
        print_totals(&plan, console)?;
        console.line("")?;
        console.line(format!(
            "{} for {} per wavelength; every pigment is identified",
            documents::counted_as(plan.swatches.len(), "swatch", "swatches"),
            documents::counted(plan.paints.unknowns(), "unknown")
        ))?;
        if let Some(forecast) = &plan.forecast {
            print_forecast(&plan.paints, forecast, console)?;
        }
        let white = plan.paints.name(PaintSet::WHITE);
        if let Some(path) = self.output.as_deref().filter(|path| !is_stream(path)) {
            let path = quoted(path);
            console.remark(format!(
                "next: fill in {path}, then run impasto fit {path} --white \"{white}\""
            ))?;
        }
        match &recipes_path {
            Some(path) => console.remark(format!(
                "with files of an instrument: name each reading as the column `reading` says, then run impasto fit FILE.. --recipes {} --white \"{white}\"",
                quoted(path)
            )),
            None if self.output.is_some() => Ok(()),
            None => console.remark("give --output FILE.csv for the measurement file to fill in"),
        }
    }

    /// Path of the file of recipes. `None` if no file is written.
    fn recipes_path(&self) -> Option<PathBuf> {
        self.recipes.clone().or_else(|| {
            let output = self.output.as_ref()?;
            if is_stream(output) {
                return None;
            }
            let stem = output.file_stem()?.to_string_lossy();
            Some(output.with_file_name(format!("{stem}-recipes.csv")))
        })
    }

    fn replicates(&self) -> Result<usize> {
        if (1..=100).contains(&self.replicates) {
            return Ok(self.replicates);
        }
        Err(Failure::usage(
            format!("--replicates takes 1 to 100, found `{}`", self.replicates),
            "try --replicates 2, and turn the sample between both readings",
        ))
    }

    fn grid(&self) -> Result<Grid> {
        let out_of_range = || {
            let limits = format!("up to {MAX_WAVELENGTHS} wavelengths from 200 to 2500 nm");
            Failure::usage(
                format!("--grid takes {limits}, found `{}`", self.grid),
                "try --grid 400,700,10",
            )
        };
        if let Some([first, last, _]) = numbers(&self.grid)
            && !(first >= 200.0 && last <= 2500.0)
        {
            return Err(out_of_range());
        }
        let grid = grid(&self.grid)?;
        if grid.count() > MAX_WAVELENGTHS {
            return Err(out_of_range());
        }
        Ok(grid)
    }
}

/// Opens a file that must not exist yet, since you may have written readings or amounts in it.
fn new_output(path: &Path, inputs: &[PathBuf]) -> Result<Output> {
    let output = Output::open(path, inputs)?;
    if path.exists() {
        return Err(Failure::usage(
            format!("{}: exists already and is not overwritten", path.display()),
            "give another name, or remove the file first",
        ));
    }
    Ok(output)
}

/// A path as you type it in a shell.
fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    if text.contains(' ') { format!("\"{text}\"") } else { text }
}

pub(super) fn print_swatches(plan: &PlanReportPlan, console: &mut Console<'_>) -> Result<()> {
    let recipes = plan.swatches.iter().map(|swatch| {
        let parts = swatch.grams.iter();
        let parts = parts.map(|&(paint, grams)| format!("{grams} g {}", plan.paints.name(paint)));
        parts.collect::<Vec<_>>().join(" + ")
    });
    let recipes: Vec<String> = recipes.collect();
    let width = column_width(plan.swatches.iter().map(|s| &s.name), 0);
    let recipe_width = column_width(&recipes, 0);
    for (swatch, recipe) in plan.swatches.iter().zip(&recipes) {
        let name = &swatch.name;
        let purpose = swatch.recipe.purpose;
        console.line(format!("{name:width$}  {recipe:recipe_width$}  {}", purpose.why()))?;
    }
    Ok(())
}

pub(super) fn print_totals(plan: &PlanReportPlan, console: &mut Console<'_>) -> Result<()> {
    console.line("")?;
    console.line("Paint for all of them:")?;
    for (name, total) in plan.paints.names.iter().zip(plan.totals_g()) {
        console.line(format!("{total:9.2} g {name}"))?;
    }
    Ok(())
}

pub(super) fn print_forecast(
    paints: &PaintSet,
    forecast: &Forecast,
    console: &mut Console<'_>,
) -> Result<()> {
    console.line(format!(
        "the usual plan with as many swatches has {:.0} % of the information of this one (D-efficiency)",
        100.0 * forecast.usual_efficiency
    ))?;
    console.line("")?;
    console.line(format!(
        "Predicted standard deviations, in percent of K and S, median over wavelength (noise {}, {:.3}):",
        forecast.noise.constant, forecast.noise.even
    ))?;
    let width = column_width(&paints.names, 0);
    console.line(format!("{:width$}       K       S   usual K  usual S", ""))?;
    let pairs = forecast.deviations.iter().zip(&forecast.usual_deviations);
    for (name, (own, usual)) in paints.names.iter().zip(pairs) {
        console.line(format!(
            "{name:width$} {:>7} {:>7}  {:>8} {:>8}",
            percent(own.absorption),
            own.scattering.map_or_else(|| "unit".to_owned(), percent),
            percent(usual.absorption),
            usual.scattering.map_or_else(|| "unit".to_owned(), percent),
        ))?;
    }
    Ok(())
}

/// A relative deviation in percent with one digit. Above 999 % the exact number says nothing.
fn percent(value: f64) -> String {
    match 100.0 * value {
        large if large > 999.0 => ">999".to_owned(),
        value => format!("{value:.1}"),
    }
}
