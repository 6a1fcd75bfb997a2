//! Options that several verbs share, and what they read.

use std::path::{Path, PathBuf};

use anyhow::Context;
use calibrate::evaluate::Viewing;
use calibrate::library::{Input, PigmentLibrary};
use calibrate::measurement::{MeasurementTable, Scale, ScaleChoice};
use clap::Args;
use sha2::{Digest, Sha256};
use spectra::color::{Adaptation, Rgb, RgbSpace, Xyz};
use spectra::{Observer, light_from_text};

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
}

/// A light and an observer by their names.
pub(crate) fn viewing(illuminant: &str, observer: &str) -> anyhow::Result<Viewing> {
    Ok(Viewing { illuminant: light_from_text(illuminant)?, observer: Observer::named(observer)? })
}

/// sRGB of a colour, for a patch and a hex code.
pub(crate) fn srgb(xyz: Xyz, white: Xyz) -> Rgb {
    RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford)
}

/// The readings of one or more measurement files, with the files' hashes.
pub(crate) fn measurements(
    paths: &[PathBuf],
    scale: ScaleChoice,
) -> anyhow::Result<(MeasurementTable, Vec<Input>)> {
    let mut tables = Vec::new();
    let mut inputs = Vec::new();
    for path in paths {
        let bytes = std::fs::read(path).with_context(|| unreadable(path))?;
        let name = path.display().to_string();
        tables.push(MeasurementTable::from_csv(&name, &bytes, scale)?);
        inputs.push(input(&name, &bytes));
    }
    Ok((MeasurementTable::joined(tables)?, inputs))
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
