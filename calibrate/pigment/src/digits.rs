//! Numbers as files should hold them.

/// `value` to six significant digits: more than any reading carries, few enough
/// that a file reads the same on every machine.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
