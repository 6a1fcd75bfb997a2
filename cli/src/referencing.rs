//! Counts of a spectrometer, set against a white, the dark, and the white's own reflectance.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use spectra::instrument::{MeasuredSpectrum, Role, choose_spectrum, read, split_file_and_name};
use spectra::referencing::{Dark, Referencing, Tile};

use crate::console::Console;
use crate::failure::Refusal;
use crate::input::unreadable;

/// The share of its peak that the white must have everywhere.
const LEAST_LIGHT: f64 = 0.01;

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

/// The readings that [`ReferencingOptions`] name.
pub(crate) struct References {
    name: String,
    white: MeasuredSpectrum,
    /// `None` if subtracted already.
    darks: Option<Vec<MeasuredSpectrum>>,
    tile: Tile,
    full_scale: Option<f64>,
    least_light: f64,
    /// The files, with their content.
    pub(crate) files: Vec<(String, Vec<u8>)>,
}

impl ReferencingOptions {
    /// The files that are read.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let texts = self.white.iter().chain(&self.dark).chain(&self.tile);
        let files = texts.map(|text| PathBuf::from(split_file_and_name(text).0));
        files.filter(|file| file.is_file()).collect()
    }

    /// The readings; `None` without a white.
    pub(crate) fn read(&self, console: &mut Console<'_>) -> anyhow::Result<Option<References>> {
        let Some(name) = &self.white else { return Ok(None) };
        for (option, value) in
            [("--full-scale", self.full_scale), ("--least-light", self.least_light)]
        {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value >= 0.0)) {
                let what = format!("{option} must be a number from 0 up, found `{value}`");
                return Err(Refusal::usage(what, format!("leave {option} out for the default")));
            }
        }
        let mut files = Vec::new();
        let white = record(name, &mut files)?;
        let darks = match self.dark.as_slice() {
            [zero] if zero == "0" => None,
            darks => {
                let darks = darks.iter().map(|dark| record(dark, &mut files));
                Some(darks.collect::<anyhow::Result<Vec<_>>>()?)
            }
        };
        let tile = match &self.tile {
            None => {
                console.remark("no --tile: the white is taken to reflect everything")?;
                Tile::even(1.0)?
            }
            Some(text) => match text.parse() {
                Ok(value) => Tile::even(value)?,
                Err(_) => {
                    let tile = record(text, &mut files)?;
                    Tile::measured(&tile).with_context(|| format!("{text}: no tile"))?
                }
            },
        };
        let full_scale = self.full_scale;
        let least_light = self.least_light.unwrap_or(LEAST_LIGHT);
        let name = name.clone();
        Ok(Some(References { name, white, darks, tile, full_scale, least_light, files }))
    }
}

impl References {
    /// The reflectances of the samples' light among `records`, the spectra in `file`.
    pub(crate) fn reflectances(
        &self,
        file: &str,
        records: &[MeasuredSpectrum],
    ) -> anyhow::Result<Vec<MeasuredSpectrum>> {
        let referencing = Referencing {
            white: &self.white,
            dark: self.darks.as_deref().map_or(Dark::Subtracted, Dark::Readings),
            tile: self.tile.clone(),
            full_scale: self.full_scale,
            least_light: self.least_light,
        };
        let reflectance = |record| referencing.reflectance(record);
        self.samples(records)
            .into_iter()
            .map(reflectance)
            .collect::<Result<_, _>>()
            .with_context(|| format!("{file}: cannot be set against the white of {}", self.name))
    }

    /// Those of `records` that are samples: neither a white nor a dark, nor what the file's
    /// program made of the light beside it.
    fn samples<'a>(&self, records: &'a [MeasuredSpectrum]) -> Vec<&'a MeasuredSpectrum> {
        let is_reference = |record: &MeasuredSpectrum| {
            matches!(record.role, Role::White | Role::Dark)
                || *record == self.white
                || self.darks.as_ref().is_some_and(|darks| darks.contains(record))
        };
        let has_light = records.iter().any(|record| record.role == Role::Sample);
        let is_sample = |record: &&MeasuredSpectrum| {
            if has_light { record.role == Role::Sample } else { !is_reference(record) }
        };
        let samples: Vec<&MeasuredSpectrum> = records.iter().filter(is_sample).collect();
        // A file that holds nothing else was meant, white or dark as it is.
        if samples.is_empty() { records.iter().collect() } else { samples }
    }
}

/// The spectrum that `FILE` or `FILE#NAME` names.
fn record(text: &str, files: &mut Vec<(String, Vec<u8>)>) -> anyhow::Result<MeasuredSpectrum> {
    let (file, name) = split_file_and_name(text);
    let bytes = std::fs::read(file).with_context(|| unreadable(Path::new(file)))?;
    let records = read(file, &bytes, None)?.spectra;
    files.push((file.to_owned(), bytes));
    Ok(choose_spectrum(file, &records, name)?.clone())
}
