//! Where a sheet is wrong, and what can be wrong with any.

/// A cell of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file, as the user named it.
    pub file: String,
    /// The row, counted from 1; the header is row 1.
    pub row: u64,
    /// The column's header.
    pub column: String,
}

impl Place {
    pub(crate) fn new(file: &str, row: u64, column: &str) -> Self {
        Self { file: file.to_owned(), row, column: column.to_owned() }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, row {}, column `{}`", self.file, self.row, self.column)
    }
}

/// Why a sheet cannot be read. Every variant says where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SheetError {
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
        place: Place,
        /// What should stand there.
        wanted: &'static str,
        /// What stands there.
        text: String,
    },
}
