//! `impasto color` prints colours of measured spectra in several systems, and colour differences,
//! as a table or as rows.

use std::path::{Path, PathBuf};

use calibrate::IlluminantChange;
use calibrate::evaluate::Viewing;
use calibrate::measurement::AveragedSpectrum;
use clap::{Args, ValueEnum};
use documents::column_width;
use documents::file::is_there;
use serde_json::{Value, json};

use super::against::Against;
use crate::console::Console;
use crate::csv_rows::{TableColors, rounded};
use crate::failure::{Failure, Result};
use crate::readings::{ReadingOptions, remark_color, spectra, viewing};
use spectra::TristimulusWeights;
use spectra::color::{
    Adaptation, ColorDifferences, Lab, Rgb, RgbSpace, RgbSpace as ColorTableRgbSpace, Whiteness,
    WhitenessError, Xyz, metamerism_index,
};
use spectra::instrument::{split_file_and_name, split_file_and_sheet};

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SpaceName {
    Srgb,
    P3,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum AdaptationName {
    Bradford,
    Cat16,
}

/// Colour of measured spectra under any light, and differences between them
///
/// Reads what `fit` reads: the CSV, whose pigment columns do not matter here, or an instrument's
/// file (see --format). Repeated readings of one sample on one backing are averaged, but never those
/// of several files, geometries or sides: these are samples of their own. Several lights may be
/// given; with --compare the metamerism index (change of illuminant from the first light) is printed
/// for each later one. --against compares two sets of measurements sample by sample.
#[derive(Debug, Args)]
#[command(mut_arg("white_reading", |option| option.alias("white")))]
pub(crate) struct Color {
    /// Spectra: a CSV (column `sample`, then wavelengths), or an instrument's file
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Light (may be repeated): a CIE illuminant, 5600K, D5600K, or a lamp's file (an instrument's,
    /// FILE#NAME for one of several spectra, or lines `nm,power`)
    #[arg(long, value_name = "LIGHT", default_value = "D65")]
    illuminant: Vec<String>,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
    /// Only these samples (may be repeated)
    #[arg(long, value_name = "SAMPLE")]
    sample: Vec<String>,
    /// Print the difference of every spectrum from this one
    #[arg(long, value_name = "SAMPLE")]
    compare: Option<String>,
    /// Compare each sample with the sample of the same name in this file (may be repeated)
    ///
    /// Prints CIEDE2000 of each sample, the mean, the 95th percentile, the largest, and the mean shift
    /// in L*, a* and b*. JSON: a list by light of illuminant, observer, samples, mean, p95, max, shift,
    /// tolerance, failed, only_first, only_second.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["compare", "sample", "show"])]
    against: Vec<PathBuf>,
    /// Largest CIEDE2000 that passes; a sample beyond it ends with exit status 1
    #[arg(long, value_name = "CIEDE2000", requires = "against")]
    tolerance: Option<f64>,
    /// RGB space of `srgb` and `hex`
    #[arg(long, value_enum, default_value = "srgb")]
    space: SpaceName,
    /// Adaptation from the light's white to the display's
    #[arg(long, value_enum, default_value = "bradford")]
    adaptation: AdaptationName,
    #[command(flatten)]
    reading: ReadingOptions,
    /// Columns of the table; JSON and CSV hold all
    ///
    /// `whiteness` is W and T of CIE 15:2018, for whites under D65 or C only.
    #[arg(
        long,
        value_enum,
        value_name = "COLUMNS",
        value_delimiter = ',',
        default_value = "xyz,lab"
    )]
    show: Vec<ColumnName>,
    /// Print JSON: a list of sample, xyz, xy, lab, chroma, hue_deg, whiteness, tint,
    /// whiteness_note, srgb, hex, in_gamut
    #[arg(long)]
    json: bool,
    /// Print the table as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Color {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let lights = self
            .illuminant
            .iter()
            .map(|light| viewing(light, &self.observer, console))
            .collect::<Result<Vec<Viewing>>>()?;
        self.files.iter().try_for_each(|file| refuse_sample(file))?;
        if !self.against.is_empty() {
            let against = Against {
                files: &self.files,
                against: &self.against,
                lights: &lights,
                tolerance: self.tolerance,
                reading: &self.reading,
                json: self.json,
                csv: self.csv,
            };
            return against.run(console);
        }
        let table = spectra(&self.files, &self.reading, console)?;
        remark_color(table.grid, console)?;
        let weights = lights
            .iter()
            .map(|viewing| viewing.weights(table.grid))
            .collect::<Result<Vec<_>, _>>()?;
        let space = match self.space {
            SpaceName::Srgb => RgbSpace::Srgb,
            SpaceName::P3 => RgbSpace::DisplayP3,
        };
        let adaptation = match self.adaptation {
            AdaptationName::Bradford => Adaptation::Bradford,
            AdaptationName::Cat16 => Adaptation::Cat16,
        };
        let averaged = table.averaged();
        let row = |spectrum: &AveragedSpectrum| Row {
            name: spectrum.name.clone(),
            colors: weights
                .iter()
                .map(|weights| {
                    let xyz = weights.xyz(&spectrum.reflectance);
                    let white = weights.white();
                    SpectrumColor {
                        xyz,
                        lab: Lab::from_xyz(xyz, white),
                        rgb: space.encoded_from_xyz(xyz, white, adaptation),
                    }
                })
                .collect(),
        };
        let standard = self.compare.as_ref().map(|name| averaged.find_one(name)).transpose()?;
        let standard = standard.map(row);
        let mut selected: Vec<Row> = Vec::new();
        for name in &self.sample {
            selected.extend(averaged.find(name)?.into_iter().map(row));
        }
        if self.sample.is_empty() {
            selected.extend(averaged.spectra.iter().map(row));
        }
        let table = ColorTable {
            whites: weights.iter().map(TristimulusWeights::white).collect(),
            lights,
            standard,
            space,
            columns: self.show,
        };
        if self.json || self.csv {
            let mut list: Vec<Value> = Vec::new();
            for row in &selected {
                list.extend((0..table.lights.len()).map(|light| table.entry(row, light)));
            }
            return match self.csv {
                true => console.csv_rows(&list),
                false => console.json(&Value::from(list)),
            };
        }
        for light in 0..table.lights.len() {
            table.print(&selected, light, console)?;
        }
        Ok(())
    }
}

/// Refuses FILE#SAMPLE, which other verbs take, and says that you can use the option `--sample`.
fn refuse_sample(path: &Path) -> Result<()> {
    let text = path.display().to_string();
    let is_sheet = split_file_and_sheet(&text).1.is_some();
    match split_file_and_name(&text) {
        (file, Some(name)) if !is_sheet && is_there(Path::new(file)) => {
            let reason = format!("a file is read as a whole, found `{text}`");
            Err(Failure::usage(reason, format!("for one sample: {file} --sample \"{name}\"")))
        }
        _ => Ok(()),
    }
}

/// Note below a table with spectra that have no whiteness.
const NOT_WHITE: &str =
    "not white: outside of 40 < W < 5 Y - 280 and -4 < T < 2, the whites of CIE 15:2018, 9.4";

/// Heading of the last column, as wide as its cells.
const DISPLAY: &str = "  display ";

/// Width of a patch of colour with its blank.
const PATCH: usize = 7;

/// Width that a table keeps within, in letters.
const WIDEST: usize = 100;

/// Columns that can be shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ColumnName {
    /// Tristimulus values, 100 for the white
    Xyz,
    /// Chromaticity x, y and luminance factor Y
    Xyy,
    /// CIELAB as L*, a* and b*
    Lab,
    /// CIELAB as lightness, chroma C* and hue angle h in degrees
    Lch,
    /// CIE whiteness W and tint T
    Whiteness,
}

/// Name and colours of one spectrum, one colour per light.
pub(super) struct Row {
    pub(super) name: String,
    pub(super) colors: Vec<SpectrumColor>,
}

/// Colour of one spectrum under one light.
pub(super) struct SpectrumColor {
    pub(super) xyz: Xyz,
    pub(super) lab: Lab,
    pub(super) rgb: Rgb,
}

/// Lights, standard and columns of the printed table.
pub(super) struct ColorTable {
    pub(super) lights: Vec<Viewing>,
    /// White point of each light.
    pub(super) whites: Vec<Xyz>,
    /// We print differences from this spectrum.
    pub(super) standard: Option<Row>,
    pub(super) space: ColorTableRgbSpace,
    pub(super) columns: Vec<ColumnName>,
}

impl ColorTable {
    /// The colour of `row` under one light, as JSON.
    pub(super) fn entry(&self, row: &Row, light: usize) -> Value {
        let SpectrumColor { xyz, lab, rgb } = &row.colors[light];
        let xyy = xyz.to_xyy(self.whites[light]);
        let lch = lab.to_lch();
        let whiteness = self.whiteness(*xyz, light);
        let mut entry = json!({
            "sample": row.name,
            "xyz": xyz.to_array(),
            "xy": [xyy.x, xyy.y],
            "lab": lab.to_array(),
            "chroma": lch.chroma,
            "hue_deg": lch.hue_degrees,
            "whiteness": whiteness.as_ref().ok().map(|found| found.whiteness),
            "tint": whiteness.as_ref().ok().map(|found| found.tint),
            "whiteness_note": whiteness.as_ref().err().map(ToString::to_string),
            "srgb": rgb.0,
            "hex": rgb.to_hex(),
            "in_gamut": rgb.in_gamut(),
        });
        if self.lights.len() > 1 {
            entry["illuminant"] = json!(self.lights[light].illuminant.name());
        }
        if let Some(standard) = &self.standard {
            let difference = ColorDifferences::between(standard.colors[light].lab, *lab);
            entry["difference"] = json!({
                "from": standard.name,
                "ciede2000": difference.ciede2000,
                "cie1976": difference.cie1976,
                "cie94": difference.cie94,
                "cmc_2_1": difference.cmc_2_1,
            });
            if light > 0 {
                let index = self.metamerism(standard, row, light);
                entry["metamerism"] = self.change_to(light).to_json(index);
            }
        }
        entry
    }

    /// Prints the rows under one light, with the differences from the standard in a table of their own
    /// where they have no room beside the colours.
    pub(super) fn print(
        &self,
        rows: &[Row],
        light: usize,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let Viewing { illuminant, observer } = &self.lights[light];
        console.line(format!("{}, observer {observer}", illuminant.name()))?;
        if self.standard.is_some() && light > 0 {
            console.line(IlluminantChange::LEGEND)?;
        }
        let colors = self.heading();
        let differences = self.differences_heading(light);
        let longest = column_width(rows.iter().map(|row| &row.name), 0);
        let patch = if console.screen.colors { PATCH } else { 0 };
        let display = DISPLAY.len() + patch;
        let apart = longest + 1 + colors.len() + differences.len() + display > WIDEST;
        let beside = if apart { "" } else { differences.as_str() };
        let taken = 1 + colors.len() + beside.len() + display;
        let width = name_width(longest, taken);
        let heading = format!("{:width$} {colors}{beside}{DISPLAY}", "sample");
        console.line(heading.trim_end())?;
        let mut colors = TableColors::of(self.space);
        let mut notes: Vec<String> = Vec::new();
        for row in rows {
            let SpectrumColor { xyz, lab, rgb } = &row.colors[light];
            let mut line = named(&row.name, width);
            for column in &self.columns {
                line += &match column {
                    ColumnName::Xyz => decimals(&xyz.to_array(), 2),
                    ColumnName::Xyy => {
                        let xyy = xyz.to_xyy(self.whites[light]);
                        decimals(&[xyy.x, xyy.y], 4) + &decimals(&[xyy.luminance], 2)
                    }
                    ColumnName::Lab => decimals(&lab.to_array(), 2),
                    ColumnName::Lch => {
                        let lch = lab.to_lch();
                        decimals(&[lch.lightness, lch.chroma], 2) + &decimals(&[lch.hue_degrees], 1)
                    }
                    ColumnName::Whiteness => {
                        whiteness_cells(self.whiteness(*xyz, light), &mut notes)
                    }
                };
            }
            if !apart {
                line += &self.differences(row, light);
            }
            console.lines(format!("{line}  {}", colors.cell(*rgb, console)).trim_end())?;
        }
        colors.note("", console)?;
        for note in notes {
            console.line(note)?;
        }
        if apart && self.standard.is_some() {
            let width = name_width(longest, 1 + differences.len());
            console.line(format!("{:width$} {differences}", "sample"))?;
            for row in rows {
                console.lines(named(&row.name, width) + &self.differences(row, light))?;
            }
        }
        Ok(())
    }

    fn heading(&self) -> String {
        let mut heading = String::new();
        for column in &self.columns {
            heading += match column {
                ColumnName::Xyz => "       X       Y       Z",
                ColumnName::Xyy => "       x       y       Y",
                ColumnName::Lab => "      L*      a*      b*",
                ColumnName::Lch => "      L*      C*       h",
                ColumnName::Whiteness => "       W       T",
            };
        }
        heading
    }

    fn differences_heading(&self, light: usize) -> String {
        if self.standard.is_none() {
            return String::new();
        }
        let heading = "  CIEDE2000  CIE76  CIE94  CMC2:1".to_owned();
        match light {
            0 => heading,
            _ => heading + &format!("  {:>10}", self.change_heading(light)),
        }
    }

    /// Cells of the differences from the standard, with the metamerism index under later lights.
    fn differences(&self, row: &Row, light: usize) -> String {
        let Some(standard) = &self.standard else { return String::new() };
        let difference =
            ColorDifferences::between(standard.colors[light].lab, row.colors[light].lab);
        let mut cells = format!(
            "  {:9.2} {:6.2} {:6.2}  {:6.2}",
            difference.ciede2000, difference.cie1976, difference.cie94, difference.cmc_2_1,
        );
        if light > 0 {
            let width = column_width([self.change_heading(light)], 10);
            let index = self.metamerism(standard, row, light);
            cells += &index.map_or_else(
                || format!("  {:>width$}", "-"),
                |index| format!("  {index:width$.2}"),
            );
        }
        cells
    }

    fn change_to(&self, light: usize) -> IlluminantChange<'_> {
        let [reference, test] = [0, light].map(|at: usize| self.lights[at].illuminant.name());
        IlluminantChange { reference, test }
    }

    fn change_heading(&self, light: usize) -> String {
        format!("metamerism {}", self.change_to(light).heading())
    }

    /// Metamerism index of `row` against the standard for the change from the first light to `light`.
    fn metamerism(&self, standard: &Row, row: &Row, light: usize) -> Option<f64> {
        let [standard, row] =
            [standard, row].map(|row: &Row| [row.colors[0].xyz, row.colors[light].xyz]);
        metamerism_index(standard, row, self.whites[light]).ok()
    }

    fn whiteness(&self, xyz: Xyz, light: usize) -> std::result::Result<Whiteness, WhitenessError> {
        let Viewing { illuminant, observer } = &self.lights[light];
        Whiteness::of(xyz, self.whites[light], illuminant, *observer)
    }
}

/// Width of the column of names. The longest name has `longest` letters, and the other columns take
/// `taken`.
fn name_width(longest: usize, taken: usize) -> usize {
    longest.min(WIDEST.saturating_sub(taken)).max("sample".len())
}

/// Pads a name to a column of this width, with a blank behind it. A longer name gets a line of its
/// own.
fn named(name: &str, width: usize) -> String {
    match name.chars().count() > width {
        true => format!("{name}\n{:width$} ", ""),
        false => format!("{name:width$} "),
    }
}

/// Cells of 7 columns with a blank before each.
fn decimals(values: &[f64], places: usize) -> String {
    values.iter().map(|value| format!(" {:>7}", rounded(*value, places))).collect()
}

/// Cells of whiteness and tint, or why there are none.
fn whiteness_cells(
    found: std::result::Result<Whiteness, WhitenessError>,
    notes: &mut Vec<String>,
) -> String {
    let (cells, note) = match found {
        Ok(found) => return decimals(&[found.whiteness, found.tint], 2),
        Err(WhitenessError::NotWhite { .. } | WhitenessError::Tinted(..)) => {
            ("not white".to_owned(), NOT_WHITE.to_owned())
        }
        Err(other) => (format!("{:>7} {:>7}", "-", "-"), other.to_string()),
    };
    if !notes.contains(&note) {
        notes.push(note);
    }
    format!(" {cells:>15}")
}
