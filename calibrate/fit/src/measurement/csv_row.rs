//! A row of a CSV file.

/// Cells of a row below the header, and the number of the row in the file, from 1.
pub(super) struct CsvRow {
    pub(super) number: u64,
    pub(super) cells: csv::StringRecord,
}
