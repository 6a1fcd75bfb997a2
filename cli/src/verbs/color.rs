//! `impasto color`: XYZ, Lab and sRGB of measured spectra, and colour differences.

use std::path::PathBuf;

use calibrate::evaluate::Viewing;
use calibrate::measurement::AveragedSpectrum;
use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use spectra::TristimulusWeights;
use spectra::color::{Adaptation, ColorDifferences, Lab, Rgb, RgbSpace, Xyz, metamerism_index};

use super::mix::gamut_note;
use crate::console::Console;
use crate::failure::Result;
use crate::input::{remark_coverage, viewing};
use crate::readings::{ReadingOptions, spectra};

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
/// file (see --format). Repeated readings of one sample on one backing are averaged. Several lights
/// may be given; with --compare the metamerism index (change of illuminant from the first light) is
/// printed for each later one.
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
    /// RGB space of `srgb` and `hex`
    #[arg(long, value_enum, default_value = "srgb")]
    space: SpaceName,
    /// Adaptation from the light's white to the display's
    #[arg(long, value_enum, default_value = "bradford")]
    adaptation: AdaptationName,
    #[command(flatten)]
    reading: ReadingOptions,
    /// Print JSON: a list of sample, xyz, lab, srgb, hex
    #[arg(long)]
    json: bool,
    /// Print the table as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

/// Name and colours of one spectrum, one colour per light.
struct Row {
    name: String,
    colors: Vec<SpectrumColor>,
}

/// Colour of one spectrum under one light.
struct SpectrumColor {
    xyz: Xyz,
    lab: Lab,
    rgb: Rgb,
}

impl Color {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let lights = self
            .illuminant
            .iter()
            .map(|light| viewing(light, &self.observer))
            .collect::<Result<Vec<Viewing>>>()?;
        let table = spectra(&self.files, &self.reading, console)?;
        remark_coverage(table.grid, console)?;
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
        let standard = standard.as_ref();
        let mut selected: Vec<Row> = Vec::new();
        for name in &self.sample {
            selected.extend(averaged.find(name)?.into_iter().map(row));
        }
        if self.sample.is_empty() {
            selected.extend(averaged.spectra.iter().map(row));
        }
        let whites: Vec<Xyz> = weights.iter().map(TristimulusWeights::white).collect();
        if self.json || self.csv {
            let mut list = Vec::new();
            for row in selected {
                for light in 0..lights.len() {
                    list.push(entry(&row, light, standard, &lights, &whites));
                }
            }
            return match self.csv {
                true => console.csv_rows(&list),
                false => console.json(&Value::from(list)),
            };
        }
        for (light, viewing) in lights.iter().enumerate() {
            console.line(format!(
                "{}, observer {}",
                viewing.illuminant.name(),
                viewing.observer
            ))?;
            print(&selected, light, standard, &whites, console)?;
        }
        Ok(())
    }
}

fn entry(
    row: &Row,
    light: usize,
    standard: Option<&Row>,
    lights: &[Viewing],
    whites: &[Xyz],
) -> Value {
    let SpectrumColor { xyz, lab, rgb } = &row.colors[light];
    let mut entry = json!({
        "sample": row.name,
        "xyz": xyz.to_array(),
        "lab": lab.to_array(),
        "srgb": rgb.0,
        "hex": rgb.to_hex(),
    });
    if lights.len() > 1 {
        entry["illuminant"] = json!(lights[light].illuminant.name());
    }
    if let Some(standard) = standard {
        let difference = ColorDifferences::between(standard.colors[light].lab, *lab);
        entry["difference"] = json!({
            "from": standard.name,
            "ciede2000": difference.ciede2000,
            "cie1976": difference.cie1976,
            "cie94": difference.cie94,
            "cmc_2_1": difference.cmc_2_1,
        });
        if light > 0 {
            entry["metamerism"] = json!(metamerism(standard, row, light, whites));
        }
    }
    entry
}

/// Metamerism index of `row` against `standard` for the change from the first light to `light`.
fn metamerism(standard: &Row, row: &Row, light: usize, whites: &[Xyz]) -> Option<f64> {
    let pair = |row: &Row| [row.colors[0].xyz, row.colors[light].xyz];
    metamerism_index(pair(standard), pair(row), whites[light]).ok()
}

fn print(
    rows: &[Row],
    light: usize,
    standard: Option<&Row>,
    whites: &[Xyz],
    console: &mut Console<'_>,
) -> Result<()> {
    let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0).max(6);
    let mut heading =
        format!("{:width$}        X       Y       Z      L*      a*      b*", "sample");
    if standard.is_some() {
        heading += "  CIEDE2000  CIE76  CIE94  CMC2:1";
        if light > 0 {
            heading += "  metamerism";
        }
    }
    console.line(heading + "  display")?;
    for row in rows {
        let SpectrumColor { xyz, lab, rgb } = &row.colors[light];
        let mut line = format!("{:width$} ", row.name);
        for value in xyz.to_array().into_iter().chain(lab.to_array()) {
            line += &format!(" {value:7.2}");
        }
        if let Some(standard) = standard {
            let difference = ColorDifferences::between(standard.colors[light].lab, *lab);
            line += &format!(
                "  {:9.2} {:6.2} {:6.2}  {:6.2}",
                difference.ciede2000, difference.cie1976, difference.cie94, difference.cmc_2_1,
            );
            if light > 0 {
                let index = metamerism(standard, row, light, whites);
                line += &index.map_or_else(|| format!("  {:>10}", "-"), |v| format!("  {v:10.2}"));
            }
        }
        let patch = console.patch(*rgb);
        console.line(format!("{line}  {patch}{}{}", rgb.to_hex(), gamut_note(rgb.in_gamut())))?;
    }
    Ok(())
}
