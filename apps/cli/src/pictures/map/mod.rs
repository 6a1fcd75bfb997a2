//! `impasto map`: which pigments of a library are where in a spectral scan. This file also holds the
//! options for how a scan is read, the text of a survey and its maps, and the text, JSON and CSV that
//! compare maps with the truth of a simulated scan.

mod page;

use std::path::{Path, PathBuf};

use clap::builder::NonEmptyStringValueParser;
use clap::{Arg, Args, ValueHint};
use documents::{Task, column_width, text::read_text};
use maps::cube::{CubeOptions, CubeScale};
use maps::pictures::Overview;
use maps::truth::{CHI2_RISEN, Comparison, Truth, compare};
use maps::{
    Book, Cube, FoundColumn, MapRequest, MapRequestError, Spot, StoreMode, StoredMaps, SurveyedScan,
};
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::{Context, Failure, Result};
use crate::library_choice::chosen;
use crate::output::OutputFolder;
use crate::progress::{Progress, Waiting};
use crate::request_options::{CommandLine, RequestOptions};

/// Pictures show the pixels of a scan in squares, at most this many along the longer side.
const PICTURE: usize = 1600;
/// Steps of the progress bar.
const STEPS: usize = 1000;

/// Map the pigments of a library in a spectral scan
///
/// For every pixel you learn which pigments are there, their shares with standard deviations, and how
/// sure that is. We assume that the paint hides its ground, unless you name it, and mixes by two-constant Kubelka-Munk. About
/// 20,000 pixels are compared with all sets of pigments (the survey). All other pixels start from the
/// surveyed pixels most like them. Pigments that the bands of the scan cannot tell apart are mapped as
/// one. The maps are a Zarr group that xarray opens. --resume continues a run that was interrupted. Tested
/// on simulated scans and measured swatches only.
#[derive(Debug, Args)]
pub(crate) struct Map {
    /// The scan: ENVI (the .hdr or the data), a folder of a Specim camera, Zarr 3, spectral OpenEXR, or a
    /// folder of one picture a band
    scan: PathBuf,
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else the Van Gogh oils that ship]
    library: Option<PathBuf>,
    /// The maps to write: a folder, such as maps.zarr; without it only the survey is printed
    #[arg(short, long, alias = "out", value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Continue maps that an earlier run of the same scan, library and settings began
    #[arg(long, requires = "output")]
    resume: bool,
    /// A folder for pictures of the maps (PNG) and a page that shows them
    #[arg(long, value_name = "FOLDER", requires = "output")]
    pictures: Option<PathBuf>,
    /// The file of a survey: read if it exists, else written
    #[arg(long, value_name = "JSON")]
    survey: Option<PathBuf>,
    /// Compare the maps with the truth that `impasto simulate-scan` wrote: precision and recall of presence, error of
    /// the shares, by the kind of paint and its tone
    #[arg(long, value_name = "FOLDER", requires = "output")]
    truth: Option<PathBuf>,
    /// Least share for a pigment to count as present in the truth; a trace with a smaller share is neither
    /// right nor wrong to find
    #[arg(long, value_name = "0.05", requires = "truth", default_value = "0.05")]
    least_share: f64,
    #[command(flatten)]
    reading: ScanOptions,
    #[command(flatten, next_help_heading = "Pigments")]
    request: RequestOptions<MapRequest>,
    /// Print JSON: palette, groups, pixels, spots, truth, and of maps their hashes and settings
    #[arg(long)]
    json: bool,
    /// Print the palette as CSV; with --truth the figures by kind of paint
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl CommandLine for MapRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "ground" => option.value_name("ROWS,COLUMNS|FILE"),
            // After --pictures and after --survey.
            "region" => {
                option.value_name("ROWS,COLUMNS").help_heading(None::<&str>).display_order(2)
            }
            "spots" => {
                let option = option.long("spot").value_name("ROWS,COLUMNS");
                option.help_heading(None::<&str>).display_order(4)
            }
            _ => of_pigments(key, option),
        }
    }
}

/// Adds names of values to the options on pigments and errors, which `map` and `identify` share.
pub(super) fn of_pigments(key: &str, option: Arg) -> Arg {
    match key {
        "at_most" => option.value_name("N").hide_default_value(true),
        "palette" => option.value_name("NAME"),
        "groups" => option.long("group").value_name("NAME=PIGMENT,.."),
        "noise" => option.value_name("SD").allow_hyphen_values(false),
        "residuals" => path(option, "FILE"),
        "model_error" => {
            let option = option.value_name("0.05").allow_hyphen_values(false);
            option.conflicts_with("residuals")
        }
        "penalty" => option.value_name("N").hide_default_value(true).allow_hyphen_values(false),
        _ => option,
    }
}

/// The option with a path as its value.
fn path(option: Arg, value: &'static str) -> Arg {
    let option = option.value_name(value).value_hint(ValueHint::AnyPath);
    option.value_parser(NonEmptyStringValueParser::new())
}

impl Map {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let request = self.request.request()?;
        let inputs = [self.scan.clone()];
        let pictures = self.pictures.as_ref();
        let pictures = pictures.map(|path| OutputFolder::open(path, &inputs)).transpose()?;
        let truth = self.truth.as_ref().map(Truth::open).transpose()?;
        if !(0.0..1.0).contains(&self.least_share) {
            return Err(Failure::usage(
                format!("--least-share takes 0 to below 1, found `{}`", self.least_share),
                "try --least-share 0.05",
            ));
        }
        let library = chosen(self.library.as_deref(), console)?.library;
        let cube = self.reading.cube(&self.scan)?;
        console.remarks(cube.remarks())?;
        let known = self.survey.as_ref().filter(|path| path.exists());
        let book = known.map(|path| book(path)).transpose()?;
        let waiting = Waiting::new("surveying", console.shows_progress());
        let scan = request.survey(cube, &library, book, &Task::default()).map_err(failure)?;
        drop(waiting);
        console.remarks(scan.mapper().remarks())?;
        console.remarks(&scan.mapper().assumed_error(request.model_error.is_some()))?;
        if let (Some(path), None) = (&self.survey, known) {
            documents::file::write_whole(path, scan.book().to_json()?.as_bytes())?;
            console.wrote(path)?;
        }
        let mut mapped = None;
        let mut compared = None;
        if let Some(output) = &self.output {
            self.map(&scan, output, console)?;
            let maps = StoredMaps::open(output)?;
            console.wrote(output)?;
            mapped = Some(Overview::of(&maps, PICTURE)?);
            compared =
                truth.as_ref().map(|truth| compare(&maps, truth, self.least_share)).transpose()?;
        }
        let spots = request.spots_of(&scan, &library)?;
        if let (Some(folder), Some(overview)) = (pictures, &mapped) {
            page::write(&folder, &scan, overview, (&library, &spots))?;
            folder.told(console)?;
        }
        if self.csv {
            return console.csv_rows(&match &compared {
                Some(compared) => rows(compared),
                None => scan.palette_json(mapped.as_ref()),
            });
        }
        if self.json {
            let mut json = scan.to_json(mapped.as_ref(), &spots);
            json["truth"] = compared.as_ref().map(self::json).into();
            return console.json(&json);
        }
        print_survey(&scan, mapped.as_ref(), console)?;
        if let Some(compared) = &compared {
            print(compared, console)?;
        }
        print_spots(&spots, console)?;
        if self.output.is_none() {
            console.remark("Wrote no maps; give --output maps.zarr to map every pixel")?;
        }
        Ok(())
    }

    /// Maps every pixel that is not mapped yet.
    fn map(&self, scan: &SurveyedScan, output: &PathBuf, console: &mut Console<'_>) -> Result<()> {
        let mode = if self.resume { StoreMode::Resume } else { StoreMode::New };
        let store = scan.store(output, mode)?;
        let bar = Progress::new(STEPS, "mapping", console.shows_progress());
        let outcome = scan.map(&store, &bar.task_of_any_steps());
        bar.done();
        let outcome = outcome?;
        if outcome.kept > 0 {
            let kept = documents::counted(outcome.kept, "shard");
            console.detail(format!("{kept} of the maps were finished before"))?;
        }
        Ok(())
    }
}

/// Reads the book of an earlier survey.
fn book(path: &Path) -> Result<Book> {
    let book = Book::from_json(&read_text(path)?);
    book.context(|| format!("{} cannot be used", path.display()))
}

/// The error of a request in the words of the command line.
pub(super) fn failure(error: MapRequestError) -> Failure {
    match error {
        MapRequestError::GroundFile(reason) => {
            Failure::from(reason).within("--ground takes a region or a file")
        }
        error => error.into(),
    }
}

/// How the scan is read.
#[derive(Debug, Args)]
#[command(next_help_heading = "Reading the scan")]
struct ScanOptions {
    /// Values are in percent [default: by the file]
    #[arg(long, conflicts_with_all = ["fraction", "scale"])]
    percent: bool,
    /// Values are fractions, a white near 1
    #[arg(long, conflicts_with = "scale")]
    fraction: bool,
    #[command(flatten)]
    options: RequestOptions<CubeOptions>,
}

impl CommandLine for CubeOptions {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "white_reading" => path(option, "SCAN"),
            "dark_reading" => path(option, "SCAN").requires("white_reading"),
            "tile" => {
                let option = option.value_name("0.99").hide_default_value(true);
                option.allow_hyphen_values(false).requires("white_reading")
            }
            "scale" => option.value_name("10000").hide_default_value(true),
            "full_scale" => option.value_name("COUNT").allow_hyphen_values(false),
            "wavelengths" => path(option, "FILE"),
            "variable" => option.value_name("NAME"),
            _ => option,
        }
    }

    fn is_option(key: &str) -> bool {
        key != "scratch"
    }
}

impl ScanOptions {
    /// Opens the scan at `path`.
    fn cube(&self, path: &Path) -> Result<Cube> {
        let options = self.options.request()?;
        if !(options.tile > 0.0 && options.tile <= 1.2) {
            return Err(Failure::usage(
                "--tile takes the reflectance of the white, above 0 and up to 1.2",
                "leave it out for a white that reflects everything",
            ));
        }
        let scale = match (self.percent, self.fraction) {
            (true, _) => CubeScale::Percent,
            (_, true) => CubeScale::Fraction,
            _ => options.scale,
        };
        Ok(Cube::open_with(path, &CubeOptions { scale, ..options })?)
    }
}

/// Part of the pixels below which a pigment is not named in the text.
const NAMED: f64 = 0.001;

/// A row for each kind of pixels.
fn rows(compared: &Comparison) -> Vec<Value> {
    let rows = compared.rows.iter().map(|row| {
        json!({
            "kind": row.kind,
            "pixels": row.pixels,
            "mapped": row.mapped,
            "precision": row.scores.precision,
            "recall": row.scores.recall,
            "share_error": row.scores.share_error,
            "within_sd": row.within_sd,
            "chi2_risen": row.chi2_risen,
        })
    });
    rows.collect()
}

fn json(compared: &Comparison) -> Value {
    let pigments = compared.pigments.iter().map(|pigment| {
        json!({
            "pigment": pigment.name,
            "there": pigment.there,
            "told": pigment.told,
            "right": pigment.right,
        })
    });
    json!({ "kinds": rows(compared), "pigments": pigments.collect::<Vec<Value>>() })
}

/// Prints a line for each kind of pixels, then a line for each pigment that the truth or the maps hold.
fn print(compared: &Comparison, console: &mut Console<'_>) -> Result<()> {
    console.line(format!(
        "{:14}  {:>8}  precision  recall  share error  within sd  chi-square above {CHI2_RISEN}",
        "truth", "pixels"
    ))?;
    for row in compared.rows.iter().filter(|row| row.pixels > 0) {
        console.line(format!(
            "{:14}  {:8}       {:.2}    {:.2}         {:.2}       {:.2}  {:>16.0} %",
            row.kind,
            row.pixels,
            row.scores.precision,
            row.scores.recall,
            row.scores.share_error,
            row.within_sd,
            100.0 * row.chi2_risen
        ))?;
    }
    let named = compared.pigments.iter().filter(|p| p.there >= NAMED || p.told >= NAMED);
    let named: Vec<_> = named.collect();
    let width = column_width(named.iter().map(|pigment| &pigment.name), "pigment".len());
    console
        .line(format!("{:width$}  present  mapped  mapped rightly (% of the pixels)", "pigment"))?;
    for pigment in named {
        let [there, told, right] =
            [pigment.there, pigment.told, pigment.right].map(|part| 100.0 * part);
        let name = &pigment.name;
        console.line(format!("{name:width$}  {there:7.1}  {told:6.1}  {right:14.1}"))?;
    }
    Ok(())
}

/// Part of the surveyed pixels below which a pigment is not named in the text.
const MOST_NAMED: f64 = 0.001;

/// The maps, and the index of a pigment in them. `None` if the maps do not have it.
fn place<'a>(found: &FoundColumn, mapped: Option<&'a Overview>) -> Option<(&'a Overview, usize)> {
    let overview = mapped?;
    let place = overview.pigments.iter().position(|name| *name == found.column.name)?;
    Some((overview, place))
}

/// Pigments and residual of each spot, a line each.
fn print_spots(spots: &[Spot], console: &mut Console<'_>) -> Result<()> {
    for spot in spots {
        console.line(spot.words())?;
    }
    Ok(())
}

fn print_survey(
    scan: &SurveyedScan,
    mapped: Option<&Overview>,
    console: &mut Console<'_>,
) -> Result<()> {
    console.line(scan.words())?;
    for line in scan.group_words() {
        console.line(line)?;
    }
    let palette = scan.palette();
    let named: Vec<&FoundColumn> =
        palette.iter().filter(|found| found.part >= MOST_NAMED).collect();
    let width = column_width(named.iter().map(|found| &found.column.name), "pigment".len());
    let headings = if mapped.is_some() { "  survey  present  mean share" } else { "  survey" };
    console.line(format!("{:width$}{headings}", "pigment"))?;
    for found in named {
        let mut line = format!("{:width$}  {:4.1} %", found.column.name, 100.0 * found.part);
        if let Some((overview, place)) = place(found, mapped) {
            let [present, share] = [overview.present[place], overview.mean_share[place]];
            line += &format!("   {:4.1} %      {:4.1} %", 100.0 * present, 100.0 * share);
        }
        console.line(line)?;
    }
    let Some(overview) = mapped else { return Ok(()) };
    for line in overview.unmapped_words() {
        console.line(line)?;
    }
    Ok(())
}
