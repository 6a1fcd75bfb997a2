//! Tables: the numbers beside a figure as CSV, and tables of the page.

use calibrate::digits::rounded;

use crate::style::Color;

/// A column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// What it holds.
    pub name: String,
    /// The unit of a quantity; none for words. A ratio has the unit `1`.
    pub unit: Option<String>,
    /// Digits behind the point on a page.
    pub digits: usize,
}

impl Column {
    /// A column of words.
    #[must_use]
    pub fn words(name: &str) -> Self {
        Self { name: name.to_owned(), unit: None, digits: 0 }
    }

    /// A column of quantities.
    #[must_use]
    pub fn quantity(name: &str, unit: &str, digits: usize) -> Self {
        Self { name: name.to_owned(), unit: Some(unit.to_owned()), digits }
    }

    /// `name [unit]`, or the name alone.
    #[must_use]
    pub fn header(&self) -> String {
        match &self.unit {
            Some(unit) => format!("{} [{unit}]", self.name),
            None => self.name.clone(),
        }
    }
}

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Words.
    Words(String),
    /// A number in its column's unit.
    Number(f64),
    /// A colour: a patch on a page, `#RRGGBB` in a file.
    Patch(Color),
    /// Nothing known.
    Empty,
}

impl From<&str> for Cell {
    fn from(words: &str) -> Self {
        Self::Words(words.to_owned())
    }
}

impl From<String> for Cell {
    fn from(words: String) -> Self {
        Self::Words(words)
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
    /// The columns.
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

    /// Adds a row.
    ///
    /// # Panics
    /// If it has not one cell for each column.
    pub fn push(&mut self, row: impl Into<Vec<Cell>>) {
        let row = row.into();
        assert_eq!(row.len(), self.columns.len(), "one cell for each column");
        self.rows.push(row);
    }

    /// As CSV, numbers to six significant digits.
    ///
    /// # Panics
    /// Never: memory takes any text.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header = self.columns.iter().map(Column::header);
        writer.write_record(header).expect("memory takes any text");
        for row in &self.rows {
            let cells = row.iter().map(|cell| match cell {
                Cell::Words(words) => words.clone(),
                Cell::Number(number) => format!("{}", rounded(*number)),
                Cell::Patch(color) => color.hex(),
                Cell::Empty => String::new(),
            });
            writer.write_record(cells).expect("each row has every column");
        }
        let bytes = writer.into_inner().expect("memory takes any text");
        String::from_utf8(bytes).expect("text was written")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_names_units_and_quotes_what_needs_it() {
        let mut table =
            Table::new([Column::words("pigment"), Column::quantity("wavelength", "nm", 0)]);
        table.push([Cell::from("a, \"b\""), Cell::from(400.000_000_1)]);
        table.push([Cell::from("c"), Cell::Empty]);
        assert_eq!(table.csv(), "pigment,wavelength [nm]\n\"a, \"\"b\"\"\",400\nc,\n");
    }
}
