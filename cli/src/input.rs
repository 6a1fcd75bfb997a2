//! Options that several verbs share, and what they read.

use std::path::{Path, PathBuf};

use anyhow::Context;
use calibrate::evaluate::Viewing;
use calibrate::library::{Input, PigmentLibrary};
use calibrate::measurement::{MeasurementError, MeasurementTable, Scale, ScaleChoice};
use clap::Args;
use sha2::{Digest, Sha256};
use spectra::color::{Adaptation, Rgb, RgbSpace, Xyz};
use spectra::{Grid, Observer, TristimulusWeights, light_from_text};

use crate::console::Console;
use crate::failure::Refusal;

/// The unit of reflectance.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct ScaleOptions {
    /// Readings are in percent (found by the file as a whole if not told)
    #[arg(long, conflicts_with = "fraction")]
    percent: bool,
    /// Readings are fractions, white near 1
    #[arg(long)]
    fraction: bool,
}

impl ScaleOptions {
    pub(crate) fn choice(self) -> ScaleChoice {
        match (self.percent, self.fraction) {
            (true, _) => ScaleChoice::Told(Scale::Percent),
            (_, true) => ScaleChoice::Told(Scale::Fraction),
            _ => ScaleChoice::ByFile,
        }
    }

    /// The option as given, if one was.
    pub(crate) fn told(self) -> Option<&'static str> {
        match (self.percent, self.fraction) {
            (true, _) => Some("--percent"),
            (_, true) => Some("--fraction"),
            _ => None,
        }
    }
}

/// Light and observer.
#[derive(Debug, Clone, Args)]
pub(crate) struct ViewingOptions {
    /// Light: a CIE illuminant (D65, A, FL11, LED-B3 ..), a black body (5600K), daylight (D5600K),
    /// or a file with lines `nm,power`
    #[arg(long, value_name = "LIGHT", default_value = "D65")]
    illuminant: String,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
}

impl ViewingOptions {
    pub(crate) fn viewing(&self) -> anyhow::Result<Viewing> {
        viewing(&self.illuminant, &self.observer)
    }

    /// Light and observer as given.
    pub(crate) fn told(&self) -> (&str, &str) {
        (&self.illuminant, &self.observer)
    }
}

/// A light and an observer by their names.
pub(crate) fn viewing(illuminant: &str, observer: &str) -> anyhow::Result<Viewing> {
    Ok(Viewing { illuminant: light_from_text(illuminant)?, observer: Observer::named(observer)? })
}

/// sRGB of a colour, for a patch and a hex code.
pub(crate) fn srgb(xyz: Xyz, white: Xyz) -> Rgb {
    RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford)
}

/// The readings of one or more measurement files, with the files' hashes. Says
/// what was read.
pub(crate) fn measurements(
    paths: &[PathBuf],
    scale: ScaleChoice,
    console: &mut Console<'_>,
) -> anyhow::Result<(MeasurementTable, Vec<Input>)> {
    let mut inputs = Vec::new();
    let table = joined(paths, console, |name, bytes| {
        inputs.push(input(name, bytes));
        MeasurementTable::from_csv(name, bytes, scale)
    })?;
    Ok((table, inputs))
}

/// The spectra of files whose other columns do not matter.
pub(crate) fn spectra(
    paths: &[PathBuf],
    scale: ScaleChoice,
    console: &mut Console<'_>,
) -> anyhow::Result<MeasurementTable> {
    joined(paths, console, |name, bytes| MeasurementTable::spectra_from_csv(name, bytes, scale))
}

fn joined(
    paths: &[PathBuf],
    console: &mut Console<'_>,
    mut read: impl FnMut(&str, &[u8]) -> Result<MeasurementTable, MeasurementError>,
) -> anyhow::Result<MeasurementTable> {
    let mut tables = Vec::new();
    for path in paths {
        let bytes = std::fs::read(path).with_context(|| unreadable(path))?;
        let name = path.display().to_string();
        let table = read(&name, &bytes)?;
        remark_table(&name, &table, console)?;
        tables.push(table);
    }
    Ok(MeasurementTable::joined(tables)?)
}

fn remark_table(
    name: &str,
    table: &MeasurementTable,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let unit = match table.scale {
        Scale::Percent => "percent",
        Scale::Fraction => "fractions",
    };
    console.remark(format!(
        "{name}: {} readings in {unit}, {}",
        table.readings.len(),
        table.grid
    ))?;
    if let Some(count) = table.resampled_from {
        console.remark(format!(
            "{count} irregular wavelengths brought to that grid by straight lines"
        ))?;
    }
    Ok(())
}

/// The weights for colours of spectra on `grid`; warns where much of the visible
/// band is not measured.
pub(crate) fn colour_weights(
    viewing: &Viewing,
    grid: Grid,
    console: &mut Console<'_>,
) -> anyhow::Result<TristimulusWeights> {
    remark_coverage(grid, console)?;
    Ok(viewing.weights(grid)?)
}

/// Refuses a grid that misses the visible band, and warns of one that covers
/// little of it.
pub(crate) fn remark_coverage(grid: Grid, console: &mut Console<'_>) -> anyhow::Result<()> {
    let (start, end) = (grid.start_nm(), grid.end_nm());
    if end < 400.0 || start > 700.0 {
        return Err(Refusal::data(
            format!("spectra from {start} to {end} nm have no colour"),
            "measure from 400 to 700 nm or more",
        ));
    }
    if start > 420.0 || end < 680.0 {
        console.warnings(&[format!(
            "spectra from {start} to {end} nm; colours take the end values for the rest of the visible band"
        )])?;
    }
    Ok(())
}

/// The index of the name that `wanted` is: exactly, else without regard to case.
pub(crate) fn named(names: &[String], wanted: &str, what: &str) -> anyhow::Result<usize> {
    let lower = wanted.to_lowercase();
    let exact = names.iter().position(|name| name == wanted);
    exact.or_else(|| names.iter().position(|name| name.to_lowercase() == lower)).ok_or_else(|| {
        Refusal::data(
            format!("no {what} is called `{wanted}`"),
            format!("{what}s: {}", names.join(", ")),
        )
    })
}

/// The record of an input file.
pub(crate) fn input(name: &str, bytes: &[u8]) -> Input {
    let sha256 = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    Input { path: name.to_owned(), sha256 }
}

/// A pigment library.
pub(crate) fn library(path: &Path) -> anyhow::Result<PigmentLibrary> {
    let text = std::fs::read(path).with_context(|| unreadable(path))?;
    let name = path.display().to_string();
    Ok(PigmentLibrary::from_json(&name, &String::from_utf8_lossy(&text))?)
}

fn unreadable(path: &Path) -> String {
    format!("{}: cannot be read", path.display())
}
