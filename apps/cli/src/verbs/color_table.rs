//! Table and rows of the colours of measured spectra.

use calibrate::IlluminantChange;
use calibrate::evaluate::Viewing;
use clap::ValueEnum;
use serde_json::{Value, json};
use spectra::color::{
    ColorDifferences, Lab, Rgb, RgbSpace, Whiteness, WhitenessError, Xyz, metamerism_index,
};

use crate::console::Console;
use crate::decimals::rounded;
use crate::failure::Result;
use crate::shown_color::TableColors;

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
    /// Spectrum from which differences are told.
    pub(super) standard: Option<Row>,
    pub(super) space: RgbSpace,
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
        let longest = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0);
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
            console.line(format!("{line}  {}", colors.cell(*rgb, console)).trim_end())?;
        }
        colors.note("", console)?;
        for note in notes {
            console.line(note)?;
        }
        if apart && self.standard.is_some() {
            let width = name_width(longest, 1 + differences.len());
            console.line(format!("{:width$} {differences}", "sample"))?;
            for row in rows {
                console.line(named(&row.name, width) + &self.differences(row, light))?;
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
            let width = self.change_heading(light).chars().count().max(10);
            let index = self.metamerism(standard, row, light);
            cells += &index.map_or_else(
                || format!("  {:>width$}", "-"),
                |index| format!("  {index:width$.2}"),
            );
        }
        cells
    }

    fn change_to(&self, light: usize) -> IlluminantChange<'_> {
        let name = |at: usize| self.lights[at].illuminant.name();
        IlluminantChange { reference: name(0), test: name(light) }
    }

    fn change_heading(&self, light: usize) -> String {
        format!("metamerism {}", self.change_to(light).heading())
    }

    /// Metamerism index of `row` against the standard for the change from the first light to `light`.
    fn metamerism(&self, standard: &Row, row: &Row, light: usize) -> Option<f64> {
        let pair = |row: &Row| [row.colors[0].xyz, row.colors[light].xyz];
        metamerism_index(pair(standard), pair(row), self.whites[light]).ok()
    }

    fn whiteness(&self, xyz: Xyz, light: usize) -> std::result::Result<Whiteness, WhitenessError> {
        let Viewing { illuminant, observer } = &self.lights[light];
        Whiteness::of(xyz, self.whites[light], illuminant, *observer)
    }
}

/// Width of the column of names of which the longest has this many letters, beside `taken` others.
fn name_width(longest: usize, taken: usize) -> usize {
    longest.min(WIDEST.saturating_sub(taken)).max("sample".len())
}

/// A name in a column of this width, and a blank. A longer one has a line of its own.
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
        Err(WhitenessError::NotWhite { .. } | WhitenessError::Tinted { .. }) => {
            ("not white".to_owned(), NOT_WHITE.to_owned())
        }
        Err(other) => (format!("{:>7} {:>7}", "-", "-"), other.to_string()),
    };
    if !notes.contains(&note) {
        notes.push(note);
    }
    format!(" {cells:>15}")
}
