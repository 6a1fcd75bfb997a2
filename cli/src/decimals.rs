//! Numbers in sentences, without zeros that say nothing.

/// A number with `most` decimals or fewer: `0.2` instead of `0.200`.
pub(crate) fn at_most(value: f64, most: usize) -> String {
    let text = format!("{value:.most$}");
    let short = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::at_most;

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
}
