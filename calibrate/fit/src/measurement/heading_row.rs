//! The row of headings of a table, and the rows below it.
//!
//! Instruments' programs write a title or lines about the measurement above the headings, and spreadsheets
//! write a line `sep=;`.

use std::ops::RangeInclusive;

use spectra::headings::name_rank;

use super::column::{TableKind, is_wavelength_heading, name_column};

/// The first of the columns `places` in which every row has a name, or the first one if none has.
pub(super) fn filled_column(places: &[usize], rows: &[CsvRow]) -> Option<usize> {
    places
        .iter()
        .find(|place: &&usize| {
            rows.iter().all(|row| row.cells.get(**place).is_some_and(|name| !name.is_empty()))
        })
        .or(places.first())
        .copied()
}

/// We look for the headings in this many lines at most (chosen by eye).
const MOST_ABOVE: usize = 200;

/// Separators of cells, in the order in which they are tried.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct HeadingRow {
    /// The character between cells, an ASCII character.
    pub(super) separator: u8,
    /// Number of bytes of the text before the row.
    pub(super) offset: usize,
}

impl HeadingRow {
    /// Finds the headings of a table in `text`. If a cell of the first line is `sample`, it is this line.
    /// Otherwise we take the row with the most wavelengths (of a file of recipes, the most cells) among
    /// those with a column for names.
    pub(super) fn of(text: &str, kind: TableKind) -> Option<Self> {
        let mut best: Option<(usize, Self)> = None;
        let mut offset = 0;
        let mut is_first = true;
        for line in text.split_inclusive(['\n', '\r']).take(2 * MOST_ABOVE) {
            let at = offset;
            offset += line.len();
            if line.trim().is_empty() {
                continue;
            }
            for separator in SEPARATORS {
                let cells = cells(line, separator);
                let found = Self { separator, offset: at };
                if is_first && cells.iter().any(|cell| cell.eq_ignore_ascii_case("sample")) {
                    return Some(found);
                }
                if let Some(score) = score(&cells, kind)
                    && best.is_none_or(|(most, _)| score > most)
                {
                    best = Some((score, found));
                }
            }
            is_first = false;
        }
        best.map(|(_, found)| found)
    }

    /// Whether a cell of the row is a wavelength.
    pub(super) fn has_wavelengths(self, text: &str) -> bool {
        let line = text[self.offset..].lines().next().unwrap_or_default();
        cells(line, self.separator).iter().any(|cell| is_wavelength_heading(cell))
    }

    /// The first row that is not empty, with the separator that occurs most often in it.
    pub(super) fn first(text: &str) -> Self {
        let offset = text.len() - text.trim_start_matches(['\n', '\r', ' ']).len();
        let line = text[offset..].lines().next().unwrap_or_default();
        // We search the maximum from behind, to get the first of several.
        let separators = SEPARATORS.into_iter().rev();
        let separator = separators
            .max_by_key(|separator| line.bytes().filter(|byte| byte == separator).count())
            .unwrap_or(b',');
        Self { separator, offset }
    }
}

/// Score of a row: the number of its wavelengths, or of its cells in a file of recipes. The row of
/// headings has the highest. `None` if it has no column for names, or only this column.
fn score(cells: &[String], kind: TableKind) -> Option<usize> {
    let names: Vec<&str> = cells.iter().map(String::as_str).collect();
    let wavelengths = names.iter().filter(|cell| is_wavelength_heading(cell)).count();
    match kind {
        TableKind::Readings | TableKind::Spectra => {
            name_column(&names, is_wavelength_heading)?;
            (wavelengths > 1).then_some(wavelengths)
        }
        TableKind::Recipes => {
            names.iter().find_map(|name| name_rank(name))?;
            (names.len() > 1).then_some(names.len())
        }
    }
}

/// The cells of a line, without empty ones at its end.
fn cells(line: &str, separator: u8) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .delimiter(separator)
        .from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok).unwrap_or_default();
    let cells: Vec<String> = record.iter().map(plain_heading).collect();
    let mut cells = in_nanometres(cells).0;
    while cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
    cells
}

/// A heading as it was before [`documents::spreadsheet_cell`], and with a decimal point for a decimal comma:
/// `400,5` becomes `400.5`.
pub(super) fn plain_heading(heading: &str) -> String {
    let heading = documents::from_spreadsheet_cell(heading);
    let pointed = heading.replace(',', ".");
    if pointed.parse::<f64>().is_ok() { pointed } else { heading.to_owned() }
}

/// Wavelengths in micrometres lie in this range.
const MICROMETRES: RangeInclusive<f64> = 0.2..=20.0;
/// So many headings without a unit must rise or fall before we take them for micrometres.
const LEAST_MICROMETRES: usize = 8;

/// The headings with wavelengths in nm instead of micrometres: `0.4 um` becomes `400`. Without a unit, at
/// least eight numbers must rise or fall from less than 2.5. You then get a remark too.
pub(super) fn in_nanometres(mut headings: Vec<String>) -> (Vec<String>, Option<String>) {
    const UNITS: [&str; 7] =
        ["um", "\u{b5}m", "\u{3bc}m", "micrometers", "micrometres", "microns", "micron"];
    let number = |heading: &str| -> Option<(f64, bool)> {
        let bare = heading.trim().trim_end_matches([')', ']']);
        let unit = UNITS.iter().find_map(|unit| bare.strip_suffix(unit));
        let text = unit.unwrap_or(heading).trim_end_matches(['(', '[', ' ', '_']).trim();
        let micrometres: f64 = text.parse().ok()?;
        MICROMETRES.contains(&micrometres).then_some((micrometres, unit.is_some()))
    };
    let found = headings.iter().enumerate();
    let found: Vec<(usize, (f64, bool))> =
        found.filter_map(|(at, heading)| Some((at, number(heading)?))).collect();
    let have_units = found.len() > 1 && found.iter().all(|(_, (_, has_unit))| *has_unit);
    let values: Vec<f64> = found.iter().map(|(_, (value, _))| *value).collect();
    let look_alike = values.len() >= LEAST_MICROMETRES
        && values.iter().any(|value| *value < 2.5)
        && values.iter().any(|value| value.fract() != 0.0)
        && (values.is_sorted_by(|a, b| a < b) || values.is_sorted_by(|a, b| a > b))
        && !headings.iter().any(|heading| is_wavelength_heading(heading));
    if !have_units && !look_alike {
        return (headings, None);
    }
    for (at, (micrometres, _)) in &found {
        // Without the noise of the product: 0.57 um are 570 nm.
        headings[*at] = format!("{}", (micrometres * 1e9).round() / 1e6);
    }
    let (first, last) = (values[0], values[values.len() - 1]);
    let remark = format!("wavelengths have no unit: {first} to {last} are taken for micrometres");
    (headings, (!have_units).then_some(remark))
}

/// Cells of a row below the header, and the number of the row in the file, from 1.
pub(super) struct CsvRow {
    pub(super) number: u64,
    pub(super) cells: csv::StringRecord,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heading_row(text: &str, kind: TableKind) -> Option<(char, usize)> {
        HeadingRow::of(text, kind).map(|row| (char::from(row.separator), row.offset))
    }

    #[test]
    fn lines_above_the_headings_are_passed_over() {
        assert_eq!(readings("sample,400\n"), Some((',', 0)));
        assert_eq!(readings("My paints\n\nName;400;410\n"), Some((';', 11)));
        assert_eq!(readings("sep=;\r\nName,Anna\r\nName;400,5;410,5\r\n"), Some((';', 18)));
        assert_eq!(readings("Date\t1.1.26\nwavelength\t400\t410\nA\t1\t2\n"), Some(('\t', 12)));
        assert_eq!(readings("Name,Anna\nwavelength,Red,Blue\n400,1,2\n"), None);
        assert_eq!(readings("400,1\n410,2\n"), None);
        assert_eq!(readings("Name,500\nwavelength,Red\n400,1\n"), None, "a name that is a number");
    }

    fn readings(text: &str) -> Option<(char, usize)> {
        heading_row(text, TableKind::Readings)
    }

    #[test]
    fn headings_in_micrometres_become_nanometres() {
        let of = |text: &str| in_nanometres(text.split(',').map(str::to_owned).collect());
        let (found, remark) = of("sample,0.4 um,0.57 um");
        assert_eq!((found.join(",").as_str(), remark), ("sample,400,570", None));
        let (found, remark) = of("a,0.4,0.45,0.5,0.55,0.6,0.65,0.7,0.75");
        assert_eq!(found.join(","), "a,400,450,500,550,600,650,700,750");
        assert!(remark.unwrap().contains("0.4 to 0.75 are taken for micrometres"));
        for other in ["a,1,2,3,4,5,6,7,8,9", "a,0.4,0.45", "a,0.4,0.3,0.5,0.6,0.7,0.8,0.9,1.5,400"]
        {
            assert_eq!(of(other).0.join(","), other);
        }
    }

    #[test]
    fn recipes_have_the_row_with_the_most_cells() {
        assert_eq!(
            heading_row("Name,Anna\nName,White,Red\nw,1,\n", TableKind::Recipes),
            Some((',', 10))
        );
        assert_eq!(heading_row("White,Red\n1,2\n", TableKind::Recipes), None);
    }
}
