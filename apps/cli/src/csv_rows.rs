//! Prints rows of JSON as CSV. This file also says how verbs write numbers (without zeros and signs
//! that say nothing) and colours (as a patch and a code, marked if the display cannot show them).

use calibrate::rows::csv_of;
use serde_json::Value;
use spectra::color::{Lab, Rgb, RgbSpace};

use crate::console::Console;
use crate::failure::Result;

impl Console<'_> {
    /// Prints objects as CSV, one row each.
    pub(crate) fn csv_rows(&mut self, rows: &[Value]) -> Result<()> {
        self.text(&csv_of(rows))
    }
}

/// A number with `most` decimals or fewer: `0.2` instead of `0.200`.
pub(crate) fn at_most(value: f64, most: usize) -> String {
    let text = format!("{value:.most$}");
    let short = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// Formats a number with this many decimals. A number that rounds to zero gets no minus sign.
pub(crate) fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.bytes().all(|digit| b"0.".contains(&digit)) => zero.to_owned(),
        _ => text,
    }
}

/// L*, a* and b* of a colour, separated by blanks.
pub(crate) fn lab(color: Lab) -> String {
    color.to_array().map(|value| rounded(value, 2)).join(" ")
}

/// Mark behind the code of a colour that is outside its space, in tables.
const MARK: &str = "*";

impl Console<'_> {
    /// Patch and code of an sRGB colour, with a note if it is outside sRGB.
    pub(crate) fn srgb(&self, color: Rgb) -> String {
        format!("{}{}", self.patch(color), color.to_hex_with_note(RgbSpace::Srgb))
    }
}

/// Cells with colours in a table. This remembers whether a colour was marked, so that a note below the
/// table can explain the mark.
#[derive(Debug)]
pub(crate) struct TableColors {
    space: RgbSpace,
    is_marked: bool,
}

impl TableColors {
    pub(crate) fn of(space: RgbSpace) -> Self {
        Self { space, is_marked: false }
    }

    /// Patch and code of a colour, 8 columns wide without the patch.
    pub(crate) fn cell(&mut self, color: Rgb, console: &Console<'_>) -> String {
        let outside = !color.in_gamut();
        self.is_marked |= outside;
        let mark = if outside { MARK } else { " " };
        format!("{}{}{mark}", console.patch(color), color.to_hex())
    }

    /// Prints what the mark means, if a colour has one.
    pub(crate) fn note(&self, indent: &str, console: &mut Console<'_>) -> Result<()> {
        if !self.is_marked {
            return Ok(());
        }
        console.line(format!("{indent}{MARK} {}", self.space.outside_note()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_at_the_end_are_left_out_and_others_stay() {
        for (value, most, wanted) in [
            (0.2, 3, "0.2"),
            (0.1 + 0.2, 3, "0.3"),
            (0.0625, 4, "0.0625"),
            (0.06254, 3, "0.063"),
            (4.0, 2, "4"),
            (100.0, 0, "100"),
            (1200.0, 2, "1200"),
            (-0.0001, 2, "0"),
            (-1.5, 2, "-1.5"),
        ] {
            assert_eq!(at_most(value, most), wanted);
        }
    }
    #[test]
    fn a_rounded_zero_has_no_sign() {
        for (value, decimals, wanted) in
            [(-0.004, 2, "0.00"), (-0.0, 0, "0"), (-0.006, 2, "-0.01"), (-10.0, 1, "-10.0")]
        {
            assert_eq!(rounded(value, decimals), wanted);
        }
        assert_eq!(lab(Lab { lightness: 100.0, a: -1e-9, b: -3.0 }), "100.00 0.00 -3.00");
    }
}
