//! Long tables: one reading a row, with its wavelength, its value and the name of its sample in columns of
//! any order. Programs for statistics write these.
//!
//! Other columns may hold conditions, such as a geometry, a side or a film. We take them into the name where
//! one sample has readings under several.

use std::collections::BTreeMap;

use super::columns::{Axis, Layout, split};
use super::decode::{Decimal, lines, number, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit};
use super::points::{Duplicates, Point, ordered};
use super::quantity::MeasuredQuantity;
use crate::csv_table::wavelength_of_header;
use crate::headings::{condition, is_wavelength, name_rank, plain, with_condition};

/// Whether `text` is a table with one reading a row.
#[must_use]
pub fn is_long_table(text: &str) -> bool {
    LongTable::of(text).is_some()
}

/// The headings of values in six languages, as [`plain`] gives them, besides words for a quantity.
const VALUES: [&str; 24] = [
    "value",
    "values",
    "wert",
    "werte",
    "messwert",
    "valeur",
    "valeurs",
    "valor",
    "valores",
    "valore",
    "valori",
    "waarde",
    "waarden",
    "r",
    "y",
    "intensity",
    "intensitat",
    "refl",
    "reflect",
    "reflectancia",
    "reflektanz",
    "riflettanza",
    "reflectantie",
    "spd",
];

/// Columns that say of which film a reading is.
const FILMS: [&str; 3] = ["film", "backing", "thicknessmm"];

/// We look for the headings in this many lines at most, and at this many rows below them (chosen by eye).
const MOST_ABOVE: usize = 60;
const ROWS: usize = 40;

struct LongTable<'a> {
    /// Line number of the headings.
    line: usize,
    separator: char,
    headings: Vec<&'a str>,
    wavelength: usize,
    value: usize,
    name: usize,
    /// Columns that may tell readings of one sample apart.
    conditions: Vec<usize>,
}

impl<'a> LongTable<'a> {
    fn of(text: &'a str) -> Option<Self> {
        let content = lines(text).filter(|(_, line)| !line.trim().is_empty());
        let mut content = content.take(MOST_ABOVE + ROWS);
        let mut above = 0;
        while let Some((line, heading)) = content.next() {
            let found = [',', ';', '\t'].into_iter().find_map(|separator| {
                Self::headed(line, separator, split(heading, Some(separator)))
            });
            if let Some(found) = found {
                let rows: Vec<Vec<&str>> =
                    content.map(|(_, row)| split(row, Some(found.separator))).collect();
                return found.fits(&rows).then_some(found);
            }
            above += 1;
            if above > MOST_ABOVE {
                break;
            }
        }
        None
    }

    /// The table below `headings`, if they name wavelengths, values and samples, and none is a wavelength.
    fn headed(line: usize, separator: char, headings: Vec<&'a str>) -> Option<Self> {
        let is_number = |heading: &&str| wavelength_of_header(&heading.to_lowercase()).is_some();
        if headings.len() < 3 || headings.iter().any(is_number) {
            return None;
        }
        let wavelength = headings.iter().position(|heading| is_wavelength(heading))?;
        let others = || (0..headings.len()).filter(|&at| at != wavelength);
        let name = others().filter_map(|at| Some((name_rank(headings[at])?, at))).min()?.1;
        let is_value = |at: &usize| {
            *at != name
                && (VALUES.contains(&plain(headings[*at]).as_str())
                    || !matches!(
                        MeasuredQuantity::of_words(headings[*at]),
                        MeasuredQuantity::Unstated | MeasuredQuantity::Deviation
                    ))
        };
        let value = others().find(is_value)?;
        let is_condition = |at: &usize| {
            condition(headings[*at]).is_some()
                || FILMS.contains(&plain(headings[*at]).as_str())
                || name_rank(headings[*at]).is_some()
        };
        let conditions = others().filter(|at| *at != name && *at != value);
        let conditions = conditions.filter(is_condition).collect();
        Some(Self { line, separator, headings, wavelength, value, name, conditions })
    }

    /// Whether the first rows hold wavelengths and values. If all cells are numbers, a wavelength must occur
    /// twice. Otherwise the table may have a column for each sample.
    fn fits(&self, rows: &[Vec<&str>]) -> bool {
        let parsed =
            |cell: &str| number(cell, Decimal::Point).or_else(|| number(cell, Decimal::Comma));
        let mut nm: Vec<f64> = Vec::new();
        let mut has_text = false;
        for row in rows {
            let cell = |at: usize| row.get(at).copied().unwrap_or_default();
            let own = parsed(cell(self.wavelength)).filter(|own| *own > 0.0);
            if let Some(own) = own.filter(|_| parsed(cell(self.value)).is_some()) {
                has_text |= parsed(cell(self.name)).is_none();
                nm.push(own);
            }
        }
        // A few rows may be faulty, which an error then tells.
        if 4 * nm.len() < 3 * rows.len() {
            return false;
        }
        nm.sort_by(f64::total_cmp);
        let is_repeated = nm.windows(2).any(|pair| pair[0] == pair[1]);
        // Long runs of one numbered sample fill the rows that we look at.
        let is_one_sample = rows.iter().all(|row| row.get(self.name) == rows[0].get(self.name));
        rows.len() > 1 && (has_text || is_repeated || is_one_sample)
    }
}

/// One row of readings.
struct LongRow<'a> {
    point: Point,
    conditions: Vec<&'a str>,
}

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let Some(table) = LongTable::of(text) else { return Ok(Vec::new()) };
    let separator = Some(table.separator);
    let rows = lines(text).skip(table.line).filter(|(_, line)| !line.trim().is_empty());
    let rows: Vec<(usize, &str)> = rows.collect();
    let decimal = Layout::decimal_of(rows.iter().flat_map(|(_, row)| {
        let cells = split(row, separator);
        [table.wavelength, table.value].map(|at| cells.get(at).copied().unwrap_or_default())
    }));
    let heading = table.headings[table.wavelength];
    let axis = Axis::of_words(heading).unwrap_or(Axis::Nanometres);
    let mut names: Vec<&str> = Vec::new();
    let mut samples: BTreeMap<&str, Vec<LongRow<'_>>> = BTreeMap::new();
    for (line, row) in rows {
        let cells = split(row, separator);
        let cell = |at: usize| cells.get(at).copied().unwrap_or_default();
        let name = cell(table.name);
        if name.is_empty() {
            return Err(InstrumentError::line(file, line, "the sample's name", row));
        }
        let parsed = |at: usize, expected| required_number(file, line, expected, cell(at), decimal);
        let nm = axis.nm(parsed(table.wavelength, "a wavelength")?);
        let point = Point { line, nm, value: parsed(table.value, "a value")? };
        let conditions = table.conditions.iter().map(|&at| cell(at)).collect();
        let known = samples.entry(name).or_insert_with(|| {
            names.push(name);
            Vec::new()
        });
        known.push(LongRow { point, conditions });
    }
    let value = table.headings[table.value];
    let label = Label {
        file,
        quantity: MeasuredQuantity::of_words(value),
        unit: if value.contains('%') { Unit::Percent } else { Unit::Unstated },
    };
    let mut records = Vec::new();
    for name in names {
        for (name, points) in told_apart(&table, name, &samples[name]) {
            label.add(name, points, &mut records)?;
        }
    }
    let known = [table.wavelength, table.value, table.name];
    let ignored = (0..table.headings.len())
        .filter(|at| !known.contains(at) && !table.conditions.contains(at))
        .map(|at| table.headings[at])
        .filter(|heading| !heading.is_empty());
    let ignored: Vec<&str> = ignored.collect();
    if let Some(first) = records.first_mut().filter(|_| !ignored.is_empty()) {
        first.remarks.push(format!("columns that are not read: {}", ignored.join(", ")));
    }
    Ok(records)
}

/// The points of a sample under each of its conditions, each with a name.
fn told_apart(
    table: &LongTable<'_>,
    name: &str,
    rows: &[LongRow<'_>],
) -> Vec<(String, Vec<Point>)> {
    let mut found: Vec<(String, Vec<Point>)> = Vec::new();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    let differ = (0..table.conditions.len())
        .map(|at| rows.iter().any(|row| row.conditions[at] != rows[0].conditions[at]));
    let differ: Vec<bool> = differ.collect();
    for row in rows {
        let mut own = name.to_owned();
        for ((&column, value), differs) in table.conditions.iter().zip(&row.conditions).zip(&differ)
        {
            if *differs && !value.is_empty() {
                own = with_condition(&own, table.headings[column], value);
            }
        }
        let place = *places.entry(own.clone()).or_insert(found.len());
        if place == found.len() {
            found.push((own, Vec::new()));
        }
        found[place].1.push(row.point);
    }
    found
}

struct Label<'a> {
    file: &'a str,
    quantity: MeasuredQuantity,
    unit: Unit,
}

impl Label<'_> {
    /// Adds the spectra of one name: as many as its most frequent wavelength has values.
    fn add(
        &self,
        name: String,
        mut points: Vec<Point>,
        records: &mut Vec<MeasuredSpectrum>,
    ) -> Result<(), InstrumentError> {
        points.sort_by(|a, b| a.nm.total_cmp(&b.nm));
        let mut spectra: Vec<Vec<Point>> = Vec::new();
        for group in points.chunk_by(|a, b| a.nm == b.nm) {
            for (at, point) in group.iter().enumerate() {
                match spectra.get_mut(at) {
                    Some(spectrum) => spectrum.push(*point),
                    None => spectra.push(vec![*point]),
                }
            }
        }
        for points in spectra {
            let line = points.iter().map(|point| point.line).min().unwrap_or(1);
            let ordered = ordered(self.file, points, Duplicates::Refuse)?;
            records.push(MeasuredSpectrum {
                name: name.clone(),
                quantity: self.quantity,
                role: Role::Main,
                unit: self.unit,
                wavelengths_nm: ordered.wavelengths_nm,
                values: ordered.values,
                line,
                point_lines: ordered.lines,
                details: Vec::new(),
                remarks: Vec::new(),
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<String> {
        let found = read("f", text).unwrap();
        found.into_iter().map(|record| record.name).collect()
    }

    #[test]
    fn columns_may_stand_in_any_order_and_language() {
        for text in [
            "wavelength,reflectance,sample\n400,0.1,Red\n500,0.2,Red\n400,0.3,Blue\n500,0.4,Blue\n",
            "Probe;Wellenl\u{e4}nge [nm];Reflexion\nRed;400;0,1\nBlue;400;0,3\nRed;500;0,2\nBlue;500;0,4\n",
            "Valeur\t\u{c9}chantillon\tLongueur d'onde\n0,2\tRed\t500\n0,1\tRed\t400\n0,3\tBlue\t400\n0,4\tBlue\t500\n",
            "My lab\n\nName,Date,nm,value\nRed,1.1.,400,0.1\nRed,1.1.,500,0.2\nBlue,1.1.,400,0.3\nBlue,1.1.,500,0.4\n",
        ] {
            assert!(is_long_table(text), "{text}");
            let found = read("f", text).unwrap();
            assert_eq!(names(text), ["Red", "Blue"], "{text}");
            assert_eq!(found[0].wavelengths_nm, [400.0, 500.0], "{text}");
            assert_eq!((found[0].values[1], found[1].values[0]), (0.2, 0.3), "{text}");
        }
    }

    #[test]
    fn samples_may_have_numbers_for_names() {
        let text = "id,wavelength,value\n1,400,0.1\n1,500,0.2\n2,400,0.3\n2,500,0.4\n";
        assert!(is_long_table(text));
        assert_eq!(names(text), ["1", "2"]);
    }

    #[test]
    fn conditions_and_repeated_readings_are_spectra_of_their_own() {
        let text = "name,geometry,nm,value\nRed,45as15,400,1\nRed,45as15,500,2\nRed,45as75,400,3\nRed,45as75,500,4\n";
        assert_eq!(names(text), ["Red 45as15", "Red 45as75"]);
        let again = text.replace("45as75", "45as15");
        let found = read("f", &again).unwrap();
        assert_eq!(names(&again), ["Red", "Red"]);
        assert_eq!((found[1].values[0], found[1].line_at(500.0)), (3.0, 5));
    }

    #[test]
    fn other_tables_are_not_long() {
        for text in [
            "wavelength,Red,Blue\n400,0.1,0.2\n500,0.1,0.2\n",
            "wavelength,sample,value\n400,0.1,0.2\n500,0.2,0.2\n",
            "sample,400,500\nRed,0.1,0.2\nBlue,0.1,0.2\n",
            "name,wavelength,value\n",
            "name,wavelength,value\nRed,x,0.1\nRed,y,0.2\n",
        ] {
            assert!(!is_long_table(text), "{text}");
        }
    }

    #[test]
    fn faults_name_their_line() {
        let text = "name,nm,value\nRed,400,0.1\nRed,500,0.2\n".to_owned() + &"\n".repeat(3);
        let rows: String = (0..50).map(|at| format!("Blue,{},0.1\n", 300 + at)).collect();
        for bad in ["Blue,400,x\n", ",400,0.1\n"] {
            let error = read("f", &(text.clone() + &rows + bad)).unwrap_err();
            assert!(matches!(error, InstrumentError::Line { line: 57, .. }), "{bad}: {error}");
        }
    }
}
