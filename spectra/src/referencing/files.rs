//! The files of a white, its darks and its tile, by path.

use std::path::{Path, PathBuf};

use super::{Dark, LEAST_LIGHT, Referencing, ReferencingError, Tile};
use crate::instrument::{MeasuredSpectrum, OpenError, open_spectrum, split_file_and_name};
use documents::hint::Explain;

/// The files of a reference measurement. Name each spectrum as `FILE`, or as `FILE#NAME` if the
/// file holds several.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceFiles {
    /// Reading of the white.
    pub white: String,
    /// Readings without light.
    pub dark: DarkFiles,
    /// Reflectance of the white itself.
    pub tile: TileSource,
    /// Largest count of the detector, 0 and up. `None` to estimate it from the readings.
    pub full_scale: Option<f64>,
    /// Least light of the white as a fraction of its peak, 0 and up (default 0.01).
    pub least_light: f64,
}

/// The dark readings of sample and white.
#[derive(Debug, Clone, PartialEq)]
pub enum DarkFiles {
    /// The dark is already subtracted.
    Subtracted,
    /// One reading for each integration time. Leave this empty for power, which needs no dark.
    Files(Vec<String>),
}

/// The source of the white's own reflectance.
#[derive(Debug, Clone, PartialEq)]
pub enum TileSource {
    /// A constant, above 0 and at most 1.2.
    Fraction(f64),
    /// A file with the measured reflectance of the tile.
    File(String),
}

/// A reference measurement that was opened, with the content of its files.
#[derive(Debug, Clone)]
pub struct OpenedReferences {
    /// The counts of white and dark, and the reflectance of the white.
    pub referencing: Referencing,
    /// Path and bytes of every file that was read, for checksums.
    pub files: Vec<(String, Vec<u8>)>,
}

impl ReferenceFiles {
    /// A white without dark readings, and a tile that reflects everything.
    #[must_use]
    pub fn new(white: impl Into<String>) -> Self {
        Self {
            white: white.into(),
            dark: DarkFiles::Files(Vec::new()),
            tile: TileSource::Fraction(1.0),
            full_scale: None,
            least_light: LEAST_LIGHT,
        }
    }

    /// Paths of the named files that exist.
    #[must_use]
    pub fn paths(&self) -> Vec<PathBuf> {
        let mut texts = vec![&self.white];
        if let DarkFiles::Files(files) = &self.dark {
            texts.extend(files);
        }
        if let TileSource::File(file) = &self.tile {
            texts.push(file);
        }
        let paths = texts.into_iter().map(|text| Path::new(split_file_and_name(text).0));
        paths.filter(|path| path.is_file()).map(Path::to_owned).collect()
    }

    /// Reads the files.
    ///
    /// # Errors
    /// [`ReferenceFilesError`] if a file cannot be read, a setting is out of its range, or
    /// the tile is not a reflectance.
    pub fn open(&self) -> Result<OpenedReferences, ReferenceFilesError> {
        for (setting, value) in
            [("full_scale", self.full_scale), ("least_light", Some(self.least_light))]
        {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value >= 0.0)) {
                return Err(ReferenceFilesError::Setting { setting, value });
            }
        }
        let mut files = Vec::new();
        let mut spectrum = |text: &String| -> Result<MeasuredSpectrum, OpenError> {
            let opened = open_spectrum(text)?;
            files.push((opened.file, opened.bytes));
            Ok(opened.spectrum)
        };
        let white = spectrum(&self.white)?;
        let dark = match &self.dark {
            DarkFiles::Subtracted => Dark::Subtracted,
            DarkFiles::Files(darks) => {
                Dark::Readings(darks.iter().map(&mut spectrum).collect::<Result<_, _>>()?)
            }
        };
        let tile = match &self.tile {
            TileSource::Fraction(value) => Tile::even(*value)?,
            TileSource::File(file) => Tile::measured(&spectrum(file)?)
                .map_err(|reason| ReferenceFilesError::Tile(file.clone(), reason))?,
        };
        let full_scale = self.full_scale;
        let least_light = self.least_light;
        let referencing = Referencing { white, dark, tile, full_scale, least_light };
        Ok(OpenedReferences { referencing, files })
    }
}

/// Reference files that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ReferenceFilesError {
    /// A file cannot be opened.
    #[error(transparent)]
    Open(#[from] OpenError),
    /// The file does not hold the reflectance of a tile.
    #[error("{0}: cannot be used as the reflectance of the white tile")]
    #[hint(inner = 1)]
    Tile(String, #[source] ReferencingError),
    /// The constant reflectance of the tile is out of its range.
    #[error(transparent)]
    Constant(#[from] ReferencingError),
    /// A setting is negative, infinite or NaN.
    #[error("{} must be a number from 0 up, found `{value}`", setting.replace('_', " "))]
    #[hint("leave [{setting}] out for the default")]
    #[fault(Setting)]
    Setting {
        /// Name of the setting, `full_scale` or `least_light`.
        setting: &'static str,
        /// The value that was given.
        value: f64,
    },
}
