//! Rows of a measurement CSV or of a CSV of recipes, and their readings.

use std::collections::BTreeSet;
use std::sync::Arc;

use spectra::csv_table::{CellPlace, CsvTableError};
use spectra::instrument::FileText;

use super::column::{Column, TableKind, columns, excludes_specular};
use super::csv_row::CsvRow;
use super::error::MeasurementError;
use super::name_column::{filled_column, name_rank};
use super::no_amounts::without_amounts;
use super::raw_rows::RawRows;
use super::scale::{Scale, ScaleChoice};
use super::table::{Film, Reading};

/// Greatest reflectance of a reading, as a fraction; a value above is a mistaken unit.
const LARGEST_REFLECTANCE: f64 = 2.0;

/// The finite number in a cell. With decimal commas, a point may separate thousands.
fn parsed(cell: &str, decimal_comma: bool) -> Option<f64> {
    let value = match decimal_comma {
        true if cell.contains('.') => None,
        true => cell.replace(',', ".").parse::<f64>().ok(),
        false => cell.parse::<f64>().ok(),
    };
    value.filter(|value| value.is_finite())
}

/// The name equal to `name` among `known`, to which it is added.
fn shared(name: &str, known: &mut BTreeSet<Arc<str>>) -> Arc<str> {
    if let Some(found) = known.get(name) {
        return Arc::clone(found);
    }
    let new: Arc<str> = name.into();
    known.insert(Arc::clone(&new));
    new
}

/// Makes the column of names the first of those headed as one in which every row has a name.
fn take_filled_names(headers: &[String], columns: &mut [Column], rows: &[CsvRow]) {
    let Some(taken) = columns.iter().position(|column| *column == Column::Sample) else { return };
    let mut places: Vec<(Option<usize>, usize)> = (0..columns.len())
        .filter(|&place| place == taken || columns[place] == Column::Ignored)
        .map(|place| (name_rank(&headers[place]), place))
        .filter(|&(rank, place)| rank.is_some() || place == taken)
        .collect();
    places.sort_by_key(|&(rank, place)| (place != taken, rank));
    let places: Vec<usize> = places.into_iter().map(|(_, place)| place).collect();
    if let Some(filled) = filled_column(&places, rows) {
        columns[taken] = Column::Ignored;
        columns[filled] = Column::Sample;
    }
}

/// Whether commas in the cells of numbers are decimal signs. Where commas separate the cells as well, those
/// of quoted readings are, since no reflectance has thousands; amounts alone could have them.
fn has_decimal_commas(separator: u8, columns: &[Column], rows: &[CsvRow]) -> bool {
    let decides = |column: &Column| match column {
        Column::Wavelength(_) => true,
        Column::Pigment(_) | Column::Thickness => separator != b',',
        _ => false,
    };
    rows.iter().any(|row: &CsvRow| {
        row.cells.iter().zip(columns).any(|(cell, column)| decides(column) && cell.contains(','))
    })
}

/// Largest amount of a pigment; beyond it sums lose their small terms.
const LARGEST_AMOUNT: f64 = 1e12;

/// A CSV table: its header row, the meaning of each column, and the rows below.
pub(super) struct CsvRows {
    pub(super) file: Arc<str>,
    /// Row of the headers in the file, from 1.
    heading_row: u64,
    /// In a table with a column for each sample: the row of each header.
    heading_rows: Option<Vec<u64>>,
    pub(super) headers: Vec<String>,
    pub(super) columns: Vec<Column>,
    pub(super) rows: Vec<CsvRow>,
    /// Whether numbers have a decimal comma; between commas such cells are quoted.
    decimal_comma: bool,
    /// Whether the rows are those of a workbook's sheet.
    is_sheet: bool,
    pub(super) spectra_only: bool,
    /// Messages about readings that are not taken: of other sheets, without the specular component.
    pub(super) left_out: Vec<String>,
}

impl CsvRows {
    /// Opens the table in `bytes`. Cells are separated by commas, or by semicolons or tabs, as
    /// spreadsheets write them where the comma is the decimal sign.
    pub(super) fn open(
        file: &str,
        bytes: &[u8],
        kind: TableKind,
        pigments: Option<&[String]>,
    ) -> Result<Self, MeasurementError> {
        let content = FileText::of(file, bytes).map_err(MeasurementError::Instrument)?;
        let Some(content) = content else {
            let found = "a binary file of an instrument";
            return Err(MeasurementError::NoTable { file: file.to_owned(), found });
        };
        let file = content.file.as_str();
        let text = &content.text;
        if text.trim_start().starts_with('{') {
            return Err(MeasurementError::NoTable { file: file.to_owned(), found: "JSON" });
        }
        if text.trim().is_empty() {
            return Err(MeasurementError::Empty { file: file.to_owned() });
        }
        let RawRows { separator, heading_row, headings: headers, rows, heading_rows } =
            RawRows::of(text, kind);
        let place = |index: usize| {
            let row = heading_rows.as_ref().map_or(heading_row, |rows| rows[index]);
            let place = CellPlace::new(file, row, &headers[index]);
            let is_plain = content.is_sheet && heading_rows.is_none();
            if is_plain { place.in_workbook(index) } else { place }
        };
        let mut columns = columns(&place, &headers, kind, pigments)?;
        if rows.is_empty() {
            return Err(MeasurementError::Empty { file: file.to_owned() });
        }
        take_filled_names(&headers, &mut columns, &rows);
        let decimal_comma = has_decimal_commas(separator, &columns, &rows);
        if pigments.is_none() {
            for place in without_amounts(&columns, &rows, |cell: &str| parsed(cell, decimal_comma))
            {
                columns[place] = Column::Ignored;
            }
        }
        let excluded = headers
            .iter()
            .zip(&columns)
            .filter(|(name, column)| **column == Column::Ignored && excludes_specular(name));
        let excluded = (excluded.count() > 0).then(|| {
            format!("{file}: readings without the specular component (SCE) are left out; those with it are read")
        });
        let left_out = content.remark.into_iter().chain(excluded);
        let file = file.into();
        Ok(Self {
            file,
            heading_row,
            heading_rows,
            headers,
            columns,
            rows,
            decimal_comma,
            is_sheet: content.is_sheet,
            spectra_only: false,
            left_out: left_out.collect(),
        })
    }

    /// The header `index`, from 0.
    pub(super) fn header_place(&self, index: usize) -> CellPlace {
        let row = self.heading_rows.as_ref().map_or(self.heading_row, |rows| rows[index]);
        CellPlace::new(&self.file, row, &self.headers[index])
    }

    /// The cell of `row` below the header `index`, from 0; of a table with a column for each sample, in the
    /// column of the sample.
    fn place(&self, row: &CsvRow, index: usize) -> CellPlace {
        match &self.heading_rows {
            Some(rows) => {
                let sample = row.cells.get(0).unwrap_or_default();
                CellPlace::new(&self.file, rows[index], sample)
            }
            None if self.is_sheet => {
                CellPlace::new(&self.file, row.number, &self.headers[index]).in_workbook(index)
            }
            None => CellPlace::new(&self.file, row.number, &self.headers[index]),
        }
    }

    /// Names of the pigment columns.
    pub(super) fn pigments(&self) -> Vec<String> {
        let names = self.columns.iter().filter_map(|column| match column {
            Column::Pigment(name) => Some(name.clone()),
            _ => None,
        });
        names.collect()
    }

    /// Remark on the columns that are ignored, if there are any.
    pub(super) fn remarks(&self) -> Vec<String> {
        let named = self.headers.iter().zip(&self.columns);
        let ignored: Vec<&str> = named
            .filter(|(name, column)| **column == Column::Ignored && !name.is_empty())
            .filter(|(name, _)| !excludes_specular(name))
            .map(|(name, _)| name.as_str())
            .collect();
        (!ignored.is_empty())
            .then(|| {
                format!(
                    "{}: columns that hold no amounts of a pigment are ignored: {}",
                    self.file,
                    ignored.join(", ")
                )
            })
            .into_iter()
            .collect()
    }

    /// One reading for every row.
    pub(super) fn readings(&self) -> Result<Vec<Reading>, MeasurementError> {
        let mut backings = BTreeSet::new();
        self.rows.iter().map(|row| self.reading(row, &mut backings)).collect()
    }

    /// The reading of a row. `backings` holds the names of the rows before, so that readings share them.
    fn reading(
        &self,
        csv_row: &CsvRow,
        backings: &mut BTreeSet<Arc<str>>,
    ) -> Result<Reading, MeasurementError> {
        let row = csv_row.number;
        let record = &csv_row.cells;
        let surplus_is_empty = record.iter().skip(self.columns.len()).all(str::is_empty);
        if record.len() < self.columns.len() || !surplus_is_empty {
            return Err(MeasurementError::Sheet(CsvTableError::RowLength {
                file: self.file.to_string(),
                row,
                wanted: self.columns.len(),
                found: record.len(),
            }));
        }
        let mut reading = Reading {
            file: Arc::clone(&self.file),
            row,
            sample: String::new(),
            film: Film::Paint,
            backing: shared("", backings),
            thickness_mm: None,
            amounts: Box::default(),
            reflectance: Box::default(),
        };
        let count = |is_one: fn(&Column) -> bool| self.columns.iter().filter(|c| is_one(c)).count();
        let mut amounts = Vec::with_capacity(count(|c| matches!(c, Column::Pigment(_))));
        let mut reflectance = Vec::with_capacity(count(|c| matches!(c, Column::Wavelength(_))));
        for (index, (cell, column)) in record.iter().zip(&self.columns).enumerate() {
            let wrong = |wanted| {
                MeasurementError::Sheet(CsvTableError::Cell {
                    place: self.place(csv_row, index),
                    wanted,
                    text: cell.to_owned(),
                })
            };
            let number = |wanted| parsed(cell, self.decimal_comma).ok_or_else(|| wrong(wanted));
            match column {
                Column::Sample if cell.is_empty() => return Err(wrong("the sample's name")),
                Column::Sample | Column::Backing if cell.contains(char::is_control) => {
                    return Err(wrong("a name without control characters"));
                }
                Column::Sample => cell.clone_into(&mut reading.sample),
                Column::Film => {
                    reading.film = Film::named(cell).ok_or_else(|| wrong("`paint` or `none`"))?;
                }
                Column::Backing => reading.backing = shared(cell, backings),
                Column::Thickness if cell.is_empty() => {}
                Column::Thickness => {
                    let thickness = number("a thickness in mm")?;
                    if thickness <= 0.0 {
                        return Err(wrong("a thickness above 0 mm"));
                    }
                    reading.thickness_mm = Some(thickness);
                }
                Column::Replicate | Column::Ignored | Column::Reading => {}
                Column::Pigment(_) if self.spectra_only => {}
                Column::Pigment(_) if cell.is_empty() => amounts.push(0.0),
                Column::Pigment(_) => {
                    let amount = number("an amount of pigment")?;
                    if !(0.0..=LARGEST_AMOUNT).contains(&amount) {
                        return Err(wrong("an amount from 0 to 1e12"));
                    }
                    amounts.push(amount);
                }
                Column::Wavelength(_) => reflectance.push(number("a reflectance")?),
            }
        }
        Ok(Reading { amounts: amounts.into(), reflectance: reflectance.into(), ..reading })
    }

    /// Converts the readings to fractions, and returns the unit that they had.
    pub(super) fn scaled(
        &self,
        readings: &mut [Reading],
        choice: ScaleChoice,
    ) -> Result<Scale, MeasurementError> {
        let largest = |reading: &Reading| reading.reflectance.iter().copied().fold(0.0, f64::max);
        let scale = match choice {
            ScaleChoice::Known(scale) => scale,
            ScaleChoice::ByFile => {
                let scale = Scale::of_largest(readings.iter().map(largest).fold(0.0, f64::max));
                // No film reflects below 1 % at every wavelength, not even bone black.
                let mixed = readings.iter().find(|r| scale == Scale::Percent && largest(r) <= 1.0);
                if let Some(reading) = mixed {
                    return Err(MeasurementError::MixedScale {
                        file: self.file.to_string(),
                        row: reading.row,
                        largest: largest(reading),
                    });
                }
                scale
            }
        };
        let indices: Vec<usize> = (0..self.columns.len())
            .filter(|&index| matches!(self.columns[index], Column::Wavelength(_)))
            .collect();
        for (reading, row) in readings.iter_mut().zip(&self.rows) {
            for (value, &index) in reading.reflectance.iter_mut().zip(&indices) {
                let fraction = *value * scale.to_fraction();
                if !(0.0..=LARGEST_REFLECTANCE).contains(&fraction) {
                    return Err(MeasurementError::Reflectance {
                        place: self.place(row, index),
                        range: scale.range(),
                        value: *value,
                    });
                }
                *value = fraction;
            }
        }
        Ok(scale)
    }
}
