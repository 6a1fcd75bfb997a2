//! Rounding of numbers for files.

/// Rounds `value` to six significant digits: more than any reading carries, and few enough that a
/// file has the same bytes on every machine.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
