//! The separator and decimal sign of a text, and its rows of numbers.

use super::error::InstrumentError;
use super::number::{Decimal, number, required_number};

/// Separator and decimal sign of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    /// Character between cells; `None` for any run of blanks.
    pub(super) separator: Option<char>,
    pub(super) decimal: Decimal,
}

impl Layout {
    /// The layout under which the most lines are rows of two or more numbers; `None` if no line
    /// is. A comma counts as separator only if no other separator fits as well.
    pub(super) fn of<'a>(lines: impl Iterator<Item = &'a str> + Clone) -> Option<Self> {
        let mut best: (usize, Option<Self>) = (0, None);
        for separator in [Some(';'), Some('\t'), None, Some(',')] {
            let cells = lines.clone().map(|line| split(line, separator));
            let rows = cells.filter(|cells| is_row(cells));
            let mut count = 0;
            let mut commas = false;
            for row in rows {
                count += 1;
                commas |= row.iter().any(|cell| cell.contains(','));
            }
            if count > best.0 {
                let decimal = if commas { Decimal::Comma } else { Decimal::Point };
                best = (count, Some(Self { separator, decimal }));
            }
        }
        best.1
    }

    /// The cells of a line, trimmed, without empty ones at its end.
    pub(super) fn cells<'a>(&self, line: &'a str) -> Vec<&'a str> {
        split(line, self.separator)
    }

    /// Whether all cells of a line are numbers, and there are at least two.
    pub(super) fn is_row(&self, line: &str) -> bool {
        is_row(&split(line, self.separator))
    }

    /// The numbers of a line. It must have `width` cells, or any number of 2 and more if
    /// `width` is 0.
    pub(super) fn numbers(
        &self,
        file: &str,
        line: usize,
        text: &str,
        width: usize,
    ) -> Result<Vec<f64>, InstrumentError> {
        let cells = self.cells(text);
        if cells.len() < 2 || (width > 0 && cells.len() != width) {
            let expected = "a wavelength and as many values as in the lines before";
            return Err(InstrumentError::line(file, line, expected, text));
        }
        let parsed = cells.iter().enumerate().map(|(column, cell)| {
            let expected = if column == 0 { "a wavelength" } else { "a value" };
            required_number(file, line, expected, cell, self.decimal)
        });
        parsed.collect()
    }
}

fn split(line: &str, separator: Option<char>) -> Vec<&str> {
    let mut cells: Vec<&str> = match separator {
        Some(separator) => {
            // A separator between quotes is part of its cell.
            let mut quoted = false;
            let cells = line.split(|c: char| {
                quoted ^= c == '"';
                c == separator && !quoted
            });
            cells.map(|cell| cell.trim().trim_matches('"')).collect()
        }
        None => line.split_whitespace().collect(),
    };
    let kept = cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
    cells.truncate(kept);
    cells
}

fn is_row(cells: &[&str]) -> bool {
    cells.len() > 1
        && cells.iter().all(|cell: &&str| {
            number(cell, Decimal::Point).is_some() || number(cell, Decimal::Comma).is_some()
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_and_decimal_commas_are_distinguished() {
        use Decimal::{Comma, Point};
        for (line, separator, decimal) in [
            ("400;0,5", Some(';'), Comma),
            ("400;0.5;", Some(';'), Point),
            ("400\t0,5", Some('\t'), Comma),
            ("400,5 0,123", None, Comma),
            ("  400   0.5", None, Point),
            ("400,0.5", Some(','), Point),
            ("400, 0.5", Some(','), Point),
            ("400 , 0.5", Some(','), Point),
            ("\"400\",\"0,5\"", Some(','), Comma),
            ("400,\"0,5\"", Some(','), Comma),
        ] {
            assert_eq!(
                Layout::of([line].into_iter()),
                Some(Layout { separator, decimal }),
                "{line}"
            );
        }
        assert_eq!(Layout::of(["wavelength,value"].into_iter()), None);
    }
}
