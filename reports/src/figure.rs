//! A figure: drawing, title, caption, and the data behind it as a table.

use calibrate::digits::rounded;

use crate::panel::Chart;
use crate::style::Color;
use crate::svg::{Canvas, escaped};

/// A figure of a report.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Stem of the figure's files and its anchor on the page: lower-case letters, digits and
    /// hyphens.
    pub name: String,
    /// Title, a few words without a full stop.
    pub title: String,
    /// Caption: one or two sentences on how to read the figure.
    pub caption: String,
    /// Alternative text for readers who cannot see the figure.
    pub alt: String,
    /// The command line that made the figure.
    pub command: String,
    /// The drawing as an SVG document.
    pub svg: String,
    /// The plotted numbers, so that you can draw them with another program.
    pub data: Table,
}

/// The drawing of a figure.
#[derive(Debug, Clone)]
pub enum Drawing {
    /// Panels with axes and marks.
    Chart(Chart),
    /// A free drawing of patches and text.
    Canvas(Canvas),
}

/// The texts of a figure. See the fields of [`Figure`].
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// File stem and anchor ([`Figure::name`]).
    pub name: &'a str,
    /// Title, a few words.
    pub title: &'a str,
    /// Caption, one or two sentences.
    pub caption: &'a str,
    /// Alternative text for readers who cannot see the figure.
    pub alt: &'a str,
}

impl Figure {
    /// Renders `drawing` and joins it with its texts and data. Pass the command line that makes the
    /// figure as `command`. The SVG names it in its description.
    ///
    /// # Panics
    /// If the name is empty, or has a character that is not a lower-case letter, a digit or a
    /// hyphen.
    #[must_use]
    pub fn new(words: Words<'_>, command: &str, drawing: Drawing, data: Table) -> Self {
        let named = !words.name.is_empty()
            && words
                .name
                .chars()
                .all(|c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
        assert!(
            named,
            "a figure's name has lower-case letters, digits and hyphens only, found `{}`",
            words.name
        );
        let svg = match drawing {
            Drawing::Chart(chart) => chart.svg(),
            Drawing::Canvas(canvas) => canvas.into_svg(),
        };
        let description = format!(
            " role=\"img\" aria-label=\"{}\">\n<desc>{}. {} Made by: {}</desc>",
            escaped(words.alt),
            escaped(words.title),
            escaped(words.caption),
            escaped(command)
        );
        Self {
            name: words.name.to_owned(),
            title: words.title.to_owned(),
            caption: words.caption.to_owned(),
            alt: words.alt.to_owned(),
            command: command.to_owned(),
            svg: svg.replacen('>', &description, 1),
            data,
        }
    }

    /// The colours of lines, dots, areas and text, sorted and without repeats. This leaves out the
    /// colours of patches (`rect` elements), because a dark page must not change them.
    #[must_use]
    pub fn line_colors(&self) -> Vec<Color> {
        let mut found = Vec::new();
        let elements = self.svg.lines().filter(|line| line.starts_with('<'));
        for element in elements.filter(|line| !line.starts_with("<rect")) {
            for attribute in ["fill=\"#", "stroke=\"#"] {
                let Some((_, rest)) = element.split_once(attribute) else { continue };
                let byte = |at: usize| u8::from_str_radix(rest.get(at..at + 2)?, 16).ok();
                if let (Some(r), Some(g), Some(b)) = (byte(0), byte(2), byte(4)) {
                    found.push(Color([r, g, b]));
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// Heading and format of a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name of the column.
    pub name: String,
    /// Unit of a quantity, `1` for a ratio, or `None` for text.
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
    /// Empty, because we do not know the value or it does not apply.
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
    #[must_use]
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header = self.columns.iter().map(Column::header);
        let header = header.map(|name| documents::spreadsheet_cell(&name).into_owned());
        writer.write_record(header).expect("writing to memory does not fail");
        for row in &self.rows {
            let cells = row.iter().map(|cell| match cell {
                Cell::Text(text) => documents::spreadsheet_cell(text).into_owned(),
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
