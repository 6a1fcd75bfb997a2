//! Rows of a measurement CSV or of a CSV of recipes, and their readings.
//!
//! A table may also have a column for each sample. We also find here the columns that look like pigments
//! but hold no amounts.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use documents::{from_spreadsheet_cell, name_list, name_violation};
use spectra::csv_table::{CellPlace, CsvTableError, RowNumbers, wavelength_of_header};
use spectra::headings::{is_guessed_name, is_wavelength, name_rank};
use spectra::instrument::{FileText, StatedGeometry, deviations};

use super::column::{
    Column, TableKind, columns, excludes_specular, is_known, is_wavelength_heading,
};
use super::error::MeasurementError;
use super::heading_row::{CsvRow, HeadingRow, filled_column, in_nanometres, plain_heading};
use super::scale::outside_remark;
use super::table::{Conditions, Film, Reading};

/// The finite number in a cell. With decimal commas, a cell with a point gives `None`, because the point
/// may separate thousands.
fn parsed(cell: &str, decimal_comma: bool) -> Option<f64> {
    let value = match decimal_comma {
        true if cell.contains('.') => None,
        true => cell.replace(',', ".").parse::<f64>().ok(),
        false => cell.parse::<f64>().ok(),
    };
    value.filter(|value| value.is_finite())
}

/// Number and unit of a cell such as `5 %` or `2.07g`. The unit is empty if there is none.
fn quantity(cell: &str, decimal_comma: bool) -> Option<(f64, &str)> {
    let end = cell.trim_end_matches(|c: char| c.is_alphabetic() || c == '%' || c == '.');
    let (number, unit) = cell.split_at(end.len());
    let known = ["", "%", "g", "mg", "kg", "ml", "g.", "parts", "part", "drops"];
    let is_known = known.contains(&unit.to_lowercase().as_str());
    let value = parsed(cell, decimal_comma).map(|value| (value, ""));
    value.or_else(|| Some((parsed(number.trim_end(), decimal_comma).filter(|_| is_known)?, unit)))
}

/// The copy of `name` in `known`. If there is none, we add it.
fn shared(name: &str, known: &mut BTreeSet<Arc<str>>) -> Arc<str> {
    if let Some(found) = known.get(name) {
        return Arc::clone(found);
    }
    let new: Arc<str> = name.into();
    known.insert(Arc::clone(&new));
    new
}

/// If several columns have a heading of names, uses the first of them in which every row has a
/// name.
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

/// Whether commas in the cells of numbers are decimal signs. If points occur too, the more frequent sign
/// decides, so that an error names a cell with the other. If commas separate the cells as well, we
/// take commas in quoted readings for decimal signs, because a reflectance needs no separator of
/// thousands. Only an amount may have one.
fn has_decimal_commas(separator: u8, columns: &[Column], rows: &[CsvRow]) -> bool {
    let [mut commas, mut points] = [0_usize; 2];
    for (cell, column) in rows.iter().flat_map(|row| row.cells.iter().zip(columns)) {
        let decides = match column {
            Column::Wavelength(_) => true,
            Column::Pigment(_) | Column::Thickness => separator != b',',
            _ => false,
        };
        let is_number = decides && !cell.contains(char::is_alphabetic);
        commas += usize::from(is_number && cell.contains(','));
        points += usize::from(is_number && cell.contains('.'));
    }
    commas > 0 && commas >= points
}

/// We refuse a larger amount of a pigment, because sums would lose their small terms to rounding.
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
    /// Whether numbers have a decimal comma. If commas also separate the cells, such cells are quoted.
    decimal_comma: bool,
    /// Whether the rows come from a sheet of a workbook.
    is_sheet: bool,
    /// Whether readings are written as `45.2%`.
    pub(super) has_percent_cells: bool,
    /// Unit of the amounts if their cells have one, e.g. `%`.
    amount_unit: String,
    /// Messages about readings that we leave out, e.g. of other sheets, or without the specular component.
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
            return Err(MeasurementError::Empty(file.to_owned()));
        }
        let raw = RawRows::of(text, kind);
        let RawRows { separator, heading_row, headings: headers, mut rows, heading_rows, remark } =
            raw;
        let micrometres = remark.map(|remark| format!("{file}: {remark}"));
        let place = |index: usize| {
            let rows = heading_rows.as_ref();
            let row = rows.and_then(|rows| rows.get(index)).copied().unwrap_or(heading_row);
            let heading = headers.get(index).map_or("", String::as_str);
            let place = CellPlace::new(file, row, heading);
            let is_plain = content.is_sheet && heading_rows.is_none();
            if is_plain { place.in_workbook(index) } else { place }
        };
        let mut columns = columns(&place, &headers, kind, pigments)?;
        if rows.is_empty() {
            return Err(MeasurementError::Empty(file.to_owned()));
        }
        take_filled_names(&headers, &mut columns, &rows);
        let decimal_comma = has_decimal_commas(separator, &columns, &rows);
        if pigments.is_none() {
            let amount = |cell: &str| quantity(cell, decimal_comma).map(|(number, _)| number);
            for place in without_amounts(&columns, &rows, amount) {
                columns[place] = Column::Ignored;
            }
        }
        let has_percent_cells = rows.iter().any(|row| {
            let mut readings = row.cells.iter().zip(&columns);
            readings.any(|(c, column)| matches!(column, Column::Wavelength(_)) && c.ends_with('%'))
        });
        let amount_unit = amount_unit(&columns, &rows, decimal_comma);
        let deviations = take_out_deviations(&columns, &mut rows);
        let excluded = headers
            .iter()
            .zip(&columns)
            .filter(|(name, column)| **column == Column::Ignored && excludes_specular(name));
        let excluded = (excluded.count() > 0).then(|| {
            format!("{file}: readings without the specular component (SCE) are left out; those with it are read")
        });
        let named_by = columns.iter().position(|column| *column == Column::Sample);
        let named_by = named_by.map(|at| &headers[at]).filter(|heading| is_guessed_name(heading));
        let named_by =
            named_by.map(|heading| format!("{file}: samples are named by the column `{heading}`"));
        let cut = outside(&columns).map(|cut| format!("{file}: {cut}"));
        let left_out = content
            .remark
            .into_iter()
            .chain(micrometres)
            .chain(excluded)
            .chain(named_by)
            .chain(cut)
            .chain(deviations);
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
            has_percent_cells,
            amount_unit,
            left_out: left_out.collect(),
        })
    }

    pub(super) fn header_place(&self, index: usize) -> CellPlace {
        let row = self.heading_rows.as_ref().map_or(self.heading_row, |rows| rows[index]);
        CellPlace::new(&self.file, row, &self.headers[index])
    }

    /// The cell of `row` below the header `index`, from 0. If the table has a column for each sample, this
    /// is in the column of the sample.
    pub(super) fn place(&self, row: &CsvRow, index: usize) -> CellPlace {
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

    /// Ignores wavelengths without any reading, as the empty form of a plan has them.
    pub(super) fn ignore_empty_wavelengths(&mut self) {
        for (place, column) in self.columns.iter_mut().enumerate() {
            let is_empty = |row: &CsvRow| row.cells.get(place).is_none_or(str::is_empty);
            if matches!(column, Column::Wavelength(_)) && self.rows.iter().all(is_empty) {
                *column = Column::Ignored;
            }
        }
    }

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
            .filter(|(name, _)| !is_wavelength_heading(name))
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

    pub(super) fn readings(&self) -> Result<Vec<Reading>, MeasurementError> {
        let mut known = SharedTexts::default();
        self.rows.iter().map(|row| self.reading(row, &mut known)).collect()
    }

    /// The reading of a row. `known` holds backings and conditions of the rows before.
    fn reading(
        &self,
        csv_row: &CsvRow,
        known: &mut SharedTexts,
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
            backing: shared("", &mut known.backings),
            thickness_mm: None,
            conditions: known.conditions(&self.headers, &self.columns, record),
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
                Column::Backing if cell.is_empty() => {}
                Column::Sample | Column::Backing if name_violation(cell).is_some() => {
                    return Err(wrong(name_violation(cell).unwrap_or_default()));
                }
                Column::Sample => {
                    from_spreadsheet_cell(cell).clone_into(&mut reading.sample);
                }
                Column::Film => {
                    reading.film = Film::named(cell).ok_or_else(|| wrong("`paint` or `none`"))?;
                }
                Column::Backing => reading.backing = shared(cell, &mut known.backings),
                Column::Thickness if cell.is_empty() => {}
                Column::Thickness => {
                    let thickness = number("a thickness in mm")?;
                    if thickness <= 0.0 {
                        return Err(wrong("a thickness above 0 mm"));
                    }
                    reading.thickness_mm = Some(thickness);
                }
                Column::Replicate
                | Column::Ignored
                | Column::Condition
                | Column::Outside(_)
                | Column::Reading => {}
                Column::Pigment(_) if cell.is_empty() => amounts.push(0.0),
                Column::Pigment(_) => {
                    let amount = quantity(cell, self.decimal_comma);
                    let (amount, unit) = amount.ok_or_else(|| wrong("an amount of pigment"))?;
                    if unit != self.amount_unit && amount != 0.0 {
                        return Err(wrong("an amount in the unit of the other cells"));
                    }
                    if !(0.0..=LARGEST_AMOUNT).contains(&amount) {
                        return Err(wrong("an amount from 0 to 1e12"));
                    }
                    amounts.push(amount);
                }
                Column::Wavelength(_) if self.has_percent_cells => {
                    let percent = cell.strip_suffix('%').map(str::trim_end);
                    let value = percent.and_then(|number| parsed(number, self.decimal_comma));
                    reflectance.push(value.ok_or_else(|| wrong("a reflectance with its `%`"))?);
                }
                Column::Wavelength(_) => reflectance.push(number("a reflectance")?),
            }
        }
        Ok(Reading { amounts: amounts.into(), reflectance: reflectance.into(), ..reading })
    }

    /// The geometry that all headings of wavelengths name, as in `SCE 400nm`.
    pub(super) fn geometry(&self) -> Option<StatedGeometry> {
        let headings = self.headers.iter().zip(&self.columns);
        let mut of_readings = headings
            .filter(|(_, column)| matches!(column, Column::Wavelength(_)))
            .map(|(heading, _)| StatedGeometry::of_words(heading));
        let first = of_readings.next()??;
        let agree = of_readings.all(|other| {
            other.is_some_and(|other| other.includes_specular == first.includes_specular)
        });
        agree.then_some(first)
    }
}

/// Texts that many readings share in memory.
#[derive(Default)]
struct SharedTexts {
    backings: BTreeSet<Arc<str>>,
    texts: BTreeSet<Arc<str>>,
    conditions: BTreeSet<Conditions>,
}

impl SharedTexts {
    fn conditions(
        &mut self,
        headers: &[String],
        columns: &[Column],
        cells: &csv::StringRecord,
    ) -> Conditions {
        let of_row = headers.iter().zip(columns).zip(cells);
        let of_row = of_row.filter(|((_, column), _)| **column == Column::Condition);
        let pairs: Vec<(Arc<str>, Arc<str>)> = of_row
            .map(|((heading, _), cell)| {
                (shared(heading, &mut self.texts), shared(cell, &mut self.texts))
            })
            .collect();
        let new: Conditions = pairs.into();
        if let Some(known) = self.conditions.get(&new) {
            return Arc::clone(known);
        }
        self.conditions.insert(Arc::clone(&new));
        new
    }
}

/// The unit that most amounts have in their cells.
fn amount_unit(columns: &[Column], rows: &[CsvRow], decimal_comma: bool) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for (cell, column) in rows.iter().flat_map(|row| row.cells.iter().zip(columns)) {
        if matches!(column, Column::Pigment(_))
            && let Some((amount, unit)) = quantity(cell, decimal_comma)
            && amount != 0.0
        {
            *counts.entry(unit).or_default() += 1;
        }
    }
    let most = counts.into_iter().max_by_key(|(_, count)| *count);
    most.map_or_else(String::new, |(unit, _)| unit.to_owned())
}

/// A remark on the wavelengths at which no colour instrument measures.
fn outside(columns: &[Column]) -> Option<String> {
    let nm = columns.iter().filter_map(|column| match column {
        Column::Outside(nm) => Some(*nm),
        _ => None,
    });
    outside_remark(nm)
}

/// Takes out the rows that hold deviations of others, and returns a remark.
fn take_out_deviations(columns: &[Column], rows: &mut Vec<CsvRow>) -> Option<String> {
    let sample = columns.iter().position(|column| *column == Column::Sample)?;
    let cells = |place: usize| rows.iter().map(move |row| row.cells.get(place).unwrap_or_default());
    let mut are_deviations = deviations(&cells(sample).collect::<Vec<&str>>());
    // A column of `mean` and `std` beside the names.
    let notes =
        (0..columns.len()).filter(|at| matches!(columns[*at], Column::Ignored | Column::Condition));
    for place in notes {
        let of_column = deviations(&cells(place).collect::<Vec<&str>>());
        are_deviations.iter_mut().zip(of_column).for_each(|(known, own)| *known |= own);
    }
    let count = are_deviations.iter().filter(|is| **is).count();
    if count == 0 || count == rows.len() {
        return None;
    }
    let numbers: Vec<String> = rows
        .iter()
        .zip(&are_deviations)
        .filter(|(_, is)| **is)
        .map(|(row, _)| row.number.to_string())
        .collect();
    let mut are_deviations = are_deviations.into_iter();
    rows.retain(|_| !are_deviations.next().unwrap_or(false));
    let row = if count == 1 { "row" } else { "rows" };
    let hold = if count == 1 { "holds deviations and is" } else { "hold deviations and are" };
    Some(format!("{row} {} {hold} left out", name_list(&numbers, 6, ", ")))
}

/// Headings and rows of a table, before their meaning is known.
pub(super) struct RawRows {
    /// The character between cells.
    pub(super) separator: u8,
    pub(super) heading_row: u64,
    pub(super) headings: Vec<String>,
    pub(super) rows: Vec<CsvRow>,
    /// In a table with a column for each sample: the row of the file in which each heading stands.
    pub(super) heading_rows: Option<Vec<u64>>,
    /// A unit of wavelengths that we guessed, in words.
    remark: Option<String>,
}

impl RawRows {
    /// The table in `text`. If no row looks like headings, we take the first.
    pub(super) fn of(text: &str, kind: TableKind) -> Self {
        if let Some(turned) = Self::turned(text).filter(|_| kind != TableKind::Recipes) {
            return turned;
        }
        let heading = HeadingRow::of(text, kind).unwrap_or_else(|| HeadingRow::first(text));
        Self::below(text, heading)
    }

    fn below(text: &str, heading: HeadingRow) -> Self {
        let mut numbers = RowNumbers::of(text.as_bytes());
        let heading_row = numbers.at(heading.offset as u64);
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .delimiter(heading.separator)
            .from_reader(&text.as_bytes()[heading.offset..]);
        let mut records =
            reader.records().map(|r| r.expect("decoded text can always be split into records"));
        let headings = records.next().unwrap_or_default();
        let headings = headings.iter().map(plain_heading).collect();
        let (mut headings, remark) = in_nanometres(headings);
        // Spreadsheets often leave empty columns at the right.
        let width = headings.iter().rposition(|name| !name.is_empty()).map_or(0, |last| last + 1);
        headings.truncate(width);
        let rows = records.filter(|cells| cells.iter().any(|cell| !cell.is_empty())).map(|cells| {
            CsvRow { number: numbers.at(heading.offset as u64 + byte(&cells)), cells }
        });
        let rows = rows.collect();
        let separator = heading.separator;
        Self { separator, heading_row, headings, rows, heading_rows: None, remark }
    }

    /// A table with a column for each sample and a row for each wavelength. Its first row must hold the
    /// names of the samples, and other rows must say what they are: films, backings, amounts.
    ///
    /// Without such rows each column is a spectrum, as instruments write them.
    pub(super) fn turned(text: &str) -> Option<Self> {
        let first = HeadingRow::first(text);
        let line = text[first.offset..].lines().next().unwrap_or_default();
        let mut cells =
            line.split(char::from(first.separator)).map(|cell| cell.trim_matches(['"', ' ']));
        let over_labels = cells.next()?;
        if name_rank(over_labels).is_none() && !is_wavelength(over_labels) {
            return None;
        }
        if cells.any(is_wavelength_heading) {
            return None;
        }
        let Self { separator, heading_row, headings: names, rows, .. } = Self::below(text, first);
        let wavelengths = rows.iter().filter(|row| is_wavelength_heading(&label(row))).count();
        let others = rows.iter().filter(|row| !is_number(&label(row)));
        if names.len() < 2
            || wavelengths < 2
            || others.clone().count() == 0
            || !others.clone().all(says_what_it_is)
            || !rows.iter().all(|row: &CsvRow| {
                let surplus = row.cells.iter().skip(names.len());
                !label(row).is_empty() && surplus.into_iter().all(str::is_empty)
            })
        {
            return None;
        }
        let headings = std::iter::once("sample".to_owned()).chain(rows.iter().map(label)).collect();
        let heading_rows = std::iter::once(heading_row).chain(rows.iter().map(|row| row.number));
        Some(Self {
            separator,
            heading_row,
            headings,
            heading_rows: Some(heading_rows.collect()),
            remark: None,
            rows: (1..names.len())
                .map(|column: usize| {
                    let values = rows.iter().map(|row| row.cells.get(column).unwrap_or_default());
                    let cells = std::iter::once(names[column].as_str()).chain(values).collect();
                    CsvRow { number: heading_row, cells }
                })
                .collect(),
        })
    }
}

/// Whether a heading is a wavelength of any size.
fn is_number(heading: &str) -> bool {
    wavelength_of_header(&heading.to_ascii_lowercase()).is_some()
}

/// Whether a row of a table with a column for each sample holds films, backings and the like, or amounts.
/// Programs also write rows of text about the measurement.
fn says_what_it_is(row: &CsvRow) -> bool {
    let is_amount = |cell: &str| {
        cell.is_empty() || quantity(cell, true).or_else(|| quantity(cell, false)).is_some()
    };
    is_known(&label(row)) || row.cells.iter().skip(1).all(is_amount)
}

fn label(row: &CsvRow) -> String {
    plain_heading(row.cells.get(0).unwrap_or_default())
}

fn byte(cells: &csv::StringRecord) -> u64 {
    cells.position().map_or(0, csv::Position::byte)
}

/// We judge a column by its amounts if there are at least this many rows of paint (chosen by eye).
const LEAST_ROWS: usize = 3;
/// We take sums of amounts for equal if they differ by at most this fraction.
const WHOLE: f64 = 1e-3;

/// Indices of the columns that we took for pigments but that hold no amounts. Such a column has text in
/// every cell, or amounts for bare cards. Or it has a value in every row, and without it the amounts of
/// each row sum to one whole (1 or 100).
pub(super) fn without_amounts(
    columns: &[Column],
    rows: &[CsvRow],
    number: impl Fn(&str) -> Option<f64>,
) -> Vec<usize> {
    let film = columns.iter().position(|column| *column == Column::Film);
    let (bare, paint): (Vec<&CsvRow>, Vec<&CsvRow>) = rows.iter().partition(|row| {
        film.is_some_and(|place| Film::named(&cell(row, place)) == Some(Film::None))
    });
    let pigments = columns.iter().enumerate();
    let pigments: Vec<usize> = pigments
        .filter(|(_, column)| matches!(column, Column::Pigment(_)))
        .map(|(place, _)| place)
        .collect();
    let amount = |row: &CsvRow, place: usize| number(&cell(row, place));
    let in_all = |rows: &[&CsvRow], place: usize| {
        !rows.is_empty() && rows.iter().all(|row| amount(row, place).is_some_and(|a| a != 0.0))
    };
    let found = pigments.iter().copied().filter(|&place| {
        let cells = rows.iter().map(|row| cell(row, place));
        let mut cells = cells.filter(|cell| !cell.is_empty()).peekable();
        let is_text = cells.peek().is_some() && cells.all(|cell| number(&cell).is_none());
        is_text || in_all(&bare, place)
    });
    let mut found: Vec<usize> = found.collect();
    let (everywhere, others): (Vec<usize>, Vec<usize>) = pigments
        .into_iter()
        .filter(|place| !found.contains(place))
        .partition(|&place| in_all(&paint, place));
    let others_are_whole = [1.0, 100.0].into_iter().any(|whole: f64| {
        paint.iter().all(|row| {
            let total: f64 = others.iter().filter_map(|&place| amount(row, place)).sum();
            (total / whole - 1.0).abs() < WHOLE
        })
    });
    if paint.len() >= LEAST_ROWS && others_are_whole {
        found.extend(everywhere);
    }
    found.sort_unstable();
    found
}

fn cell(row: &CsvRow, place: usize) -> String {
    row.cells.get(place).unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::super::scale::ScaleChoice;
    use super::super::table::MeasurementTable;
    use super::*;

    #[test]
    fn a_table_with_a_column_for_each_sample_is_turned() {
        for first in ["sample", "wavelength", "Wavelength (nm)"] {
            let text = format!(
                "{first}\tA\tB\n\nfilm\tpaint\tnone\nWhite\t1\t\n400\t0,1\t0,9\n410\t0,2\t0,8\n"
            );
            let found = RawRows::of(&text, TableKind::Readings);
            assert_eq!(found.headings, ["sample", "film", "White", "400", "410"]);
            assert_eq!(found.heading_rows, Some(vec![1, 3, 4, 5, 6]));
            let rows: Vec<Vec<&str>> =
                found.rows.iter().map(|row| row.cells.iter().collect()).collect();
            assert_eq!(rows, [["A", "paint", "1", "0,1", "0,2"], ["B", "none", "", "0,9", "0,8"]]);
        }
    }

    #[test]
    fn other_tables_are_not_turned() {
        for text in [
            "sample,400,410\n400,0.1,0.2\n410,0.1,0.2\nx,1,1\n",
            "wavelength,A,B\n400,0.1,0.2\n410,0.1,0.2\n",
            "A,B\nfilm,paint\n400,0.1\n410,0.2\n",
            "sample,White,400\nw,1,0.9\nr,0,0.1\n",
            "sample,A\nfilm,paint,x\n400,0.1\n410,0.2\n",
        ] {
            assert!(RawRows::turned(text).is_none(), "{text}");
        }
    }

    /// Pigments and remarks of a table with a last column headed `heading` with `cells`.
    fn read(heading: &str, cells: [&str; 4]) -> (Vec<String>, String) {
        let [card, white, red, mixture] = cells;
        let text = format!(
            "sample,film,White,Red,{heading},400,500\ncard,none,,,{card},0.9,0.9\n\
             w,paint,1,,{white},0.8,0.8\nr,paint,,1,{red},0.1,0.2\nm,paint,0.5,0.5,{mixture},0.3,0.4\n"
        );
        let table = MeasurementTable::from_csv("t.csv", text.as_bytes(), ScaleChoice::ByFile);
        let table = table.unwrap();
        (table.pigments, table.remarks.join("\n"))
    }

    #[test]
    fn a_column_that_holds_no_amounts_is_told_and_ignored() {
        for (heading, cells) in [
            ("L,a,b", ["90,0,1", "88,-1,2", "40,50,20", "60,20,-10"]),
            ("X,Y", ["80,82", "70,72", "30,20", "50,40"]),
            ("No", ["1", "2", "3", "4"]),
            ("Date", ["1.1.26", "1.1.26", "2.1.26", "2.1.26"]),
            ("Shelf", ["top", "", "top", "left"]),
            ("Lux", ["500", "510", "505", "498"]),
            ("Gloss85", ["", "4", "3", "5"]),
        ] {
            let (pigments, remarks) = read(heading, cells);
            assert_eq!(pigments, ["White", "Red"], "{heading}");
            let listed = heading.replace(',', ", ");
            assert!(
                remarks.contains(&listed) && remarks.contains("ignored"),
                "{heading}: {remarks}"
            );
        }
    }

    #[test]
    fn amounts_remain_pigments() {
        for (heading, cells) in [
            ("a", ["", "1", "", "1"]),
            ("Y", ["", "0", "0.5", ""]),
            ("Linseed oil", ["", "0.4", "0.5", "0.6"]),
        ] {
            let without_whole = read(heading, cells).0;
            let expected: &[&str] = match heading {
                // A medium beside shares that sum to 1 takes no part in them.
                "Linseed oil" => &["White", "Red"],
                heading => &["White", "Red", heading],
            };
            assert_eq!(without_whole, expected, "{heading}");
        }
    }

    #[test]
    fn pigments_that_are_named_are_read_and_no_others() {
        let text = b"sample,L,a,b,Note,400,500\nw,1,,3,,0.8,0.8\nr,,1,-2,x,0.1,0.2\n";
        let names = ["L".to_owned(), "a".to_owned()];
        let choice = ScaleChoice::ByFile;
        let table = MeasurementTable::from_csv_with("t.csv", text, choice, Some(&names)).unwrap();
        assert_eq!(table.pigments, names);
        assert!(table.remarks[0].contains("b, Note"), "{:?}", table.remarks);
    }
}
