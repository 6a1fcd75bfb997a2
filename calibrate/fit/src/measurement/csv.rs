//! Reads a measurement CSV. We read a large one in pieces, so that only the readings are in memory
//! at once.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use documents::file::is_standard_input;
use spectra::Grid;
use spectra::csv_table::{CsvTableError, RowNumbers};
use spectra::instrument::is_long_table;

use super::column::{Column, TableKind};
use super::conditions::{repeated, split_by_condition};
use super::csv_rows::{CsvRows, RawRows};
use super::error::MeasurementError;
use super::heading_row::HeadingRow;
use super::scale::{DarkReadings, Scale, ScaleChoice};
use super::scaled::ScaledReadings;
use super::table::{MeasurementTable, grid_of, on_grid};

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

    /// Reads the measurement table in `bytes`. Only the columns headed as one of `pigments` are pigments.
    /// If you pass `None`, we take every column that we do not know as something else and that holds
    /// amounts.
    ///
    /// # Errors
    /// [`MeasurementError`] with row and column.
    pub fn from_csv_with(
        file: &str,
        bytes: &[u8],
        scale: ScaleChoice,
        pigments: Option<&[String]>,
    ) -> Result<Self, MeasurementError> {
        let (table, has_replicates) =
            Self::unfinished(file, bytes, TableKind::Readings, pigments, scale, true)?;
        table.finished(has_replicates)
    }

    /// Reads only the spectra of the table. We ignore all other columns but the names, and the table has no
    /// pigments.
    ///
    /// # Errors
    /// [`MeasurementError`] with row and column.
    pub fn spectra_from_csv(
        file: &str,
        bytes: &[u8],
        scale: ScaleChoice,
    ) -> Result<Self, MeasurementError> {
        let (table, has_replicates) =
            Self::unfinished(file, bytes, TableKind::Spectra, None, scale, true)?;
        table.finished(has_replicates)
    }

    /// Reads the rows of a table or of a part of it, and whether a column says which readings are repeated.
    /// A part of a table does not leave out noise, because other parts would keep these wavelengths.
    fn unfinished(
        file: &str,
        bytes: &[u8],
        kind: TableKind,
        pigments: Option<&[String]>,
        scale: ScaleChoice,
        is_whole: bool,
    ) -> Result<(Self, bool), MeasurementError> {
        let table = CsvRows::open(file, bytes, kind, pigments)?;
        let found = table.readings()?;
        let scaled = ScaledReadings::of(&table, found, scale, is_whole)?;
        let ScaledReadings { scale, wavelengths_nm, mut readings, remarks: noise } = scaled;
        let grid = grid_of(&wavelengths_nm);
        let resampled_from =
            Grid::through(&wavelengths_nm).is_none().then_some(wavelengths_nm.len());
        for reading in &mut readings {
            let values = std::mem::take(&mut reading.reflectance).into_vec();
            reading.reflectance = on_grid(grid, &wavelengths_nm, values).into();
        }
        let is_spectra = kind == TableKind::Spectra;
        let pigments = if is_spectra { Vec::new() } else { table.pigments() };
        let mut remarks = if is_spectra { Vec::new() } else { table.remarks() };
        remarks.extend(table.left_out.clone());
        remarks.extend(noise);
        let has_replicates = table.columns.contains(&Column::Replicate);
        let geometry = table.geometry();
        let table = Self { pigments, grid, resampled_from, scale, geometry, readings, remarks };
        Ok((table, has_replicates))
    }

    /// Tells apart the readings of one name that are no repeated readings, and says which are averaged.
    fn finished(mut self, has_replicates: bool) -> Result<Self, MeasurementError> {
        if let Some(split) = split_by_condition(&mut self.readings) {
            if split.is_geometry && !self.pigments.is_empty() {
                return Err(MeasurementError::SeveralGeometries {
                    file: self.readings[0].file.to_string(),
                    row: split.row,
                    sample: split.sample,
                    column: split.heading,
                    count: split.count,
                });
            }
            self.remarks.push(split.remark());
        }
        if !has_replicates {
            self.remarks.extend(repeated(&self.readings));
        }
        Ok(self)
    }
}

/// Whether we read a text as the CSV of this module and not as an instrument's file. Some line must name a
/// column of samples and wavelengths, or the table have a column for each sample with rows about it.
#[must_use]
pub fn is_measurement_csv(text: &str) -> bool {
    let heading = HeadingRow::of(text, TableKind::Readings);
    let has_table = heading.is_some_and(|row| row.has_wavelengths(text));
    (has_table || RawRows::turned(text).is_some()) && !is_long_table(text)
}

/// Whether the first line of a text names a column `sample` and wavelengths, which no instrument's file does.
#[must_use]
pub fn begins_with_samples(text: &str) -> bool {
    let start = text.len() - text.trim_start().len();
    let line = text[start..].lines().next().unwrap_or_default();
    [b',', b';', b'\t'].into_iter().any(|separator| {
        let has_sample = line
            .split(char::from(separator))
            .any(|cell: &str| cell.trim().trim_matches('"').trim().eq_ignore_ascii_case("sample"));
        has_sample && HeadingRow { separator, offset: start }.has_wavelengths(text)
    })
}

/// A piece has about this many bytes.
const PIECE: usize = 2 << 20;
/// We read a file in pieces if it has more bytes than this.
const LARGE: u64 = 32 << 20;
/// We need this many readings to see which columns are pigments.
const LEAST_ROWS: usize = 3;
/// We look for the first row of readings in this many bytes.
const HEAD: usize = 1 << 20;

#[derive(Debug)]
pub(crate) struct LargeCsv {
    path: PathBuf,
    file: String,
    piece: usize,
    /// Lines down to the header, with their ends.
    head: Vec<u8>,
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct LargeCsvChoice<'a> {
    pub(crate) scale: ScaleChoice,
    /// Headings of the pigments. Pass `None` to let us find them.
    pub(crate) pigments: Option<&'a [String]>,
    /// Whether all columns but names and wavelengths are ignored.
    pub(crate) spectra_only: bool,
}

impl LargeCsv {
    /// Opens `path` if it is a measurement CSV of more than 32 MB with line feeds. You get `None` for all
    /// other files.
    ///
    /// # Errors
    /// The system's error if the file cannot be read.
    pub(crate) fn open(path: &Path) -> io::Result<Option<Self>> {
        // Whoever reads the file next reports that it is missing.
        if is_standard_input(path) || std::fs::metadata(path).map_or(0, |found| found.len()) < LARGE
        {
            return Ok(None);
        }
        Self::in_pieces_of(path, PIECE)
    }

    /// Opens `path` of any size, to be read in pieces of about `piece` bytes.
    fn in_pieces_of(path: &Path, piece: usize) -> io::Result<Option<Self>> {
        let mut reader = BufReader::new(File::open(path)?);
        let mut head = Vec::new();
        while head.trim_ascii().is_empty() || quotes(&head) % 2 == 1 {
            let length = reader.by_ref().take(HEAD as u64).read_until(b'\n', &mut head)?;
            if length == 0 || head.len() >= HEAD || head.contains(&0) {
                return Ok(None);
            }
        }
        let is_csv = std::str::from_utf8(&head).is_ok_and(is_measurement_csv);
        let file = path.display().to_string();
        Ok(is_csv.then(|| Self { path: path.to_owned(), file, piece, head }))
    }

    pub(crate) fn file(&self) -> &str {
        &self.file
    }

    /// Reads the table in two passes. In the first we find pigments and unit, in the second we read.
    ///
    /// # Errors
    /// [`LargeCsvError`] with row and column.
    pub(crate) fn table(
        &self,
        choice: LargeCsvChoice<'_>,
    ) -> Result<MeasurementTable, LargeCsvError> {
        let mut scale = Scale::Fraction;
        let mut pigments: Vec<String> = Vec::new();
        self.each_piece(|bytes| {
            let part = match self.part(bytes, choice) {
                // A piece may hold the black patches of a whole file.
                Err(MeasurementError::MixedScale { .. }) => {
                    let percent = ScaleChoice::Known(Scale::Percent);
                    self.part(bytes, LargeCsvChoice { scale: percent, ..choice })?.0
                }
                part => part?.0,
            };
            if part.scale == Scale::Percent {
                scale = Scale::Percent;
            }
            // Fewer rows do not show which columns are pigments.
            if pigments.is_empty() || part.readings.len() >= LEAST_ROWS {
                let known: BTreeSet<&String> = pigments.iter().collect();
                let new = part.pigments.into_iter().filter(|name| !known.contains(name));
                let new: Vec<String> = new.collect();
                pigments.extend(new);
            }
            Ok(())
        })?;
        loop {
            let known = LargeCsvChoice {
                scale: ScaleChoice::Known(scale),
                pigments: if choice.spectra_only { None } else { Some(&pigments) },
                ..choice
            };
            let found = self.readings(known, choice.scale == ScaleChoice::ByFile);
            // A column of notes may be empty in whole pieces. We would then take it for amounts of 0.
            if let Err(LargeCsvError::Measurement(MeasurementError::Sheet(CsvTableError::Cell {
                place,
                ..
            }))) = &found
                && choice.pigments.is_none()
                && let Some(at) = pigments.iter().position(|name| *name == place.column)
                && !self.is_number_anywhere(&place.column)?
            {
                pigments.remove(at);
                continue;
            }
            return found;
        }
    }

    /// Reads the table with known pigments and unit.
    fn readings(
        &self,
        known: LargeCsvChoice<'_>,
        unit_is_found: bool,
    ) -> Result<MeasurementTable, LargeCsvError> {
        let mut whole: Option<MeasurementTable> = None;
        let mut dark = DarkReadings::default();
        let mut has_replicates = false;
        self.each_piece(|bytes| {
            let (mut part, of_part) = self.part(bytes, known)?;
            has_replicates |= of_part;
            if unit_is_found && part.scale == Scale::Percent {
                for r in &part.readings {
                    dark.add(r.row, &r.sample, 100.0 * largest(&r.reflectance));
                }
            }
            match &mut whole {
                None => whole = Some(part),
                Some(whole) => whole.readings.append(&mut part.readings),
            }
            Ok(())
        })?;
        let mut whole = whole.ok_or_else(|| MeasurementError::Empty(self.file.clone()))?;
        whole.remarks.extend(dark.checked(&self.file)?);
        Ok(whole.finished(has_replicates)?)
    }

    /// Whether a cell of the column holds a number in any piece.
    fn is_number_anywhere(&self, column: &str) -> Result<bool, LargeCsvError> {
        let mut found = false;
        self.each_piece(|bytes| {
            let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(bytes);
            let headers = reader.headers().cloned().unwrap_or_default();
            let place = headers.iter().position(|header| header.trim() == column);
            found |= place.is_none();
            for record in reader.records().filter_map(Result::ok) {
                let cell = place.and_then(|place| record.get(place)).unwrap_or_default().trim();
                found |= cell.replace(',', ".").parse::<f64>().is_ok();
            }
            Ok(())
        })?;
        Ok(found)
    }

    fn part(
        &self,
        bytes: &[u8],
        choice: LargeCsvChoice<'_>,
    ) -> Result<(MeasurementTable, bool), MeasurementError> {
        let kind = if choice.spectra_only { TableKind::Spectra } else { TableKind::Readings };
        let LargeCsvChoice { pigments, scale, .. } = choice;
        MeasurementTable::unfinished(&self.file, bytes, kind, pigments, scale, false)
    }

    /// Calls `read` with one piece of the file after another. Each piece is the header followed by whole
    /// rows. We add empty lines so that rows have the same numbers as in the file.
    fn each_piece(
        &self,
        mut read: impl FnMut(&[u8]) -> Result<(), MeasurementError>,
    ) -> Result<(), LargeCsvError> {
        let mut reader = BufReader::new(File::open(&self.path)?);
        reader.seek(SeekFrom::Start(self.head.len() as u64))?;
        let mut skipped = 0;
        loop {
            let mut bytes = self.head.clone();
            bytes.resize(bytes.len() + skipped, b'\n');
            let start = bytes.len();
            let mut is_open = false;
            while is_open || bytes.len() - start < self.piece {
                let before = bytes.len();
                if reader.read_until(b'\n', &mut bytes)? == 0 {
                    break;
                }
                is_open ^= quotes(&bytes[before..]) % 2 == 1;
            }
            if bytes.len() == start {
                return Ok(());
            }
            if !bytes[start..].trim_ascii().is_empty() {
                read(&bytes)?;
            }
            skipped += lines(&bytes[start..]) as usize;
        }
    }
}

fn lines(bytes: &[u8]) -> u64 {
    RowNumbers::of(bytes).at(bytes.len() as u64) - 1
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

fn quotes(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| **byte == b'"').count()
}

#[derive(Debug, thiserror::Error)]
pub(crate) enum LargeCsvError {
    #[error(transparent)]
    System(#[from] io::Error),
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice() -> LargeCsvChoice<'static> {
        LargeCsvChoice { scale: ScaleChoice::ByFile, pigments: None, spectra_only: false }
    }

    /// The table of `text` in pieces of 200 bytes, and as a whole.
    fn both(text: &str) -> [Result<MeasurementTable, MeasurementError>; 2] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        std::fs::write(&path, text).unwrap();
        let large = LargeCsv::in_pieces_of(&path, 200).unwrap().unwrap();
        let pieces = large.table(choice()).map_err(|error| match error {
            LargeCsvError::Measurement(error) => error,
            LargeCsvError::System(error) => panic!("{error}"),
        });
        let file = path.display().to_string();
        [pieces, MeasurementTable::from_csv(&file, text.as_bytes(), ScaleChoice::ByFile)]
    }

    #[test]
    fn pieces_give_the_table_of_the_whole_file() {
        let mut text = "\r\nsample,film,Note,White,Red,Lux,400,500\r\n".to_owned();
        for row in 0..40 {
            let white = f64::from(row % 5) / 4.0;
            let red = f64::from(4 - row % 5) / 4.0;
            let blank = if row % 7 == 0 { "\r\n" } else { "" };
            let note = if row % 20 > 16 { "\"two\r\nlines\"" } else { "" };
            text += &format!("s{row},,{note},{white},{red},{row}9,{}.5,30\r\n{blank}", row % 3);
        }
        let [pieces, whole] = both(&text);
        let pieces = pieces.unwrap();
        let whole = whole.unwrap();
        assert_eq!(pieces, whole);
        assert_eq!(whole.pigments, ["White", "Red"]);
    }

    #[test]
    fn faults_in_pieces_name_the_row_of_the_file() {
        for (place, value) in [(25, "x"), (2, "-40")] {
            let mut text = "sample,White,400,500\n".to_owned();
            (0..40).for_each(|at| text += &row(at, if at == place { value } else { "40" }));
            let [pieces, whole] = both(&text);
            let pieces = pieces.unwrap_err();
            let whole = whole.unwrap_err();
            assert_eq!(pieces, whole);
            assert!(whole.to_string().contains(&format!("row {}", place + 2)), "{whole}");
        }
    }

    #[test]
    fn a_black_patch_of_a_file_in_percent_is_read_and_a_second_group_is_refused() {
        for (each, is_read) in [(33, true), (7, true), (3, false), (2, false)] {
            let mut text = "sample,White,400,500\n".to_owned();
            for at in 0..40 {
                text += &row(at, if at % each == each - 1 { "0.5" } else { "40" });
            }
            let [pieces, whole] = both(&text.replace("0.5,30", "0.5,0.4"));
            assert_eq!(pieces, whole, "one in {each}");
            match whole {
                Ok(table) => {
                    let remark = format!("s{} is read as at most 0.5 %", each - 1);
                    assert!(table.remarks.last().unwrap().starts_with(&remark), "{table:?}");
                    assert!(is_read && table.readings[each - 1].reflectance[0] == 0.005);
                }
                Err(MeasurementError::MixedScale { row, largest, .. }) => {
                    assert_eq!((is_read, row, largest), (false, each as u64 + 1, 0.5));
                }
                Err(error) => panic!("{error}"),
            }
        }
    }

    fn row(name: usize, value: &str) -> String {
        format!("s{name},1,{value},30\n")
    }
}
