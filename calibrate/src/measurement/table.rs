//! Reading a measurement CSV.

use std::sync::Arc;

use spectra::{Ends, Grid, Samples};

use super::column::{Column, columns};
use super::error::{MeasurementError, Place};
use super::scale::{Scale, ScaleChoice};

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
}

impl MeasurementTable {
    /// The readings in `bytes`, the content of `file`.
    ///
    /// # Errors
    /// [`MeasurementError`], with row and column.
    pub fn from_csv(
        file: &str,
        bytes: &[u8],
        scale: ScaleChoice,
    ) -> Result<Self, MeasurementError> {
        Self::read(file, bytes, scale, false)
    }

    /// The spectra alone: whatever stands in other columns is passed over, and
    /// the table has no pigments.
    ///
    /// # Errors
    /// As [`MeasurementTable::from_csv`].
    pub fn spectra_from_csv(
        file: &str,
        bytes: &[u8],
        scale: ScaleChoice,
    ) -> Result<Self, MeasurementError> {
        Self::read(file, bytes, scale, true)
    }

    fn read(
        file: &str,
        bytes: &[u8],
        scale: ScaleChoice,
        spectra_only: bool,
    ) -> Result<Self, MeasurementError> {
        let text = decoded(file, bytes)?;
        if text.trim_start().starts_with('{') {
            return Err(MeasurementError::NoTable { file: file.to_owned(), found: "JSON" });
        }
        let first_line = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
        if text.trim().is_empty() {
            return Err(MeasurementError::Empty { file: file.to_owned() });
        }
        if let Some(separator) = [';', '\t'].into_iter().find(|&c| first_line.contains(c))
            && !first_line.contains(',')
        {
            return Err(MeasurementError::Separator { file: file.to_owned(), separator });
        }
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut records = reader.records().map(|r| r.expect("checked text is always records"));
        let header = records.next().unwrap_or_default();
        let mut headers: Vec<&str> = header.iter().collect();
        // Spreadsheets like to leave empty columns at the right.
        let width =
            headers.iter().rposition(|header| !header.is_empty()).map_or(0, |last| last + 1);
        headers.truncate(width);
        let columns = columns(file, &headers)?;
        let rows: Vec<csv::StringRecord> =
            records.filter(|record| record.iter().any(|cell| !cell.is_empty())).collect();
        if rows.is_empty() {
            return Err(MeasurementError::Empty { file: file.to_owned() });
        }
        let sheet =
            Sheet { file: &file.into(), headers: &headers, columns: &columns, spectra_only };
        let mut readings =
            rows.iter().map(|row| sheet.reading(row)).collect::<Result<Vec<_>, _>>()?;
        let scale = sheet.scaled(&mut readings, scale)?;
        let names = columns.iter().filter_map(|column| match column {
            Column::Pigment(name) if !spectra_only => Some(name.clone()),
            _ => None,
        });
        let wavelengths = columns.iter().filter_map(|column| match column {
            Column::Wavelength(nm) => Some(*nm),
            _ => None,
        });
        let wavelengths: Vec<f64> = wavelengths.collect();
        let grid = Grid::through(&wavelengths);
        let resampled_from = grid.is_none().then_some(wavelengths.len());
        let grid = grid.unwrap_or_else(|| {
            let grid = regular_grid(&wavelengths);
            for reading in &mut readings {
                let values = std::mem::take(&mut reading.reflectance);
                let samples = Samples::new(wavelengths.clone(), values).expect("columns rise");
                let at = |nm| samples.at_linear(nm, Ends::Hold).expect("ends are held");
                reading.reflectance = grid.wavelengths_nm().map(at).collect();
            }
            grid
        });
        Ok(Self { pigments: names.collect(), grid, resampled_from, scale, readings })
    }
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
        }
        let count = all.pigments.len();
        all.readings.iter_mut().for_each(|reading| reading.amounts.resize(count, 0.0));
        Ok(all)
    }
}

/// The regular grid for irregular wavelengths: inside their band, at the
/// smallest of 1, 2, 5, 10 and 20 nm that is not finer than their median step (by
/// more than 5 %).
fn regular_grid(wavelengths_nm: &[f64]) -> Grid {
    let mut steps: Vec<f64> = wavelengths_nm.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let median = steps[steps.len() / 2];
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|s| 1.05 * s >= median).unwrap_or(20.0);
    let last = wavelengths_nm[wavelengths_nm.len() - 1];
    let round = (wavelengths_nm[0] / step).ceil() * step;
    let start = if round <= last { round } else { wavelengths_nm[0] };
    let count = ((last - start) / step).floor().max(0.0) as usize + 1;
    Grid::from_nm(start, step, count).expect("rising wavelengths span a grid")
}

/// The text, without a byte order mark.
fn decoded<'a>(file: &str, bytes: &'a [u8]) -> Result<&'a str, MeasurementError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    std::str::from_utf8(bytes).map_err(|error| {
        let at = error.valid_up_to();
        let row = 1 + bytes[..at].iter().filter(|&&b| b == b'\n').count() as u64;
        MeasurementError::Encoding { file: file.to_owned(), row, byte: bytes[at] }
    })
}

/// Beyond it sums of amounts lose their small parts.
const LARGEST_AMOUNT: f64 = 1e12;

/// The header row, for reading the others.
struct Sheet<'a> {
    file: &'a Arc<str>,
    headers: &'a [&'a str],
    columns: &'a [Column],
    spectra_only: bool,
}

impl Sheet<'_> {
    fn reading(&self, record: &csv::StringRecord) -> Result<Reading, MeasurementError> {
        let row = record.position().map_or(0, csv::Position::line);
        let surplus_is_empty = record.iter().skip(self.columns.len()).all(str::is_empty);
        if record.len() < self.columns.len() || !surplus_is_empty {
            return Err(MeasurementError::RowLength {
                file: self.file.to_string(),
                row,
                wanted: self.columns.len(),
                found: record.len(),
            });
        }
        let mut reading = Reading {
            file: Arc::clone(self.file),
            row,
            sample: String::new(),
            film: Film::Paint,
            backing: String::new(),
            thickness_mm: None,
            amounts: Vec::new(),
            reflectance: Vec::new(),
        };
        for (index, (cell, column)) in record.iter().zip(self.columns).enumerate() {
            let wrong = |wanted| MeasurementError::Cell {
                place: Place::new(self.file, row, self.headers[index]),
                wanted,
                text: cell.to_owned(),
            };
            let number = |wanted| match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                _ => Err(wrong(wanted)),
            };
            match column {
                Column::Sample if cell.is_empty() => return Err(wrong("the sample's name")),
                Column::Sample | Column::Backing if cell.contains(char::is_control) => {
                    return Err(wrong("a name without control characters"));
                }
                Column::Sample => cell.clone_into(&mut reading.sample),
                Column::Film => {
                    reading.film = match cell.to_ascii_lowercase().as_str() {
                        "paint" | "" => Film::Paint,
                        "none" => Film::None,
                        _ => return Err(wrong("`paint` or `none`")),
                    }
                }
                Column::Backing => cell.clone_into(&mut reading.backing),
                Column::Thickness if cell.is_empty() => {}
                Column::Thickness => {
                    let thickness = number("a thickness in mm")?;
                    if thickness <= 0.0 {
                        return Err(wrong("a thickness above 0 mm"));
                    }
                    reading.thickness_mm = Some(thickness);
                }
                Column::Replicate => {}
                Column::Pigment(_) if self.spectra_only => {}
                Column::Pigment(_) if cell.is_empty() => reading.amounts.push(0.0),
                Column::Pigment(_) => {
                    let amount = number("an amount of pigment")?;
                    if !(0.0..=LARGEST_AMOUNT).contains(&amount) {
                        return Err(wrong("an amount from 0 to 1e12"));
                    }
                    reading.amounts.push(amount);
                }
                Column::Wavelength(_) => reading.reflectance.push(number("a reflectance")?),
            }
        }
        Ok(reading)
    }

    /// Makes fractions of the readings, and says what they were.
    fn scaled(
        &self,
        readings: &mut [Reading],
        choice: ScaleChoice,
    ) -> Result<Scale, MeasurementError> {
        let largest = |reading: &Reading| reading.reflectance.iter().copied().fold(0.0, f64::max);
        let scale = match choice {
            ScaleChoice::Told(scale) => scale,
            ScaleChoice::ByFile => {
                let scale = Scale::of_largest(readings.iter().map(largest).fold(0.0, f64::max));
                // No film, not even bone black, reflects below 1 % throughout.
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
        let names = self
            .headers
            .iter()
            .zip(self.columns)
            .filter(|(_, column)| matches!(column, Column::Wavelength(_)));
        let names: Vec<&str> = names.map(|(name, _)| *name).collect();
        for reading in readings {
            for (value, name) in reading.reflectance.iter_mut().zip(&names) {
                let fraction = *value * scale.to_fraction();
                if !(0.0..=2.0).contains(&fraction) {
                    return Err(MeasurementError::Reflectance {
                        place: Place::new(self.file, reading.row, name),
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
