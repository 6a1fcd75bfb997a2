//! Reads golden files, i.e. reference values of independent programs with a tolerance, and compares
//! numbers with them.

use std::fmt::Display;
use std::path::PathBuf;

use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A golden file: its tolerance, its cases and, in `shared`, every other key, e.g. how the file was
/// made or data that several cases use.
#[derive(Debug, Deserialize)]
pub struct Golden<Cases, Shared = serde_json::Value> {
    /// Largest difference allowed between a result and its reference value.
    pub tolerance: f64,
    /// Inputs with their reference values.
    pub cases: Cases,
    /// All other keys of the file.
    #[serde(flatten)]
    pub shared: Shared,
}

/// Reads the golden file `tests/golden/NAME.json`.
///
/// # Panics
/// If the file is missing or has another form. The message names the file and the cause.
#[must_use]
pub fn read<Cases: DeserializeOwned, Shared: DeserializeOwned>(
    name: &str,
) -> Golden<Cases, Shared> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}.json"));
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Asserts that each value of `got` differs from the value of `wanted` at the same index by at most
/// `tolerance` (absolute). `case` names the compared values in the message.
///
/// # Panics
/// If the lengths differ, a value is not finite, or a difference exceeds `tolerance`.
#[track_caller]
pub fn assert_near(case: impl Display, got: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(got.len(), wanted.len(), "{case}: number of values");
    for (index, (got, wanted)) in got.iter().zip(wanted).enumerate() {
        // The difference of an infinity or a NaN means nothing, so you get this message instead.
        assert!(got.is_finite() && wanted.is_finite(), "{case} [{index}]: {got} for {wanted}");
        assert!(
            (got - wanted).abs() <= tolerance,
            "{case} [{index}]: {got} for {wanted}, off by more than {tolerance:e}"
        );
    }
}
