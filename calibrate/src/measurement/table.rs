//! Readings of paint, all on one grid.

use std::sync::Arc;

use spectra::Grid;

use super::error::MeasurementError;
use super::scale::Scale;

/// What lies under the instrument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Film {
    /// Paint on a backing.
    Paint,
    /// The bare backing.
    None,
}

/// One reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The file, as the user named it.
    pub file: Arc<str>,
    /// Its row in the file, the header being 1.
    pub row: u64,
    /// The sample's name.
    pub sample: String,
    /// Paint or bare backing.
    pub film: Film,
    /// The backing's name; empty if the file does not say.
    pub backing: String,
    /// Thickness in mm, where given.
    pub thickness_mm: Option<f64>,
    /// Amount of each pigment of the table, 0 and up.
    pub amounts: Vec<f64>,
    /// Reflectance as a fraction, at each wavelength of the table's grid.
    pub reflectance: Vec<f64>,
}

/// All readings of a file, or of several.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasurementTable {
    /// The pigments, in order of their columns.
    pub pigments: Vec<String>,
    /// The wavelengths of every reading.
    pub grid: Grid,
    /// How many irregular wavelengths the file had, if the readings had to be
    /// brought to the grid (by straight lines).
    pub resampled_from: Option<usize>,
    /// The unit the file was written in.
    pub scale: Scale,
    /// The readings in order of the file; at least one.
    pub readings: Vec<Reading>,
    /// What had to be decided in reading them, in words for the user.
    pub remarks: Vec<String>,
}

impl MeasurementTable {
    /// The readings of several files as one table. A pigment is one column
    /// wherever it stands; a sample that occurs in two files is one sample, read
    /// again.
    ///
    /// # Errors
    /// [`MeasurementError::Grid`] if the wavelengths differ,
    /// [`MeasurementError::Empty`] without a table.
    pub fn joined(tables: Vec<Self>) -> Result<Self, MeasurementError> {
        let mut tables = tables.into_iter();
        let mut all =
            tables.next().ok_or_else(|| MeasurementError::Empty { file: "no file".to_owned() })?;
        for mut table in tables {
            if table.grid != all.grid {
                return Err(MeasurementError::Grid {
                    file: table.readings[0].file.to_string(),
                    found: table.grid.to_string(),
                    first: all.readings[0].file.to_string(),
                    wanted: all.grid.to_string(),
                });
            }
            let places: Vec<usize> = table
                .pigments
                .iter()
                .map(|name| {
                    all.pigments.iter().position(|known| known == name).unwrap_or_else(|| {
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
                reading.amounts = amounts;
            }
            all.readings.append(&mut table.readings);
            all.remarks.append(&mut table.remarks);
        }
        let count = all.pigments.len();
        all.readings.iter_mut().for_each(|reading| reading.amounts.resize(count, 0.0));
        Ok(all)
    }
}
