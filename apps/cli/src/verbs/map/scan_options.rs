//! Options for how a scan is read.

use std::path::{Path, PathBuf};

use clap::Args;
use maps::Cube;
use maps::cube::{CubeOptions, CubeScale, DarkReading};

use crate::failure::{Failure, Result};

/// How the scan is read.
#[derive(Debug, Args)]
#[command(next_help_heading = "Reading the scan")]
pub(super) struct ScanOptions {
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
    pub(super) fn cube(&self, path: &Path) -> Result<Cube> {
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
