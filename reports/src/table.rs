//! Tables: the data of a figure as CSV, and tables of the page.

use calibrate::digits::rounded;

use crate::style::Color;

/// Heading and format of a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name of the column.
    pub name: String,
    /// Unit of a quantity, `1` for a ratio; `None` for text.
    pub unit: Option<String>,
    /// Number of decimals on the page.
    pub digits: usize,
}

impl Column {
    /// A column of text.
    #[must_use]
    pub fn text(name: &str) -> Self {
        Self { name: name.to_owned(), unit: None, digits: 0 }
    }

    /// A column of numbers with `digits` decimals on the page.
    #[must_use]
    pub fn quantity(name: &str, unit: &str, digits: usize) -> Self {
        Self { name: name.to_owned(), unit: Some(unit.to_owned()), digits }
    }

    /// The heading in a CSV file: `name [unit]`, or the name of a column of text.
    #[must_use]
    pub fn header(&self) -> String {
        match &self.unit {
            Some(unit) => format!("{} [{unit}]", self.name),
            None => self.name.clone(),
        }
    }
}

/// The content of a cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Plain text, escaped when written.
    Text(String),
    /// A number in its column's unit.
    Number(f64),
    /// A colour: a patch on a page, `#RRGGBB` in a file.
    Patch(Color),
    /// Empty: the value is not known or does not apply.
    Empty,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<Color> for Cell {
    fn from(color: Color) -> Self {
        Self::Patch(color)
    }
}

impl From<Option<f64>> for Cell {
    fn from(number: Option<f64>) -> Self {
        number.map_or(Self::Empty, Self::Number)
    }
}

/// Rows of cells under named columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Headings of the columns.
    pub columns: Vec<Column>,
    /// The rows, each with a cell for every column.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows.
    #[must_use]
    pub fn new(columns: impl Into<Vec<Column>>) -> Self {
        Self { columns: columns.into(), rows: Vec::new() }
    }

    /// Appends a row.
    ///
    /// # Panics
    /// If the number of cells differs from the number of columns.
    pub fn push(&mut self, row: impl Into<Vec<Cell>>) {
        let row = row.into();
        assert_eq!(row.len(), self.columns.len(), "one cell for each column");
        self.rows.push(row);
    }

    /// The table as CSV, with numbers rounded to six significant digits.
    ///
    /// # Panics
    /// Never: the CSV is written to memory.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header = self.columns.iter().map(Column::header);
        writer.write_record(header).expect("writing to memory does not fail");
        for row in &self.rows {
            let cells = row.iter().map(|cell| match cell {
                Cell::Text(text) => text.clone(),
                Cell::Number(number) => format!("{}", rounded(*number)),
                Cell::Patch(color) => color.hex(),
                Cell::Empty => String::new(),
            });
            writer.write_record(cells).expect("all rows have the same number of cells");
        }
        let bytes = writer.into_inner().expect("writing to memory does not fail");
        String::from_utf8(bytes).expect("only valid UTF-8 was written")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_headings_have_units_and_special_characters_are_quoted() {
        let mut table =
            Table::new([Column::text("pigment"), Column::quantity("wavelength", "nm", 0)]);
        table.push([Cell::from("a, \"b\""), Cell::from(400.000_000_1)]);
        table.push([Cell::from("c"), Cell::Empty]);
        assert_eq!(table.csv(), "pigment,wavelength [nm]\n\"a, \"\"b\"\"\",400\nc,\n");
    }
}
