//! `impasto map`: which pigments of a library are where in a spectral scan.

mod pigment_options;
mod scan_options;
mod told;
mod page;
mod truth;

use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::Args;
use maps::pictures::Overview;
use maps::truth::{Truth, compare};
use maps::{Book, Region, Spot, StoreMode, StoredMaps, SurveyedScan};

use crate::console::Console;
use crate::failure::{Context, Failure, Result};
use crate::library_choice::chosen;
use crate::output::OutputFolder;
use crate::progress::{Progress, Waiting};
use pigment_options::{PigmentOptions, rectangle};
use scan_options::ScanOptions;

/// Squares along the longer side of the pictures.
const PICTURE: usize = 1600;
/// Steps of the progress bar.
const STEPS: u64 = 1000;

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
                let book = Book::from_json(&crate::input::text(path)?)
                    .context(|| format!("{} cannot be used", path.display()))?;
                SurveyedScan::with_book(cube, &library, &settings, region, book)?
            }
            None => SurveyedScan::survey(cube, &library, &settings, region, &|| {
                ControlFlow::Continue(())
            })?,
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
                Some(compared) => truth::rows(compared),
                None => scan.palette_json(mapped.as_ref()),
            });
        }
        if self.json {
            let mut json = scan.to_json(mapped.as_ref(), &spots);
            json["truth"] = compared.as_ref().map(truth::json).into();
            return console.json(&json);
        }
        told::print(&scan, mapped.as_ref(), console)?;
        if let Some(compared) = &compared {
            truth::print(compared, console)?;
        }
        told::print_spots(&spots, console)?;
        if self.output.is_none() {
            console.remark("Wrote no maps; give --output maps.zarr to map every pixel")?;
        }
        Ok(())
    }

    /// Maps every pixel that is not mapped yet.
    fn map(&self, scan: &SurveyedScan, output: &PathBuf, console: &mut Console<'_>) -> Result<()> {
        let mode = if self.resume { StoreMode::Resume } else { StoreMode::New };
        let store = scan.store(output, mode)?;
        let bar = Progress::new(STEPS as usize, "mapping", console.shows_progress());
        let mut steps = 0;
        let outcome = scan.map(&store, |state| {
            while steps < STEPS * state.done / state.all.max(1) {
                bar.step();
                steps += 1;
            }
            ControlFlow::Continue(())
        });
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
