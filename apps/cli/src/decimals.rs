//! Numbers in sentences and tables, without zeros and signs that say nothing.

use spectra::color::Lab;

/// A number with `most` decimals or fewer: `0.2` instead of `0.200`.
pub(crate) fn at_most(value: f64, most: usize) -> String {
    let text = format!("{value:.most$}");
    let short = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// A number with this many decimals. One that rounds to zero has no sign.
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
