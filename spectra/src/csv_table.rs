//! Tables of spectra in CSV files: the place of a cell, errors of any table, and the wavelength
//! in a column's heading.

use documents::{counted, excerpt};

/// A cell of a CSV file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellPlace {
    /// Path of the file, as the user gave it.
    pub file: String,
    /// Row number from 1. The header is row 1.
    pub row: u64,
    /// Heading of the column.
    pub column: String,
    /// Number of the column in the sheet of a workbook, from 0.
    pub sheet_column: Option<u32>,
}

impl CellPlace {
    /// The cell of `file` in row `row` (from 1), under the heading `column`.
    #[must_use]
    pub fn new(file: &str, row: u64, column: &str) -> Self {
        Self { file: file.to_owned(), row, column: column.to_owned(), sheet_column: None }
    }

    /// Adds the column `index` (from 0) in the sheet of a workbook.
    #[must_use]
    pub fn in_workbook(self, index: usize) -> Self {
        Self { sheet_column: u32::try_from(index).ok(), ..self }
    }
}

/// Letters of the column `index`, from 0, of a sheet: `A` to `Z`, then `AA`.
fn column_letters(index: u32) -> String {
    let mut letters = String::new();
    let mut rest = index.saturating_add(1);
    while rest > 0 {
        let letter = u8::try_from((rest - 1) % 26).unwrap_or(0);
        letters.insert(0, char::from(b'A' + letter));
        rest = (rest - 1) / 26;
    }
    letters
}

impl std::fmt::Display for CellPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { file, row, column, sheet_column } = self;
        match sheet_column.map(column_letters) {
            Some(letters) => write!(f, "{file}, cell {letters}{row}, column `{}`", excerpt(column)),
            None => write!(f, "{file}, row {row}, column `{}`", excerpt(column)),
        }
    }
}

/// Finds the row number of each record of a CSV file. This is its line number from 1.
///
/// A CSV parser states a position before the rest of a CRLF and before blank lines. So we count the
/// lines ourselves from the bytes.
#[derive(Debug)]
pub struct RowNumbers<'a> {
    bytes: &'a [u8],
    /// Number of bytes from the start in which we have counted the lines.
    counted: usize,
    row: u64,
}

impl<'a> RowNumbers<'a> {
    /// Rows of the file `bytes`. This counts nothing yet.
    #[must_use]
    pub fn of(bytes: &'a [u8]) -> Self {
        Self { bytes, counted: 0, row: 1 }
    }

    /// Row of the record that the parser found at `offset` bytes. Pass offsets in rising order.
    pub fn at(&mut self, offset: u64) -> u64 {
        let offset = usize::try_from(offset).unwrap_or(usize::MAX).min(self.bytes.len());
        let blank = self.bytes[offset..].iter().take_while(|byte| matches!(byte, b'\r' | b'\n'));
        let end = offset + blank.count();
        for index in self.counted..end {
            let ends_line = match self.bytes[index] {
                b'\n' => true,
                b'\r' => self.bytes.get(index + 1) != Some(&b'\n'),
                _ => false,
            };
            self.row += u64::from(ends_line);
        }
        self.counted = self.counted.max(end);
        self.row
    }
}

/// A CSV table that cannot be read. Every variant names the file and the row.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CsvTableError {
    /// A required column is missing.
    #[error("{file}, row {row}: no column `{column}`")]
    MissingColumn {
        /// Path of the file.
        file: String,
        /// Row of the headings, from 1.
        row: u64,
        /// Heading of the missing column.
        column: &'static str,
    },
    /// A row and the header differ in the number of cells.
    #[error("{file}, row {row}: expected {}, found `{found}`", counted(*wanted, "cell"))]
    RowLength {
        /// Path of the file.
        file: String,
        /// Row number from 1.
        row: u64,
        /// Number of cells in the header.
        wanted: usize,
        /// Number of cells in the row.
        found: usize,
    },
    /// A cell does not contain the required number.
    #[error("{place}: expected {wanted}, found `{}`", excerpt(text))]
    Cell {
        /// File, row and column of the cell.
        place: CellPlace,
        /// Description of the required number.
        wanted: &'static str,
        /// Content of the cell.
        text: String,
    },
}

/// Words that instruments and spreadsheets write next to a wavelength in a heading.
const WORDS: [&str; 18] = [
    "nm",
    "nanometer",
    "nanometers",
    "r",
    "x",
    "spec",
    "spectral",
    "refl",
    "reflectance",
    "reflect",
    "sci",
    "sce",
    "wl",
    "lambda",
    "wavelength",
    "pct",
    "dec",
    "wave",
];

/// The wavelength in nm in a column's heading. Pass the heading in lower case, e.g. `400`, `400nm`,
/// `400[nm]`, `r400`, `spec_400`, `nm400` or `sci 400 nm`. Any other heading gives `None`.
#[must_use]
pub fn wavelength_of_header(lower: &str) -> Option<f64> {
    let mut rest = lower.trim();
    let mut nm = None;
    while let Some(first) = rest.chars().next() {
        let length = if first.is_ascii_digit() {
            let length =
                rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
            if nm.replace(rest[..length].parse().ok()?).is_some() {
                return None;
            }
            length
        } else if first.is_ascii_lowercase() {
            let length = rest.find(|c: char| !c.is_ascii_lowercase()).unwrap_or(rest.len());
            if !WORDS.contains(&&rest[..length]) {
                return None;
            }
            length
        } else if " _[]()%.".contains(first) {
            1
        } else {
            return None;
        };
        rest = &rest[length..];
    }
    nm
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_lines_of_the_file_with_any_ending_and_after_blank_lines() {
        for end in ["\n", "\r\n", "\r"] {
            let text = ["a,b", "1,2", "", "", "3,\"4", "4\"", "5,6"].join(end);
            let mut numbers = RowNumbers::of(text.as_bytes());
            let mut reader = csv::ReaderBuilder::new().from_reader(text.as_bytes());
            let rows: Vec<u64> = (reader.records())
                .map(|record| numbers.at(record.unwrap().position().unwrap().byte()))
                .collect();
            assert_eq!(rows, [2, 5, 7], "{end:?}");
        }
    }

    #[test]
    fn cells_of_a_workbook_are_named_by_letters_and_row() {
        for (index, cell) in [(0, "A7"), (25, "Z7"), (26, "AA7"), (701, "ZZ7"), (702, "AAA7")] {
            let place = CellPlace::new("f", 7, "x").in_workbook(index);
            assert_eq!(place.to_string(), format!("f, cell {cell}, column `x`"));
        }
    }

    #[test]
    fn wavelengths_are_found_in_headings_of_instruments() {
        for heading in [
            "400",
            "400.0",
            "400nm",
            "400 nm",
            "400[nm]",
            "400 (nm)",
            "r400",
            "r400 nm",
            "r%400",
            "spec_400",
            "spectral_nm_400",
            "spectral_nm400",
            "nm400",
            "sci 400nm",
            "400nm (sce)",
            "wl400",
            "lambda_400",
            "x400",
        ] {
            assert_eq!(wavelength_of_header(heading), Some(400.0), "{heading}");
        }
        for heading in [
            "", "nm", "pr254", "400-410", "400 410", "-400", "d65 400", "l*", "w/m2", "4.0.0",
            "r*400",
        ] {
            assert_eq!(wavelength_of_header(heading), None, "{heading}");
        }
    }
}
