//! Parsing numbers in the files of instruments.

use super::error::InstrumentError;

/// The decimal sign of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decimal {
    /// A decimal point: `0.5`.
    Point,
    /// A decimal comma: `0,5`.
    Comma,
}

impl Decimal {
    /// The decimal sign of `cells`: a comma if any cell contains one. In a file with both signs
    /// the first point is then an error, because a separator of thousands cannot be
    /// distinguished from a decimal sign.
    pub(super) fn of<'a>(mut cells: impl Iterator<Item = &'a str>) -> Self {
        if cells.any(|cell| cell.contains(',')) { Self::Comma } else { Self::Point }
    }
}

/// Parses a finite number; `None` if `text` is anything else.
pub(super) fn number(text: &str, decimal: Decimal) -> Option<f64> {
    let text = text.trim();
    // `inf`, `nan` and the like count as words.
    if !text.bytes().all(|b| b.is_ascii_digit() || b"+-.,eE".contains(&b)) {
        return None;
    }
    let value = match decimal {
        Decimal::Point => text.parse().ok(),
        // `400,` is the start of `400, 0.5`.
        Decimal::Comma if text.contains('.') || text.ends_with(',') => None,
        Decimal::Comma => text.replace(',', ".").parse().ok(),
    };
    value.filter(|value: &f64| value.is_finite())
}

/// Parses the number in `text`, a cell of `line` in `file`. `expected` describes it in the
/// error.
pub(super) fn required_number(
    file: &str,
    line: usize,
    expected: &'static str,
    text: &str,
    decimal: Decimal,
) -> Result<f64, InstrumentError> {
    number(text, decimal).ok_or_else(|| InstrumentError::line(file, line, expected, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_finite_numbers_are_numbers() {
        assert_eq!(number(" 1.8792E2 ", Decimal::Point), Some(187.92));
        assert_eq!(number("-0,5", Decimal::Comma), Some(-0.5));
        assert_eq!(number("7", Decimal::Comma), Some(7.0));
        for text in ["", "inf", "NaN", "1e999", "1,5", "0x1", "1.2.3", "-"] {
            assert_eq!(number(text, Decimal::Point), None, "{text}");
        }
        assert_eq!(number("1.234,5", Decimal::Comma), None);
    }
}
