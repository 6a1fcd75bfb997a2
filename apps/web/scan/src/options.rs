//! Settings of a scan and its maps, as the page passes them.

use std::path::PathBuf;

use maps::cube::{CubeOptions, CubeScale, DarkReading};
use maps::{Cube, MapSettings, Region};
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Values {
    File,
    Fraction,
    Percent,
}

/// How to read the scan. If you pass `null`, the reader chooses.
#[derive(Debug, Deserialize)]
pub(crate) struct ReadingOptions {
    values: Values,
    white: Option<f64>,
    full_scale: Option<f64>,
    white_reading: Option<String>,
    dark_reading: Option<String>,
    dark_subtracted: bool,
    tile: Option<f64>,
}

impl ReadingOptions {
    pub(crate) fn cube_options(self) -> CubeOptions {
        CubeOptions {
            scale: match (self.white, self.values) {
                (Some(white), _) => CubeScale::White(white),
                (None, Values::File) => CubeScale::ByFile,
                (None, Values::Fraction) => CubeScale::Fraction,
                (None, Values::Percent) => CubeScale::Percent,
            },
            full_scale: self.full_scale,
            white_reading: self.white_reading.map(PathBuf::from),
            dark_reading: match self.dark_reading {
                Some(name) => DarkReading::File(PathBuf::from(name)),
                None if self.dark_subtracted => DarkReading::Subtracted,
                None => DarkReading::Missing,
            },
            tile: self.tile.unwrap_or(1.0),
            ..CubeOptions::default()
        }
    }
}

/// Which pixels to map, and with which pigments.
#[derive(Debug, Deserialize)]
pub(crate) struct MapOptions {
    at_most: usize,
    only: Vec<String>,
    apart: bool,
    /// First and end of rows, then of columns.
    region: Option<[usize; 4]>,
    /// Distance of the mapped pixels, in rows and in columns.
    every: usize,
}

impl MapOptions {
    /// The settings that the program uses for the same options.
    pub(crate) fn settings(&self, cube: &Cube) -> MapSettings {
        let usual = MapSettings::default();
        MapSettings {
            at_most: self.at_most,
            palette: self.only.clone(),
            group_alike: !self.apart,
            sensor_noise: cube.noise_of_white().unwrap_or(0.0).max(usual.sensor_noise),
            ..usual
        }
    }

    pub(crate) fn region(&self) -> Option<Region> {
        self.region
            .map(|[top, bottom, left, right]| Region { rows: top..bottom, columns: left..right })
    }

    pub(crate) fn every(&self) -> usize {
        self.every.max(1)
    }
}
