//! Tables of spectra in CSV files: the place of a cell, errors of any table, and the wavelength
//! in a column's heading.

/// A cell of a CSV file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellPlace {
    /// Path of the file, as the user gave it.
    pub file: String,
    /// Row number from 1; the header is row 1.
    pub row: u64,
    /// Heading of the column.
    pub column: String,
}

impl CellPlace {
    /// The cell of `file` in row `row` (from 1), under the heading `column`.
    #[must_use]
    pub fn new(file: &str, row: u64, column: &str) -> Self {
        Self { file: file.to_owned(), row, column: column.to_owned() }
    }
}

impl std::fmt::Display for CellPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, row {}, column `{}`", self.file, self.row, self.column)
    }
}

/// A CSV table that cannot be read. Every variant names the file and the row.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CsvTableError {
    /// A required column is missing.
    #[error("{file}, row 1: no column `{column}`")]
    MissingColumn {
        /// Path of the file.
        file: String,
        /// Heading of the missing column.
        column: &'static str,
    },
    /// The number of cells in a row differs from that of the header.
    #[error("{file}, row {row}: expected {wanted} cells, found `{found}`")]
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
    #[error("{place}: expected {wanted}, found `{text}`")]
    Cell {
        /// File, row and column of the cell.
        place: CellPlace,
        /// Description of the required number.
        wanted: &'static str,
        /// Content of the cell.
        text: String,
    },
}

/// The wavelength in nm in a column's heading, which must be in lower case: `400`, `400nm`,
/// `r400`, `spec_400` or `nm400`. `None` for any other heading.
#[must_use]
pub fn wavelength_of_header(lower: &str) -> Option<f64> {
    let bare =
        ["spec_", "nm", "r"].iter().find_map(|prefix| lower.strip_prefix(prefix)).unwrap_or(lower);
    let bare = bare.strip_suffix("nm").unwrap_or(bare).trim();
    if !bare.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    bare.parse().ok()
}
