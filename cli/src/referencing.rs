//! Counts of a spectrometer, set against a white, the dark, and the white's own reflectance.

use std::path::PathBuf;

use clap::Args;
use spectra::referencing::{DarkFiles, ReferenceFiles, TileSource};

/// What counts are set against.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct ReferencingOptions {
    /// White reading, FILE or FILE#NAME: the measurement files hold counts to set against it
    ///
    /// Reflectance = tile x (sample - dark) / (white - dark), each light by its integration time
    /// where the files tell it. Light that is too much or too little from 380 to 730 nm is
    /// refused; beyond, such wavelengths are left out.
    #[arg(long, value_name = "FILE")]
    white: Option<String>,
    /// Dark reading of sample and white, FILE or FILE#NAME; 0 if subtracted already
    ///
    /// A dark does not scale with time: where sample and white were integrated for different
    /// times, give one of each.
    #[arg(long, value_name = "FILE", requires = "white")]
    dark: Vec<String>,
    /// The white's own reflectance, FILE, FILE#NAME or a fraction [default: 1]
    #[arg(long, value_name = "FILE|0.99", requires = "white")]
    tile: Option<String>,
    /// Largest count of the detector, such as 65535 [default: guessed]
    ///
    /// Guessed from a maximum of 4095, 16383 or 65535, or of several neighbours at the maximum.
    #[arg(long, value_name = "COUNT", requires = "white")]
    full_scale: Option<f64>,
    /// Least light of the white, as a share of its peak [default: 0.01]
    #[arg(long, value_name = "SHARE", requires = "white")]
    least_light: Option<f64>,
}

impl ReferencingOptions {
    /// The files that are read.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.reference_files().map_or_else(Vec::new, |files| files.paths())
    }

    /// The files as the library opens them; `None` without a white.
    pub(crate) fn reference_files(&self) -> Option<ReferenceFiles> {
        let mut files = ReferenceFiles::new(self.white.as_ref()?);
        files.dark = match self.dark.as_slice() {
            [zero] if zero == "0" => DarkFiles::Subtracted,
            darks => DarkFiles::Files(darks.to_vec()),
        };
        if let Some(tile) = &self.tile {
            let fraction = tile.parse().map(TileSource::Fraction);
            files.tile = fraction.unwrap_or_else(|_| TileSource::File(tile.clone()));
        }
        files.full_scale = self.full_scale;
        files.least_light = self.least_light.unwrap_or(files.least_light);
        Some(files)
    }
}
