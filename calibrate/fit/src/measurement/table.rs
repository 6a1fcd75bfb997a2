//! Readings of paint and of bare backings on one grid, and means of repeated readings.

use std::collections::BTreeMap;
use std::sync::Arc;

use documents::hint::Explain;
use documents::{name_list, question};
use spectra::headings::plain;
use spectra::instrument::StatedGeometry;
use spectra::{Grid, IrregularSpectrum};

use super::error::MeasurementError;
use super::scale::Scale;

/// Kind of surface that a reading is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Film {
    /// A film of paint on a backing.
    Paint,
    /// The bare backing without paint.
    None,
}

impl Film {
    /// The kind of surface that a cell of the column `film` names. An empty cell is paint.
    pub(super) fn named(cell: &str) -> Option<Self> {
        const PAINT: [&str; 8] =
            ["", "paint", "farbe", "peinture", "pintura", "pittura", "verf", "film"];
        const NONE: [&str; 11] = [
            "none", "bare", "keine", "kein", "ohne", "aucun", "aucune", "ninguna", "ninguno",
            "nessuno", "geen",
        ];
        let plain = plain(cell);
        match plain.as_str() {
            word if PAINT.contains(&word) => Some(Self::Paint),
            word if NONE.contains(&word) => Some(Self::None),
            _ => None,
        }
    }
}

/// Pairs of heading and cell. Readings share them in memory.
pub type Conditions = Arc<[(Arc<str>, Arc<str>)]>;

/// One reading of reflectance.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// File name as the caller gave it.
    pub file: Arc<str>,
    /// Row in the file. The header is row 1.
    pub row: u64,
    /// Name of the sample.
    pub sample: String,
    /// Whether paint or a bare backing was read.
    pub film: Film,
    /// Name of the backing. This is empty if the file does not state it.
    pub backing: Arc<str>,
    /// Thickness of the film in mm, if known.
    pub thickness_mm: Option<f64>,
    /// Headings and cells of the columns that say how the reading was taken, e.g. `Geometry` and `45as15`.
    pub conditions: Conditions,
    /// Amount of each pigment of the table, 0 and up.
    pub amounts: Box<[f64]>,
    /// Measured reflectance as a fraction, at each wavelength of the table's grid.
    pub reflectance: Box<[f64]>,
}

/// All readings of one file, or of several.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasurementTable {
    /// Names of the pigments, in order of their columns.
    pub pigments: Vec<String>,
    /// Wavelengths of every reading.
    pub grid: Grid,
    /// Number of irregular wavelengths in the file, if the readings were interpolated to the grid.
    pub resampled_from: Option<usize>,
    /// Unit in which the file is written.
    pub scale: Scale,
    /// Whether the readings hold the specular reflection, if the files say so.
    pub geometry: Option<StatedGeometry>,
    /// Readings in order of the file. There is at least one.
    pub readings: Vec<Reading>,
    /// Decisions that we made while reading the file, in words for you.
    pub remarks: Vec<String>,
}

impl MeasurementTable {
    /// Joins the readings of several files in one table. We identify pigments by name. If a sample occurs
    /// in two files, it is one sample with repeated readings.
    ///
    /// # Errors
    /// [`MeasurementError::Grid`] if the wavelengths differ, [`MeasurementError::Empty`] without a
    /// table.
    pub fn joined(tables: Vec<Self>) -> Result<Self, MeasurementError> {
        let mut tables = tables.into_iter();
        let mut all = tables.next().ok_or_else(|| MeasurementError::Empty("no file".to_owned()))?;
        let mut stated: Vec<StatedGeometry> = all.geometry.take().into_iter().collect();
        for mut table in tables {
            if table.grid != all.grid {
                return Err(MeasurementError::Grid {
                    file: table.readings[0].file.to_string(),
                    found: table.grid.to_string(),
                    first: all.readings[0].file.to_string(),
                    wanted: all.grid.to_string(),
                });
            }
            stated.extend(table.geometry.take());
            let mut known: BTreeMap<String, usize> =
                all.pigments.iter().cloned().zip(0..).collect();
            let places: Vec<usize> = table
                .pigments
                .iter()
                .map(|name| {
                    *known.entry(name.clone()).or_insert_with(|| {
                        all.pigments.push(name.clone());
                        all.pigments.len() - 1
                    })
                })
                .collect();
            for reading in &mut table.readings {
                let mut amounts = vec![0.0; all.pigments.len()];
                for (&place, amount) in places.iter().zip(&reading.amounts) {
                    amounts[place] = *amount;
                }
                reading.amounts = amounts.into();
            }
            all.readings.append(&mut table.readings);
            all.remarks.append(&mut table.remarks);
        }
        (all.geometry, _) = one_geometry(stated);
        let count = all.pigments.len();
        for reading in all.readings.iter_mut().filter(|reading| reading.amounts.len() < count) {
            let mut amounts = std::mem::take(&mut reading.amounts).into_vec();
            amounts.resize(count, 0.0);
            reading.amounts = amounts.into();
        }
        Ok(all)
    }
}

/// The geometry on which all of `stated` agree, and whether they do.
pub(super) fn one_geometry(stated: Vec<StatedGeometry>) -> (Option<StatedGeometry>, bool) {
    let mut stated = stated.into_iter();
    let first = stated.next();
    let agree = stated.all(|other| {
        first.as_ref().is_some_and(|first| first.includes_specular == other.includes_specular)
    });
    (first.filter(|_| agree), agree)
}

const LISTED: usize = 8;

/// Mean of the repeated readings of one film or card.
#[derive(Debug, Clone, PartialEq)]
pub struct AveragedSpectrum {
    /// Name of the sample.
    pub sample: String,
    /// Whether paint or a bare backing was read.
    pub film: Film,
    /// Name of the sample, followed by backing and thickness if the sample has several spectra.
    pub name: String,
    /// Reflectance on the table's grid.
    pub reflectance: Vec<f64>,
}

/// Averaged spectra of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct AveragedSpectra {
    /// Wavelengths of all spectra.
    pub grid: Grid,
    /// Spectra in the order of their first readings.
    pub spectra: Vec<AveragedSpectrum>,
}

impl MeasurementTable {
    /// Averages repeated readings of one sample on one backing with one thickness. Use this if you need
    /// one spectrum for each film or card.
    #[must_use]
    pub fn averaged(&self) -> AveragedSpectra {
        let mut groups: Vec<Vec<&Reading>> = Vec::new();
        let mut places: BTreeMap<FilmKey<'_>, usize> = BTreeMap::new();
        let mut films: BTreeMap<&str, usize> = BTreeMap::new();
        for reading in &self.readings {
            let place = *places.entry(film(reading)).or_insert(groups.len());
            if place == groups.len() {
                groups.push(Vec::new());
                *films.entry(&reading.sample).or_default() += 1;
            }
            groups[place].push(reading);
        }
        let spectra = groups.iter().map(|group| {
            let first = group[0];
            let alone = films[first.sample.as_str()] == 1;
            let name = match (alone, first.film) {
                (true, _) => first.sample.clone(),
                (_, Film::None) => format!("{} bare {}", first.sample, first.backing),
                (_, Film::Paint) => match first.thickness_mm {
                    Some(mm) => format!("{} on {}, {mm} mm", first.sample, first.backing),
                    None => format!("{} on {}", first.sample, first.backing),
                },
            };
            let means = (0..self.grid.count()).map(|at| {
                group.iter().map(|r| r.reflectance[at]).sum::<f64>() / group.len() as f64
            });
            let reflectance = means.collect();
            AveragedSpectrum { sample: first.sample.clone(), film: first.film, name, reflectance }
        });
        AveragedSpectra { grid: self.grid, spectra: spectra.collect() }
    }
}

/// One film: sample, kind of surface, backing, and thickness in bits.
pub(super) type FilmKey<'a> = (&'a str, bool, &'a str, Option<u64>);

pub(super) fn film(reading: &Reading) -> FilmKey<'_> {
    let thickness = reading.thickness_mm.map(f64::to_bits);
    (&reading.sample, reading.film == Film::None, &reading.backing, thickness)
}

impl AveragedSpectra {
    /// The spectrum with exactly this name. If there is none, you get all spectra of the sample with this
    /// name, in their order.
    ///
    /// # Errors
    /// [`SpectrumNameError::Unknown`] if there is none.
    pub fn find(&self, name: &str) -> Result<Vec<&AveragedSpectrum>, SpectrumNameError> {
        if let Some(spectrum) = self.spectra.iter().find(|spectrum| spectrum.name == name) {
            return Ok(vec![spectrum]);
        }
        let found: Vec<&AveragedSpectrum> =
            self.spectra.iter().filter(|spectrum| spectrum.sample == name).collect();
        if found.is_empty() {
            let mut samples: Vec<String> = self.spectra.iter().map(|s| s.sample.clone()).collect();
            samples.dedup();
            return Err(SpectrumNameError::Unknown { name: name.to_owned(), samples });
        }
        Ok(found)
    }

    /// The one spectrum with this name, or of the sample with this name.
    ///
    /// # Errors
    /// [`SpectrumNameError`] if there is none, or several.
    pub fn find_one(&self, name: &str) -> Result<&AveragedSpectrum, SpectrumNameError> {
        match self.find(name)?.as_slice() {
            &[spectrum] => Ok(spectrum),
            several => Err(SpectrumNameError::Several {
                name: name.to_owned(),
                spectra: several.iter().map(|spectrum| spectrum.name.clone()).collect(),
            }),
        }
    }
}

/// A name that does not denote one spectrum.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
pub enum SpectrumNameError {
    /// No spectrum and no sample has this name.
    #[error("no spectrum is called `{name}`")]
    #[hint(verbatim, "{}samples: {}", question(name, samples), name_list(samples, LISTED, ", "))]
    Unknown {
        /// The name that no spectrum has.
        name: String,
        /// Names of all samples.
        samples: Vec<String>,
    },
    /// The sample has several spectra, and you need one of them.
    #[error("`{name}` has several spectra")]
    #[hint(verbatim, "select one of them: {}", spectra.join(", "))]
    Several {
        /// Name of the sample.
        name: String,
        /// Names of its spectra.
        spectra: Vec<String>,
    },
}

/// The grid for `wavelengths_nm`, which rise strictly: [`Grid::suited_to`] them.
pub(super) fn grid_of(wavelengths_nm: &[f64]) -> Grid {
    Grid::suited_to(wavelengths_nm).expect("the wavelengths rise strictly")
}

/// `values` at `wavelengths_nm`, interpolated to `grid` by [`IrregularSpectrum::on_grid`].
pub(super) fn on_grid(grid: Grid, wavelengths_nm: &[f64], values: Vec<f64>) -> Vec<f64> {
    let irregular = IrregularSpectrum::new(wavelengths_nm.to_vec(), values);
    irregular.expect("the wavelengths rise strictly").on_grid(grid)
}
