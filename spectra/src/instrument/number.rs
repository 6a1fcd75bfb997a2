//! Numbers as instruments write them.

use super::error::InstrumentError;

/// What parts whole from fraction in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decimal {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}

impl Decimal {
    /// What `cells` use: a comma, if any has one. A file that has both is then refused at
    /// the first point, since thousands cannot be told from decimals.
    pub(super) fn of<'a>(mut cells: impl Iterator<Item = &'a str>) -> Self {
        if cells.any(|cell| cell.contains(',')) { Self::Comma } else { Self::Point }
    }
}

/// The number in `text`; `None` if it is none, infinite, or not a number.
pub(super) fn number(text: &str, decimal: Decimal) -> Option<f64> {
    let text = text.trim();
    // `inf`, `nan` and the like are words to us.
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

/// The number in `text`, which stands in `line` of `file`.
pub(super) fn wanted(
    file: &str,
    line: usize,
    what: &'static str,
    text: &str,
    decimal: Decimal,
) -> Result<f64, InstrumentError> {
    number(text, decimal).ok_or_else(|| InstrumentError::line(file, line, what, text))
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
