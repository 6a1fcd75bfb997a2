//! Measurement files of any kind: the CSV, or what an instrument writes.

use std::path::{Path, PathBuf};

use anyhow::Context;
use calibrate::library::Input;
use calibrate::measurement::{
    MeasurementTable, Recipes, RecordChoice, Scale, ScaleChoice, is_measurement_csv,
};
use clap::Args;
use clap::builder::PossibleValuesParser;
use spectra::instrument::{Format, InstrumentError, InstrumentFile, decode_text, read};

use crate::console::Console;
use crate::failure::Refusal;
use crate::input::{input, unreadable};
use crate::referencing::{References, ReferencingOptions};

/// The CSV's name among formats.
const CSV: &str = "csv";

/// How measurement files are read.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct ReadingOptions {
    /// Readings are in percent (found by the file as a whole if not told)
    #[arg(long, conflicts_with = "fraction")]
    percent: bool,
    /// Readings are fractions, white near 1
    #[arg(long)]
    fraction: bool,
    /// Format of the measurement files [default: found by content]
    ///
    /// csv: a column `sample`, then optionally film, backing, thickness_mm, one per pigment, then
    /// the wavelengths; commas, or semicolons or tabs with decimal commas. cgats: CGATS.17, Argyll
    /// .ti3 and .sp, X-Rite and GretagMacbeth text. qtx: Datacolor. ocean-optics: SpectraSuite,
    /// OceanView, Jaz. jcamp-dx. avantes: AvaSoft text. bruker: OPUS .dpt. columns: wavelength,
    /// then one or more spectra. cxf: CxF3. tm27: IES TM-27 .spdx. sekonic: SpectroMaster CSV.
    #[arg(long, value_name = "NAME", value_parser = format_names(), hide_possible_values = true)]
    format: Option<String>,
    /// Take what an instrument's file calls transmittance as reflectance
    ///
    /// For spectrometers whose program measured in transmission mode over a white tile. Counts and
    /// the power of lamps are never taken as reflectance.
    #[arg(long)]
    as_reflectance: bool,
    #[command(flatten)]
    referencing: ReferencingOptions,
}

fn format_names() -> PossibleValuesParser {
    let names = Format::ALL.into_iter().map(Format::name);
    PossibleValuesParser::new(std::iter::once(CSV).chain(names))
}

impl ReadingOptions {
    /// The files that are read beside the measurements.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.referencing.files()
    }

    fn scale(&self) -> ScaleChoice {
        match (self.percent, self.fraction) {
            (true, _) => ScaleChoice::Known(Scale::Percent),
            (_, true) => ScaleChoice::Known(Scale::Fraction),
            _ => ScaleChoice::ByFile,
        }
    }

    /// The instrument's file in `bytes`; `None` if it is the CSV, or nothing known, of which the
    /// CSV's reader tells what is wrong.
    fn instrument_file(
        &self,
        name: &str,
        bytes: &[u8],
    ) -> Result<Option<InstrumentFile>, InstrumentError> {
        if let Some(told) = &self.format {
            let format = Format::named(told);
            return format.map(|format| read(name, bytes, Some(format))).transpose();
        }
        let (text, _) = decode_text(bytes);
        if is_measurement_csv(&text) {
            return Ok(None);
        }
        let format = Format::detect(name, &text);
        format.map(|format| read(name, bytes, Some(format))).transpose()
    }

    /// The readings in `bytes`, the content of file `name`; says what was read.
    fn table(
        &self,
        name: &str,
        bytes: &[u8],
        spectra_only: bool,
        references: Option<&References>,
        console: &mut Console<'_>,
    ) -> anyhow::Result<MeasurementTable> {
        let scale = self.scale();
        let Some(mut file) = self.instrument_file(name, bytes)? else {
            if references.is_some() {
                return Err(Refusal::usage(
                    format!(
                        "--white needs counts as an instrument writes them, found a CSV: `{name}`"
                    ),
                    "give the spectrometer's own file, or two columns `nm counts`",
                ));
            }
            let table = if spectra_only {
                MeasurementTable::spectra_from_csv(name, bytes, scale)?
            } else {
                MeasurementTable::from_csv(name, bytes, scale)?
            };
            let (_, encoding) = decode_text(bytes);
            let is_utf8 = encoding == "UTF-8";
            let written = if is_utf8 { String::new() } else { format!(" ({encoding})") };
            remark(
                &format!("{name}{written}: {} readings", table.readings.len()),
                &table,
                console,
            )?;
            return Ok(table);
        };
        if let Some(references) = references {
            file.spectra = references.reflectances(name, &file.spectra)?;
        }
        let choice = RecordChoice { scale, transmittance_is_reflectance: self.as_reflectance };
        let table = MeasurementTable::from_records(name, &file.spectra, choice)?;
        let count = table.readings.len();
        let spectra = if count == 1 { "spectrum" } else { "spectra" };
        let what = format!("{name}: {}, {count} {spectra}", file.format.title());
        remark(&what, &table, console)?;
        Ok(table)
    }
}

/// The readings of one or more measurement files, with their recipes where these stand in a file
/// of their own, and the files' hashes. Says what was read.
pub(crate) fn measurements(
    paths: &[PathBuf],
    recipes: Option<&Path>,
    options: &ReadingOptions,
    console: &mut Console<'_>,
) -> anyhow::Result<(MeasurementTable, Vec<Input>)> {
    let mut inputs = Vec::new();
    // Recipes first: a fault there costs no reading of large files.
    let recipes = recipes
        .map(|path| -> anyhow::Result<Recipes> {
            let (name, bytes) = content(path)?;
            inputs.push(input(&name, &bytes));
            Ok(Recipes::from_csv(&name, &bytes)?)
        })
        .transpose()?;
    let recipe_input = inputs.pop();
    let mut table = joined(paths, options, false, console, |name, bytes| {
        inputs.push(input(name, bytes));
    })?;
    inputs.extend(recipe_input);
    if let Some(recipes) = recipes {
        table.remarks.clear();
        table = recipes.joined_to(table)?;
        console.warnings(&table.remarks)?;
    }
    Ok((table, inputs))
}

/// The spectra of files whose other columns do not matter.
pub(crate) fn spectra(
    paths: &[PathBuf],
    options: &ReadingOptions,
    console: &mut Console<'_>,
) -> anyhow::Result<MeasurementTable> {
    joined(paths, options, true, console, |_, _| ())
}

fn joined(
    paths: &[PathBuf],
    options: &ReadingOptions,
    spectra_only: bool,
    console: &mut Console<'_>,
    mut seen: impl FnMut(&str, &[u8]),
) -> anyhow::Result<MeasurementTable> {
    let references = options.referencing.read(console)?;
    let mut tables = Vec::new();
    for path in paths {
        let (name, bytes) = content(path)?;
        seen(&name, &bytes);
        let references = references.as_ref();
        tables.push(options.table(&name, &bytes, spectra_only, references, console)?);
    }
    references.iter().flat_map(|it| &it.files).for_each(|(name, bytes)| seen(name, bytes));
    Ok(MeasurementTable::joined(tables)?)
}

fn content(path: &Path) -> anyhow::Result<(String, Vec<u8>)> {
    let bytes = std::fs::read(path).with_context(|| unreadable(path))?;
    Ok((path.display().to_string(), bytes))
}

/// Says `what` was read, and what had to be decided.
fn remark(what: &str, table: &MeasurementTable, console: &mut Console<'_>) -> anyhow::Result<()> {
    let unit = match table.scale {
        Scale::Percent => "percent",
        Scale::Fraction => "fractions",
    };
    console.remark(format!("{what} in {unit}, {}", table.grid))?;
    if let Some(count) = table.resampled_from {
        console.remark(format!(
            "{count} irregular wavelengths brought to that grid by straight lines"
        ))?;
    }
    console.warnings(&table.remarks)
}
