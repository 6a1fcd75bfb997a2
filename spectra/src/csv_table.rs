//! Tables of spectra as CSV files: the place of a cell, what can be wrong with
//! any table, and the wavelength in a column's header.

/// A cell of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellPlace {
    /// The file, as the user named it.
    pub file: String,
    /// The row, counted from 1; the header is row 1.
    pub row: u64,
    /// The column's header.
    pub column: String,
}

impl CellPlace {
    /// The cell of `file` at `row` (from 1) under the header `column`.
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

/// Why a sheet cannot be read. Every variant says where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CsvTableError {
    /// A column that must be there is not.
    #[error("{file}, row 1: no column `{column}`")]
    MissingColumn {
        /// The file.
        file: String,
        /// The column.
        column: &'static str,
    },
    /// A row has more or fewer cells than the header.
    #[error("{file}, row {row}: {wanted} cells are wanted, found `{found}`")]
    RowLength {
        /// The file.
        file: String,
        /// The row.
        row: u64,
        /// Cells of the header.
        wanted: usize,
        /// Cells of the row.
        found: usize,
    },
    /// A cell is not the number it should be.
    #[error("{place}: {wanted} is wanted, found `{text}`")]
    Cell {
        /// Where.
        place: CellPlace,
        /// What should stand there.
        wanted: &'static str,
        /// What stands there.
        text: String,
    },
}

/// The wavelength in nm that a column's header names, in lower case: `400`, `400nm`,
/// `r400`, `spec_400` or `nm400`. `None` for any other header.
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
