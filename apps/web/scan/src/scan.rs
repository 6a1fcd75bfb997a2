//! A scan of the page: opened, surveyed and mapped with a library.

use maps::cube::{Block, CubeOptions, ScanFile};
use maps::pictures::OverviewSums;
use maps::{Cube, MapRequest, Region, SURVEYED, Spot, SurveyedScan};
use pigment::PigmentLibrary;
use serde_json::json;
use told::stage;
use wasm_bindgen::prelude::*;

use crate::failure::{CONTROLS, Result, Told, remarks, request};
use crate::mapped::Mapped;
use crate::slices::scan_files;

/// Bytes of the values that are read at once.
const BLOCK_BYTES: usize = 64 << 20;
/// Most pixels that are mapped at once, so that progress is reported often.
const MOST_PIXELS: usize = 4096;
/// Most bytes for the sums of all maps.
const SUM_BYTES: usize = 256 << 20;
/// Pictures show pixels in squares, at most this many along the longer side, as in the program.
const PICTURE: usize = 1600;

/// A scan of the page, with the library for its maps.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Scan {
    files: Vec<ScanFile>,
    options: CubeOptions,
    told: String,
    library: Option<PigmentLibrary>,
    surveyed: Option<SurveyedScan>,
}

#[wasm_bindgen]
impl Scan {
    /// Opens the scan of the worker's files with these names and sizes.
    #[wasm_bindgen(constructor)]
    pub fn open(names: Vec<String>, sizes: &[f64], reading: &str) -> Result<Scan> {
        let options: CubeOptions = request(reading)?;
        let files = scan_files(names, sizes);
        let cube = Cube::of_files(&files, &options).told()?;
        let told = json!({
            "name": cube.path().display().to_string(),
            "lines": cube.lines(),
            "samples": cube.samples(),
            "wavelengths_nm": cube.wavelengths_nm(),
            "remarks": remarks(cube.remarks(), &CONTROLS),
        });
        Ok(Self { files, options, told: told.to_string(), library: None, surveyed: None })
    }

    /// Sizes, wavelengths and remarks as JSON.
    pub fn about(&self) -> String {
        self.told.clone()
    }

    /// Surveys the scan with the library in the file `name`, and maps every `every`-th pixel of every
    /// `every`-th row. Reports progress to the page.
    pub fn map(
        &mut self,
        name: &str,
        library: &[u8],
        request_json: &str,
        every: usize,
    ) -> Result<Mapped> {
        let chosen: MapRequest = request(request_json)?;
        let library = PigmentLibrary::from_json(name, &String::from_utf8_lossy(library)).told()?;
        // Frees the memory of an earlier run first.
        self.surveyed = None;
        let cube = Cube::of_files(&self.files, &self.options).told()?;
        let (rows, columns) = match &chosen.region {
            Some(region) => (region.rows.len(), region.columns.len()),
            None => (cube.lines(), cube.samples()),
        };
        let about = rows.saturating_mul(columns).min(SURVEYED);
        let task = told::task_in_percent("surveying", about);
        let scan = chosen.survey(cube, &library, None, &task).told()?;
        let every = every.max(1);
        let sums = map_all(&scan, every)?;
        stage("drawing");
        let mapped = Mapped::of(&scan, &sums.finish(), &library, every)?;
        (self.library, self.surveyed) = (Some(library), Some(scan));
        Ok(mapped)
    }

    /// The spot with these rows and columns, as JSON with the keys of a spot of `impasto map --json`, and
    /// its text as `words`.
    pub fn spot(&self, top: usize, bottom: usize, left: usize, right: usize) -> Result<String> {
        let (Some(library), Some(scan)) = (&self.library, &self.surveyed) else {
            return Err(told::setting("no scan is mapped yet", "map one"));
        };
        let spot: Spot =
            scan.spot(library, Region { rows: top..bottom, columns: left..right }).told()?;
        let mut json = spot.to_json();
        json["words"] = json!(spot.words());
        Ok(json.to_string())
    }
}

/// Maps every `every`-th pixel of every `every`-th row of the surveyed region, in blocks of rows.
fn map_all(scan: &SurveyedScan, every: usize) -> Result<OverviewSums> {
    let rows = scan.about().rows.clone();
    let columns = scan.about().columns.clone();
    let height = rows.len().div_ceil(every);
    let width = columns.len().div_ceil(every);
    let pigments = &scan.about().pigments;
    let mut sums =
        OverviewSums::new(pigments, (height, width), longest((height, width), pigments.len()));
    let together = scan.cube().rows_within(BLOCK_BYTES, columns.len());
    let together = together.min((MOST_PIXELS / width).max(1));
    let all = height * width;
    let task = told::task_in_percent("mapping", all);
    let mut block = Block::default();
    let mut row = Block::default();
    for start in (0..height).step_by(together) {
        let end = (start + together).min(height);
        let first = rows.start + start * every;
        if every == 1 {
            scan.cube().read_into(first..rows.start + end, columns.clone(), &mut block).told()?;
        } else {
            block.values.clear();
            block.mask.clear();
            for line in (start..end).map(|line| rows.start + line * every) {
                scan.cube().read_into(line..line + 1, columns.clone(), &mut row).told()?;
                for (values, mask) in row.iter().step_by(every) {
                    block.values.extend_from_slice(values);
                    block.mask.push(mask);
                }
            }
            block.bands = row.bands;
        }
        let mapped = scan.map_block(&block).told()?;
        sums.add(start..end, 0..width, &mapped.as_kept());
        task.done((end * width) as u64, all as u64);
    }
    Ok(sums)
}

/// Number of squares along the longer side of the pictures: at most [`PICTURE`], fewer if the sums would
/// need too much memory.
fn longest((height, width): (usize, usize), pigments: usize) -> usize {
    let long = height.max(width);
    let mut step = long.div_ceil(PICTURE).max(1);
    while (height.div_ceil(step) * width.div_ceil(step)).saturating_mul(pigments * 16) > SUM_BYTES {
        step += 1;
    }
    long.div_ceil(step)
}
