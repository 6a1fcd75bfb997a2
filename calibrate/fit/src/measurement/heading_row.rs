//! The row of headings of a table, and the rows below it.
//!
//! Instruments' programs write a title or lines about the measurement above the headings, and spreadsheets
//! write a line `sep=;`.

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
    let mut cells: Vec<String> = record.iter().map(plain_heading).collect();
    while cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
    cells
}

/// A heading, with a decimal point for a decimal comma: `400,5` becomes `400.5`.
pub(super) fn plain_heading(heading: &str) -> String {
    let pointed = heading.replace(',', ".");
    if pointed.parse::<f64>().is_ok() { pointed } else { heading.to_owned() }
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
    fn recipes_have_the_row_with_the_most_cells() {
        assert_eq!(
            heading_row("Name,Anna\nName,White,Red\nw,1,\n", TableKind::Recipes),
            Some((',', 10))
        );
        assert_eq!(heading_row("White,Red\n1,2\n", TableKind::Recipes), None);
    }
}
