//! Reading a measurement CSV.

use spectra::Grid;

use super::column::{Column, TableKind};
use super::common_grid::{grid_of, on_grid};
use super::csv_rows::CsvRows;
use super::error::MeasurementError;
use super::heading_row::HeadingRow;
use super::raw_rows::RawRows;
use super::scale::ScaleChoice;
use super::table::MeasurementTable;

impl MeasurementTable {
    /// Reads the measurement table in `bytes`, the content of `file`.
    ///
    /// # Errors
    /// [`MeasurementError`] with row and column.
    pub fn from_csv(
        file: &str,
        bytes: &[u8],
        scale: ScaleChoice,
    ) -> Result<Self, MeasurementError> {
        Self::from_csv_with(file, bytes, scale, None)
    }

    /// Reads the measurement table in `bytes`; of its columns only those headed as one of `pigments` are
    /// pigments. Without `pigments`, all are that are not known as something else and hold amounts.
    ///
    /// # Errors
    /// [`MeasurementError`] with row and column.
    pub fn from_csv_with(
        file: &str,
        bytes: &[u8],
        scale: ScaleChoice,
        pigments: Option<&[String]>,
    ) -> Result<Self, MeasurementError> {
        Self::read(CsvRows::open(file, bytes, TableKind::Readings, pigments)?, scale)
    }

    /// Reads only the spectra of the table: all other columns but the names are ignored, and the table has
    /// no pigments.
    ///
    /// # Errors
    /// [`MeasurementError`] with row and column.
    pub fn spectra_from_csv(
        file: &str,
        bytes: &[u8],
        scale: ScaleChoice,
    ) -> Result<Self, MeasurementError> {
        let mut rows = CsvRows::open(file, bytes, TableKind::Readings, None)?;
        rows.spectra_only = true;
        Self::read(rows, scale)
    }

    fn read(table: CsvRows, scale: ScaleChoice) -> Result<Self, MeasurementError> {
        let spectra_only = table.spectra_only;
        let mut readings = table.readings()?;
        let scale = table.scaled(&mut readings, scale)?;
        let wavelengths = table.columns.iter().filter_map(|column| match column {
            Column::Wavelength(nm) => Some(*nm),
            _ => None,
        });
        let mut wavelengths: Vec<f64> = wavelengths.collect();
        if wavelengths.is_sorted_by(|a, b| a > b) {
            wavelengths.reverse();
            readings.iter_mut().for_each(|reading| reading.reflectance.reverse());
        }
        let grid = grid_of(&wavelengths);
        let resampled_from = Grid::through(&wavelengths).is_none().then_some(wavelengths.len());
        for reading in &mut readings {
            let values = std::mem::take(&mut reading.reflectance).into_vec();
            reading.reflectance = on_grid(grid, &wavelengths, values).into();
        }
        let pigments = if spectra_only { Vec::new() } else { table.pigments() };
        let mut remarks = if spectra_only { Vec::new() } else { table.remarks() };
        remarks.extend(table.left_out.clone());
        Ok(Self { pigments, grid, resampled_from, scale, readings, remarks })
    }
}

/// Whether a text is the CSV of this module rather than an instrument's file: some line names a column of
/// samples and wavelengths, or the first line a column `sample`.
#[must_use]
pub fn is_measurement_csv(text: &str) -> bool {
    HeadingRow::of(text, TableKind::Readings).is_some() || RawRows::turned(text).is_some()
}

/// Whether the first line of a text names a column `sample`, which no instrument's file does.
#[must_use]
pub fn begins_with_samples(text: &str) -> bool {
    let first = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    [',', ';', '\t'].into_iter().any(|separator| {
        first
            .split(separator)
            .any(|cell: &str| cell.trim().trim_matches('"').trim().eq_ignore_ascii_case("sample"))
    })
}
