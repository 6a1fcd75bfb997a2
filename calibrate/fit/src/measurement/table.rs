//! Readings of paint and of bare backings, all on one grid.

use std::sync::Arc;

use spectra::Grid;

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
    /// The kind of surface that a cell of the column `film` names; an empty cell is paint.
    pub(super) fn named(cell: &str) -> Option<Self> {
        match cell.to_ascii_lowercase().as_str() {
            "paint" | "" => Some(Self::Paint),
            "none" => Some(Self::None),
            _ => None,
        }
    }
}

/// One reading of reflectance.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// File name as the caller gave it.
    pub file: Arc<str>,
    /// Row in the file, the header being row 1.
    pub row: u64,
    /// Name of the sample.
    pub sample: String,
    /// Whether paint or a bare backing was read.
    pub film: Film,
    /// Name of the backing; empty if the file does not state it.
    pub backing: Arc<str>,
    /// Thickness of the film in mm, if known.
    pub thickness_mm: Option<f64>,
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
    /// Readings in order of the file; at least one.
    pub readings: Vec<Reading>,
    /// Decisions that reading the file required, in words for the user.
    pub remarks: Vec<String>,
}

impl MeasurementTable {
    /// Joins the readings of several files in one table. Pigments are identified by name; a sample that
    /// occurs in two files is one sample with repeated readings.
    ///
    /// # Errors
    /// [`MeasurementError::Grid`] if the wavelengths differ, [`MeasurementError::Empty`] without a
    /// table.
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
                reading.amounts = amounts.into();
            }
            all.readings.append(&mut table.readings);
            all.remarks.append(&mut table.remarks);
        }
        let count = all.pigments.len();
        for reading in all.readings.iter_mut().filter(|reading| reading.amounts.len() < count) {
            let mut amounts = std::mem::take(&mut reading.amounts).into_vec();
            amounts.resize(count, 0.0);
            reading.amounts = amounts.into();
        }
        Ok(all)
    }
}
