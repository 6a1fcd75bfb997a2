//! Values without wavelengths, for which you state the wavelengths: one spectrum a row behind its name, one a
//! column below its title (as in the spectral library of the USGS), or one list of all values.

use crate::instrument::decode::{Decimal, lines, number};
use crate::instrument::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, stem};
use crate::instrument::points::{Duplicates, Point, ordered};
use crate::instrument::quantity::{MeasuredQuantity, states_percent};

/// A value as large as this stands for a channel without one: the USGS writes -1.23e34.
const MISSING: f64 = 1e30;

/// A line in cells, each with its number, if it is one.
struct Line<'a> {
    number: usize,
    cells: Vec<(&'a str, Option<f64>)>,
}

impl<'a> Line<'a> {
    fn of(number_of_line: usize, line: &'a str, separator: Option<char>, decimal: Decimal) -> Self {
        let cells: Vec<&str> = match separator {
            Some(separator) => {
                line.split(separator).map(|cell| cell.trim().trim_matches('"')).collect()
            }
            None => line.split_whitespace().map(|cell| cell.trim_matches('"')).collect(),
        };
        let end = cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
        let cells = cells[..end].iter().map(|cell| (*cell, number(cell, decimal))).collect();
        Self { number: number_of_line, cells }
    }

    /// Number of numbers at the end of the line.
    fn numbers(&self) -> usize {
        self.cells.iter().rev().take_while(|(_, number)| number.is_some()).count()
    }

    /// Whether the line is a spectrum of `count` values, alone or behind its name.
    fn is_spectrum(&self, count: usize) -> bool {
        self.numbers() == count || (self.numbers() == count + 1 && self.cells.len() == count + 1)
    }

    /// The text before the last `count` cells.
    fn name(&self, count: usize) -> String {
        let before = self.cells.iter().take(self.cells.len() - count);
        before.map(|(cell, _)| *cell).collect::<Vec<_>>().join(" ").trim().to_owned()
    }

    /// The last `count` values.
    fn values(&self, count: usize) -> impl Iterator<Item = (usize, f64)> {
        let values = self.cells.iter().skip(self.cells.len() - count);
        values.filter_map(|(_, number)| *number).map(|value| (self.number, value))
    }

    fn text(&self) -> String {
        self.cells.iter().map(|(cell, _)| *cell).collect::<Vec<_>>().join(" ").trim().to_owned()
    }
}

/// Reads the spectra in `text`, each with one value for each of `nm`, which rise or fall throughout.
pub(in super::super) fn read(
    file: &str,
    text: &str,
    nm: &[f64],
) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let content = || {
        let trimmed =
            lines(text).map(|(number, line)| (number, line.trim_matches(['\0', '\u{feff}'])));
        trimmed.filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'))
    };
    let count = nm.len();
    let mut best: ((usize, usize), Vec<Line<'_>>) = ((0, 0), Vec::new());
    for separator in [Some('\t'), Some(';'), Some(','), None] {
        for decimal in [Decimal::Point, Decimal::Comma] {
            if separator == Some(',') && decimal == Decimal::Comma {
                continue;
            }
            let lines: Vec<Line<'_>> = content()
                .map(|(number, line)| Line::of(number, line, separator, decimal))
                .collect();
            let spectra = lines.iter().filter(|line| line.is_spectrum(count)).count();
            // Without rows that fit, the layout with most numbers does.
            let numbers: usize = lines.iter().map(Line::numbers).sum();
            let fit = (spectra, numbers);
            if fit > best.0 {
                best = (fit, lines);
            }
        }
    }
    let lines = best.1;
    if let Some(line) = own_wavelengths(&lines) {
        let kind = "a file that states its own wavelengths";
        let way = "leave out [wavelengths], or take out the line or column of wavelengths";
        let file = format!("{file}, line {line}");
        return Err(InstrumentError::NotRead { file, kind, way });
    }
    let found = if count > 1 && lines.iter().any(|line| line.is_spectrum(count)) {
        rows(file, &lines, count)?
    } else {
        columns(file, &lines, count)?
    };
    found.into_iter().map(|named| spectrum(file, nm, named)).collect()
}

/// Wavelengths in nm lie in this range, and so many rise or fall in a row or a column of them.
const WAVELENGTHS: std::ops::RangeInclusive<f64> = 200.0..=2500.0;
const LEAST_WAVELENGTHS: usize = 4;

/// The line in which wavelengths of the file's own begin: a row of them, or a first column beside others.
fn own_wavelengths(lines: &[Line<'_>]) -> Option<usize> {
    let are_wavelengths = |values: &[f64]| {
        values.len() >= LEAST_WAVELENGTHS
            && values.iter().all(|value| WAVELENGTHS.contains(value))
            && (values.is_sorted_by(|a, b| a < b) || values.is_sorted_by(|a, b| a > b))
    };
    let row = lines.iter().find(|line| {
        let values: Vec<f64> = line.values(line.numbers()).map(|(_, value)| value).collect();
        are_wavelengths(&values)
    });
    let rows: Vec<&Line<'_>> = lines
        .iter()
        .filter(|line| line.numbers() > 1 && line.numbers() == line.cells.len())
        .collect();
    let firsts: Vec<f64> = rows.iter().filter_map(|line| line.cells[0].1).collect();
    let column = rows.first().filter(|_| are_wavelengths(&firsts)).copied();
    row.or(column).map(|line| line.number)
}

/// A spectrum with its name, its heading, and values with their lines.
struct Named {
    name: String,
    heading: String,
    values: Vec<(usize, f64)>,
}

/// One spectrum a row.
fn rows(file: &str, lines: &[Line<'_>], count: usize) -> Result<Vec<Named>, InstrumentError> {
    let mut found: Vec<Named> = Vec::new();
    for line in lines {
        if line.is_spectrum(count) {
            let values = line.values(count).collect();
            found.push(Named { name: line.name(count), heading: String::new(), values });
        } else if !found.is_empty() || line.numbers() > 2 {
            return Err(wrong_count(file, line.number, count, line.numbers()));
        }
    }
    let alone = found.len() == 1;
    for (named, number) in found.iter_mut().zip(1..) {
        if named.name.is_empty() {
            named.name = if alone { stem(file) } else { format!("{} {number}", stem(file)) };
        }
    }
    Ok(found)
}

/// One spectrum a column, or all values of one or more spectra in one list.
fn columns(file: &str, lines: &[Line<'_>], count: usize) -> Result<Vec<Named>, InstrumentError> {
    let is_row = |line: &&Line<'_>| line.numbers() == line.cells.len();
    let first = lines.iter().position(|line| is_row(&line)).unwrap_or(lines.len());
    // Names stand before the values of each line.
    if let Some(line) = lines.iter().find(|line| first == lines.len() && line.numbers() > 1) {
        return Err(wrong_count(file, line.number, count, line.numbers()));
    }
    let (above, rows) = lines.split_at(first);
    if let Some(line) = rows.iter().find(|line| !is_row(line)) {
        return Err(InstrumentError::line(file, line.number, "a value", &line.text()));
    }
    let width = rows.first().map_or(0, |line| line.cells.len());
    let is_table = rows.iter().all(|line| line.cells.len() == width);
    let title = above.last().map(Line::text).unwrap_or_default();
    if is_table && rows.len() == count {
        let headings = above.iter().rev().find(|line| line.cells.len() == width && width > 1);
        let named = (0..width).map(|column| {
            let heading = headings.map_or("", |line| line.cells[column].0);
            let name = match (width, heading) {
                (1, _) if title.is_empty() => stem(file),
                (1, _) => title.clone(),
                (_, "") => format!("{} {}", stem(file), column + 1),
                _ => heading.to_owned(),
            };
            let heading = if width == 1 { title.clone() } else { heading.to_owned() };
            let values = rows.iter().filter_map(|line| line.values(width).nth(column)).collect();
            Named { name, heading, values }
        });
        return Ok(named.collect());
    }
    let list: Vec<(usize, f64)> =
        rows.iter().flat_map(|line| line.values(line.cells.len())).collect();
    if list.is_empty() || !list.len().is_multiple_of(count) {
        let last = lines.last().map_or(1, |line| line.number);
        return Err(wrong_count(file, last, count, list.len()));
    }
    let alone = list.len() == count;
    let parts = list.chunks(count).zip(1..).map(|(values, number)| Named {
        name: match (alone, title.is_empty()) {
            (true, true) => stem(file),
            (true, false) => title.clone(),
            (false, _) => format!("{} {number}", stem(file)),
        },
        heading: title.clone(),
        values: values.to_vec(),
    });
    Ok(parts.collect())
}

fn wrong_count(file: &str, line: usize, wanted: usize, found: usize) -> InstrumentError {
    InstrumentError::ValuesForWavelengths { file: file.to_owned(), line, wanted, found }
}

fn spectrum(file: &str, nm: &[f64], named: Named) -> Result<MeasuredSpectrum, InstrumentError> {
    let line = named.values.first().map_or(1, |(line, _)| *line);
    let all = nm.iter().zip(&named.values);
    let points: Vec<Point> = all
        .filter(|(_, (_, value))| value.abs() < MISSING)
        .map(|(&nm, &(line, value))| Point { line, nm, value })
        .collect();
    let missing = nm.len() - points.len();
    if points.is_empty() {
        return Err(InstrumentError::line(file, line, "a value", "none"));
    }
    let ordered = ordered(file, points, Duplicates::Refuse)?;
    let mut remarks = ordered.remarks;
    if missing > 0 {
        remarks.push(format!(
            "{} without a value left out",
            documents::counted(missing, "wavelength")
        ));
    }
    let is_percent = states_percent(&named.heading);
    Ok(MeasuredSpectrum {
        name: named.name,
        quantity: MeasuredQuantity::of_words(&named.heading),
        role: Role::Main,
        unit: if is_percent { Unit::Percent } else { Unit::Unstated },
        wavelengths_nm: ordered.wavelengths_nm,
        values: ordered.values,
        line,
        point_lines: ordered.lines,
        details: Vec::new(),
        remarks,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const NM: [f64; 3] = [400.0, 500.0, 600.0];

    fn found(text: &str) -> Vec<(String, Vec<f64>)> {
        let found =
            read("a/paints.txt", text, &NM).unwrap_or_else(|error| panic!("{text}: {error}"));
        found.into_iter().map(|spectrum| (spectrum.name, spectrum.values)).collect()
    }

    #[test]
    fn values_in_rows_in_columns_and_in_one_list_are_read() {
        let red = ("Red Ochre".to_owned(), vec![0.1, 0.2, 0.6]);
        let blue = ("Blue".to_owned(), vec![0.5, 0.4, 0.1]);
        for text in [
            "\"Red Ochre\"\t0.1\t0.2\t0.6\n\"Blue\"\t0.5\t0.4\t0.1\n",
            "name;R1;R2;R3\nRed Ochre;0,1;0,2;0,6\nBlue;0,5;0,4;0,1\n",
            "Red Ochre,0.1,0.2,0.6\nBlue,0.5,0.4,0.1\n",
            "Red Ochre\tBlue\n0.1\t0.5\n0.2\t0.4\n0.6\t0.1\n",
        ] {
            assert_eq!(found(text), [red.clone(), blue.clone()], "{text}");
        }
        // A title over one column, as the USGS writes it.
        assert_eq!(found(" Red Ochre\n 0.1\n 0.2\n 0.6\n"), std::slice::from_ref(&red));
        assert_eq!(found("0.1 0.2\n0.6\n"), [("paints".to_owned(), red.1.clone())]);
        let numbered = [("1".to_owned(), red.1.clone()), ("2".to_owned(), blue.1.clone())];
        assert_eq!(found("1 0.1 0.2 0.6\n2 0.5 0.4 0.1\n"), numbered);
        assert_eq!(found("0.1 0.2\n0.6 0.5\n0.4 0.1\n").len(), 2);
    }

    #[test]
    fn falling_wavelengths_and_missing_values_are_put_right() {
        let falling = read("f", "x 0.6 0.2 0.1\n", &[600.0, 500.0, 400.0]).unwrap();
        assert_eq!(
            (&falling[0].wavelengths_nm[..], &falling[0].values[..]),
            (&NM[..], &[0.1, 0.2, 0.6][..])
        );
        let holes = read("f", "title\n-1.23e34\n0.2\n0.6\n", &NM).unwrap();
        assert_eq!(holes[0].wavelengths_nm, [500.0, 600.0]);
        assert_eq!(holes[0].remarks, ["1 wavelength without a value left out"]);
    }

    #[test]
    fn wavelengths_of_the_file_itself_are_no_values() {
        for (text, line) in [
            ("x,0.1,0.2,0.3,0.3\nname,400,500,600,700\n", 2),
            ("nm R\n400 0.1\n500 0.2\n600 0.6\n700 0.6\n", 2),
        ] {
            let nm = [400.0, 500.0, 600.0, 700.0];
            let error = read("f", text, &nm).unwrap_err().to_string();
            assert!(error.starts_with(&format!("f, line {line}: ")), "{error}");
        }
    }

    #[test]
    fn another_number_of_values_is_refused_with_its_line() {
        for (text, line, count) in [
            ("Red\t0.1\t0.2\t0.6\nBlue\t0.5\t0.4\n", 2, 2),
            ("Red\t0.1\t0.2\nBlue\t0.5\t0.4\n", 1, 2),
            ("title\n0.1\n0.2\n", 3, 2),
            ("", 1, 0),
        ] {
            let error = read("f", text, &NM).unwrap_err();
            let wanted = wrong_count("f", line, 3, count);
            assert_eq!(error, wanted, "{text}");
        }
    }
}
