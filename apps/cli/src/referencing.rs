//! Options that convert the counts of a spectrometer to reflectance: white, dark and tile.

use std::path::PathBuf;

use clap::Args;
use spectra::referencing::{DarkFiles, ReferenceFiles, TileSource};

use crate::failure::{Failure, Result};

/// References that convert counts to reflectance.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct ReferencingOptions {
    /// White reading, FILE or FILE#NAME, for measurement files that hold counts
    ///
    /// Reflectance = tile x (sample - dark) / (white - dark), sample and white each divided by their
    /// integration time where the files state it. Saturated counts or too little light from 380 to
    /// 730 nm are an error; outside this range such wavelengths are left out.
    #[arg(long, value_name = "FILE")]
    white_reading: Option<String>,
    /// Dark reading of sample and white, FILE or FILE#NAME; 0 if subtracted already
    ///
    /// Dark counts are not scaled by time: if sample and white have different integration times,
    /// give a dark reading for each.
    #[arg(long, alias = "dark", value_name = "FILE")]
    dark_reading: Vec<String>,
    /// The white's own reflectance, FILE, FILE#NAME or a fraction [default: 1]
    #[arg(long, value_name = "FILE|0.99")]
    tile: Option<String>,
    /// Largest count of the detector, such as 65535 [default: guessed]
    ///
    /// Guessed from a maximum of 4095, 16383 or 65535, or from neighbouring values that share the
    /// maximum.
    #[arg(long, value_name = "COUNT")]
    full_scale: Option<f64>,
    /// Minimum light of the white, as a fraction of its peak [default: 0.01]
    #[arg(long, value_name = "SHARE")]
    least_light: Option<f64>,
}

impl ReferencingOptions {
    /// The options with a white reading, for verbs that also take it by another option.
    pub(crate) fn with_white_reading(&self, white: Option<String>) -> Self {
        Self { white_reading: self.white_reading.clone().or(white), ..self.clone() }
    }

    /// Refuses options that need a white reading if there is none.
    pub(crate) fn check(&self) -> Result<()> {
        let present = [
            ("--dark-reading", !self.dark_reading.is_empty()),
            ("--tile", self.tile.is_some()),
            ("--full-scale", self.full_scale.is_some()),
            ("--least-light", self.least_light.is_some()),
        ];
        match present.into_iter().find(|(_, present)| *present && self.white_reading.is_none()) {
            None => Ok(()),
            Some((option, _)) => Err(Failure::usage(
                format!("{option} needs the white reading of the same counts"),
                "add --white-reading FILE",
            )),
        }
    }

    /// Paths of all reference files.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.reference_files().map_or_else(Vec::new, |files| files.paths())
    }

    /// Reference files to be opened by the library; `None` without a white.
    pub(crate) fn reference_files(&self) -> Option<ReferenceFiles> {
        let mut files = ReferenceFiles::new(self.white_reading.as_ref()?);
        files.dark = match self.dark_reading.as_slice() {
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
