//! `impasto color`: colours of measured spectra in several systems, and colour differences.

use std::path::{Path, PathBuf};

use calibrate::evaluate::Viewing;
use calibrate::measurement::AveragedSpectrum;
use clap::{Args, ValueEnum};
use documents::file::is_there;
use serde_json::Value;
use spectra::TristimulusWeights;
use spectra::color::{Adaptation, Lab, RgbSpace};
use spectra::instrument::{split_file_and_name, split_file_and_sheet};

use super::color_table::{ColorTable, ColumnName, Row, SpectrumColor};
use crate::console::Console;
use crate::failure::{Failure, Result};
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
            .map(|light| viewing(light, &self.observer))
            .collect::<Result<Vec<Viewing>>>()?;
        self.files.iter().try_for_each(|file| refuse_sample(file))?;
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
            let lights = || 0..table.lights.len();
            let rows = selected.iter().flat_map(|row| lights().map(move |light| (row, light)));
            let list: Vec<Value> = rows.map(|(row, light)| table.entry(row, light)).collect();
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

/// Refuses FILE#SAMPLE, which other verbs take, and tells the option `--sample`.
fn refuse_sample(path: &Path) -> Result<()> {
    let text = path.display().to_string();
    let is_sheet = split_file_and_sheet(&text).1.is_some();
    match split_file_and_name(&text) {
        (file, Some(name)) if !is_sheet && is_there(Path::new(file)) => {
            let reason = format!("{text}: there is no such file");
            Err(Failure::usage(reason, format!("for one sample: {file} --sample \"{name}\"")))
        }
        _ => Ok(()),
    }
}
