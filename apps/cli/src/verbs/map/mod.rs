//! `impasto map`: which pigments of a library are where in a spectral scan.
//!
//! Options of a map: which pigments take part, and how far the library may err.
//!
//! Options for how a scan is read.
//!
//! Text, JSON and CSV of maps beside the truth of a simulated scan.
//!
//! Text of a survey and its maps.

mod page;

use std::path::{Path, PathBuf};

use calibrate::remark::Remark;
use calibrate::{PigmentLibrary, Residuals};
use clap::Args;
use documents::Task;
use maps::cube::{CubeOptions, CubeScale, DarkReading};
use maps::pictures::Overview;
use maps::truth::{CHI2_RISEN, Comparison, Truth, compare};
use maps::{
    Book, Cube, FoundColumn, Ground, MapSettings, ModelError, PigmentGroup, Region, Spot,
    StoreMode, StoredMaps, SurveyedScan,
};
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::{Context, Failure, Result};
use crate::library_choice::chosen;
use crate::output::OutputFolder;
use crate::progress::{Progress, Waiting};

/// Squares along the longer side of the pictures.
const PICTURE: usize = 1600;
/// Steps of the progress bar.
const STEPS: usize = 1000;

/// Map the pigments of a library in a spectral scan
///
/// Tells for every pixel which pigments are there, their shares with standard deviations, and how
/// sure that is: films that hide, mixed by two-constant Kubelka-Munk. About 20,000 pixels are searched
/// whole (the survey); all others start from the nearest of these. Pigments that the bands of the scan
/// cannot tell apart are mapped as one. The maps are a Zarr group that xarray opens; a run that was ended is
/// continued by --resume. Tested on simulated scans and measured swatches only.
#[derive(Debug, Args)]
pub(crate) struct Map {
    /// The scan: ENVI (the .hdr or the data), a folder of a Specim camera, Zarr 3, spectral OpenEXR, or a
    /// folder of one picture a band
    scan: PathBuf,
    /// The pigment library (JSON) [default: that of IMPASTO_LIBRARY, else the Van Gogh oils that ship]
    library: Option<PathBuf>,
    /// The maps to write: a folder, such as maps.zarr; without it the survey is told alone
    #[arg(short, long, alias = "out", value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Continue maps that an earlier run of the same scan, library and settings began
    #[arg(long, requires = "output")]
    resume: bool,
    /// A folder for pictures of the maps (PNG) and a page that shows them
    #[arg(long, value_name = "FOLDER", requires = "output")]
    pictures: Option<PathBuf>,
    /// Rows and columns to map, from 0 and without the last, such as 0..512,100..300 [default: all]
    #[arg(long, value_name = "ROWS,COLUMNS")]
    region: Option<String>,
    /// The file of a survey to use; or to write, if there is none of this name
    #[arg(long, value_name = "JSON")]
    survey: Option<PathBuf>,
    /// A pixel or region to compare, its measured spectrum beside that of the mixture that explains it, such
    /// as 120,40 or 120..124,40..44; may be repeated
    #[arg(long, value_name = "ROWS,COLUMNS")]
    spot: Vec<String>,
    /// Compare the maps with the truth that `impasto simulate-scan` wrote: precision and recall of presence, error of
    /// the shares, by the kind of paint and its tone
    #[arg(long, value_name = "FOLDER", requires = "output")]
    truth: Option<PathBuf>,
    /// Share from which a pigment counts as present in the truth; of smaller ones nothing is expected
    #[arg(long, value_name = "0.05", requires = "truth", default_value = "0.05")]
    least_share: f64,
    #[command(flatten)]
    reading: ScanOptions,
    #[command(flatten)]
    pigments: PigmentOptions,
    /// Print JSON: palette, groups, pixels, spots, truth, and of maps their hashes and settings
    #[arg(long)]
    json: bool,
    /// Print the palette as CSV; with --truth the figures by kind of paint
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Map {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let region = self.region.as_deref().map(region).transpose()?;
        let inputs = [self.scan.clone()];
        let folder = |path: &PathBuf| OutputFolder::open(path, &inputs);
        let pictures = self.pictures.as_ref().map(folder).transpose()?;
        let spots = self.spot.iter().map(|text| spot(text)).collect::<Result<Vec<Region>>>()?;
        let truth = self.truth.as_ref().map(Truth::open).transpose()?;
        if !(0.0..1.0).contains(&self.least_share) {
            return Err(Failure::usage(
                format!("--least-share takes 0 to below 1, found `{}`", self.least_share),
                "try --least-share 0.05",
            ));
        }
        let library = chosen(self.library.as_deref(), console)?.library;
        let cube = self.reading.cube(&self.scan)?;
        for remark in cube.remarks() {
            console.remark(remark)?;
        }
        let settings = self.pigments.settings(&cube, &library)?;
        let waiting = Waiting::new("surveying", console.shows_progress());
        let known = self.survey.as_ref().filter(|path| path.exists());
        let scan = match known {
            Some(path) => {
                let book = Book::from_json(&crate::readings::text(path)?)
                    .context(|| format!("{} cannot be used", path.display()))?;
                SurveyedScan::with_book(cube, &library, &settings, region, book)?
            }
            None => SurveyedScan::survey(cube, &library, &settings, region, &Task::default())?,
        };
        drop(waiting);
        console.remarks(self.pigments.remark(&scan).as_slice())?;
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
        let spots = spots.into_iter().map(|region| Ok(scan.spot(&library, region)?));
        let spots = spots.collect::<Result<Vec<Spot>>>()?;
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

/// Parses `ROWS,COLUMNS`, each `FIRST..END`.
fn region(text: &str) -> Result<Region> {
    rectangle(text).ok_or_else(|| {
        Failure::usage(
            format!("--region takes rows and columns, found `{text}`"),
            "try --region 0..512,100..300",
        )
    })
}

/// Parses `ROW,COLUMN` or `ROWS,COLUMNS`.
fn spot(text: &str) -> Result<Region> {
    let range = |part: &str| {
        let (first, end) = part.split_once("..").unwrap_or((part, part));
        let (first, end): (usize, usize) = (first.trim().parse().ok()?, end.trim().parse().ok()?);
        Some(first..if part.contains("..") { end } else { end.checked_add(1)? })
    };
    let found = text
        .split_once(',')
        .and_then(|(rows, columns)| Some(Region { rows: range(rows)?, columns: range(columns)? }));
    found.filter(|region| !region.rows.is_empty() && !region.columns.is_empty()).ok_or_else(|| {
        Failure::usage(
            format!("--spot takes a row and a column, or rows and columns, found `{text}`"),
            "try --spot 120,40 or --spot 120..124,40..44",
        )
    })
}

/// Which pigments take part, and how they are told.
#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
struct PigmentOptions {
    /// Most pigments of one pixel, 1 to 4 [default: 3]
    #[arg(long, value_name = "N")]
    at_most: Option<usize>,
    /// A pigment that may take part; may be repeated [default: all whose S is known]
    #[arg(long, value_name = "NAME")]
    palette: Vec<String>,
    /// Pigments that are mapped as one, such as `whites=Lead White,Zinc White`; may be repeated
    #[arg(long, value_name = "NAME=PIGMENT,..")]
    group: Vec<String>,
    /// Map each pigment by itself, also those that the bands cannot tell apart
    #[arg(long)]
    apart: bool,
    /// Standard deviation of the noise of a band, as a fraction [default: that of the white reading, else
    /// 0.003]
    #[arg(long, value_name = "SD")]
    noise: Option<f64>,
    /// Errors of mixtures that the library had not seen, from `impasto validate READINGS --residuals FILE`
    /// [default: for the oils that ship their own]
    #[arg(long, value_name = "FILE")]
    residuals: Option<PathBuf>,
    /// How far K and S of the library may be off, as a fraction [default: 0.1 for a library without
    /// residuals]
    #[arg(long, value_name = "0.05", conflicts_with = "residuals")]
    model_error: Option<f64>,
    /// The bare ground, whose pixels are told as ground rather than mapped as paint: rows and columns of the scan,
    /// such as 0..20,0..100, or a file with its reflectance
    #[arg(long, value_name = "ROWS,COLUMNS|FILE")]
    ground: Option<String>,
    /// Amount by which a pigment that the survey does not find in the palette must lower chi-square to be told
    /// [default: 2]
    #[arg(long, value_name = "N")]
    penalty: Option<f64>,
}

impl PigmentOptions {
    /// Settings of a map of the scan `cube` with `library`.
    fn settings(&self, cube: &Cube, library: &PigmentLibrary) -> Result<MapSettings> {
        let usual = MapSettings::default();
        let groups = self.group.iter().map(|text| group(text)).collect::<Result<_>>()?;
        let of_white = cube.noise_of_white().map(|noise| noise.max(usual.sensor_noise));
        let residuals = self.residuals.as_ref().map(|path| -> Result<ModelError> {
            Ok(ModelError::Residuals(Residuals::open(path)?))
        });
        let stated = self.model_error.map(ModelError::Stated);
        let settings = MapSettings {
            at_most: self.at_most.unwrap_or(usual.at_most),
            palette: self.palette.clone(),
            groups,
            group_alike: !self.apart,
            sensor_noise: self.noise.or(of_white).unwrap_or(usual.sensor_noise),
            penalty: self.penalty.unwrap_or(usual.penalty),
            model_error: residuals.transpose()?.or(stated),
            ground: self.ground.as_deref().map(|text| ground(text, cube)).transpose()?,
        };
        if let (Err(error), Some(path)) = (settings.model_error_of(library), &self.residuals) {
            return Err(Failure::from(error).within(format!("{} cannot be used", path.display())));
        }
        Ok(settings)
    }

    /// Remark on a library about whose errors nothing is known.
    fn remark(&self, scan: &SurveyedScan) -> Option<Remark> {
        let assumed = self.model_error.is_none()
            && matches!(scan.mapper().model_error(), ModelError::Stated(_));
        assumed.then(|| {
            let words = scan.mapper().model_error().words();
            Remark::note(format!("this library is taken to have {words}")).with_hint(
                "`impasto validate READINGS [residuals=FILE.json]` measures its errors, and [residuals=FILE.json] gives them to the map",
            )
        })
    }
}

/// The ground of a map: the mean of a region of the scan, or the reflectance in a file.
fn ground(text: &str, cube: &Cube) -> Result<Ground> {
    if let Some(region) = rectangle(text) {
        return Ok(region.ground(cube)?);
    }
    let opened = spectra::read_spectrum(text)
        .map_err(|error| Failure::from(error).within("--ground takes a region or a file"))?;
    let reflectance = opened.spectrum.reflectance().map_err(Failure::from)?;
    let nm = reflectance.grid().wavelengths_nm().collect();
    Ok(Ground::new(nm, reflectance.values().to_vec())?)
}

/// Parses `ROWS,COLUMNS`, each `FIRST..END`; `None` for any other text.
fn rectangle(text: &str) -> Option<Region> {
    let range = |part: &str| {
        let (first, end) = part.split_once("..")?;
        Some(first.trim().parse().ok()?..end.trim().parse().ok()?)
    };
    let (rows, columns) = text.split_once(',')?;
    Some(Region { rows: range(rows)?, columns: range(columns)? })
}

/// Parses a group, `NAME=PIGMENT,..`.
fn group(text: &str) -> Result<PigmentGroup> {
    let found = text.split_once('=').map(|(name, pigments)| PigmentGroup {
        name: name.trim().to_owned(),
        pigments: pigments.split(',').map(|name| name.trim().to_owned()).collect(),
    });
    found
        .filter(|group: &PigmentGroup| {
            !group.name.is_empty() && group.pigments.iter().all(|name| !name.is_empty())
        })
        .ok_or_else(|| {
            Failure::usage(
                format!("--group takes NAME=PIGMENT,PIGMENT.., found `{text}`"),
                "try --group \"whites=Lead White,Zinc White\"",
            )
        })
}

/// How the scan is read.
#[derive(Debug, Args)]
#[command(next_help_heading = "Reading the scan")]
struct ScanOptions {
    /// Values are in percent [default: by the file]
    #[arg(long, conflicts_with = "fraction")]
    percent: bool,
    /// Values are fractions, a white near 1
    #[arg(long)]
    fraction: bool,
    /// A scan of a white, for scans of raw counts
    #[arg(long, value_name = "SCAN")]
    white_reading: Option<PathBuf>,
    /// A scan with the shutter closed; 0 if it is subtracted already
    #[arg(long, value_name = "SCAN", requires = "white_reading")]
    dark_reading: Option<PathBuf>,
    /// The white's own reflectance [default: 1]
    #[arg(long, value_name = "0.99", requires = "white_reading")]
    tile: Option<f64>,
    /// Largest count of the detector, such as 4095 [default: guessed]
    #[arg(long, value_name = "COUNT")]
    full_scale: Option<f64>,
    /// File with the wavelength of each band in nm, for scans that name none
    #[arg(long, value_name = "FILE")]
    wavelengths: Option<PathBuf>,
    /// Name of the array of a Zarr group that holds several
    #[arg(long, value_name = "NAME")]
    variable: Option<String>,
}

impl ScanOptions {
    /// Opens the scan at `path`.
    fn cube(&self, path: &Path) -> Result<Cube> {
        if self.tile.is_some_and(|tile| !(tile > 0.0 && tile <= 1.2)) {
            return Err(Failure::usage(
                "--tile takes the reflectance of the white, above 0 and up to 1.2",
                "leave it out for a white that reflects everything",
            ));
        }
        let dark_reading = match &self.dark_reading {
            None => DarkReading::Missing,
            Some(path) if path.as_os_str() == "0" => DarkReading::Subtracted,
            Some(path) => DarkReading::File(path.clone()),
        };
        let options = CubeOptions {
            white_reading: self.white_reading.clone(),
            dark_reading,
            tile: self.tile.unwrap_or(1.0),
            scale: match (self.percent, self.fraction) {
                (true, _) => CubeScale::Percent,
                (_, true) => CubeScale::Fraction,
                _ => CubeScale::ByFile,
            },
            full_scale: self.full_scale,
            wavelengths: self.wavelengths.clone(),
            variable: self.variable.clone(),
            scratch: None,
        };
        Ok(Cube::open_with(path, &options)?)
    }
}

/// Part of the pixels below which a pigment is not named in the text.
const NAMED: f64 = 0.001;

/// A row for each kind of pixels.
fn rows(compared: &Comparison) -> Vec<Value> {
    let row = |row: &maps::truth::ComparisonRow| {
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
    };
    compared.rows.iter().map(row).collect()
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

/// Prints a line for each kind of pixels, then one for each pigment that is there or told.
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
    let width = named.iter().map(|pigment| pigment.name.chars().count()).max().unwrap_or(0).max(7);
    console.line(format!("{:width$}  there  told  rightly told (% of the pixels)", "pigment"))?;
    for pigment in named {
        let [there, told, right] =
            [pigment.there, pigment.told, pigment.right].map(|part| 100.0 * part);
        let name = &pigment.name;
        console.line(format!("{name:width$}  {there:5.1} {told:5.1} {right:5.1}"))?;
    }
    Ok(())
}

/// Part of the surveyed pixels below which a pigment is not named in the text.
const MOST_NAMED: f64 = 0.001;

/// Place of a pigment in the maps.
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
    let width = named.iter().map(|found| found.column.name.chars().count()).max().unwrap_or(0);
    let width = width.max("pigment".len());
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
