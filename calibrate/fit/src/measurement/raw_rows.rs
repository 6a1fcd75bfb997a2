//! Cells of a table of text: its headings and its rows, also of a table with a column for each sample.

use spectra::csv_table::RowNumbers;

use super::column::{TableKind, is_wavelength_heading};
use super::csv_row::CsvRow;
use super::heading_row::{HeadingRow, plain_heading};
use super::name_column::name_rank;

/// Headings and rows of a table, of whose meaning nothing is known yet.
pub(super) struct RawRows {
    /// The character between cells.
    pub(super) separator: u8,
    /// Row of the headings in the file, from 1.
    pub(super) heading_row: u64,
    pub(super) headings: Vec<String>,
    pub(super) rows: Vec<CsvRow>,
    /// In a table with a column for each sample: the row of the file in which each heading stands.
    pub(super) heading_rows: Option<Vec<u64>>,
}

impl RawRows {
    /// The table in `text`. Without a row that looks like headings, the first is taken for it.
    pub(super) fn of(text: &str, kind: TableKind) -> Self {
        if let Some(turned) = Self::turned(text).filter(|_| kind == TableKind::Readings) {
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
        let mut headings: Vec<String> = headings.iter().map(plain_heading).collect();
        // Spreadsheets often leave empty columns at the right.
        let width = headings.iter().rposition(|name| !name.is_empty()).map_or(0, |last| last + 1);
        headings.truncate(width);
        let byte = |cells: &csv::StringRecord| cells.position().map_or(0, csv::Position::byte);
        let rows = records.filter(|cells| cells.iter().any(|cell| !cell.is_empty())).map(|cells| {
            CsvRow { number: numbers.at(heading.offset as u64 + byte(&cells)), cells }
        });
        let rows = rows.collect();
        let separator = heading.separator;
        Self { separator, heading_row, headings, rows, heading_rows: None }
    }

    /// A table with a column for each sample and a row for each wavelength, if its first row holds the names
    /// of the samples and other rows tell what they are: films, backings, amounts.
    ///
    /// Without such rows it is a spectrum a column, as instruments write them.
    pub(super) fn turned(text: &str) -> Option<Self> {
        let first = HeadingRow::first(text);
        let line = text[first.offset..].lines().next().unwrap_or_default();
        let mut cells =
            line.split(char::from(first.separator)).map(|cell| cell.trim_matches(['"', ' ']));
        name_rank(cells.next()?)?;
        if cells.any(is_wavelength_heading) {
            return None;
        }
        let Self { separator, heading_row, headings: names, rows, .. } = Self::below(text, first);
        let label = |row: &CsvRow| plain_heading(row.cells.get(0).unwrap_or_default());
        let wavelengths = rows.iter().filter(|row| is_wavelength_heading(&label(row))).count();
        if names.len() < 2
            || wavelengths < 2
            || wavelengths == rows.len()
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

#[cfg(test)]
mod tests {
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
}
