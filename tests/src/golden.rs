//! Reader of golden files: reference values of independent programs, with a tolerance.

use std::path::PathBuf;

use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A golden file: its tolerance, its cases and, in `shared`, every other key: how the file was
/// made, and data that several cases use.
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
/// If the file is missing or has another form; the message names the file and the cause.
#[must_use]
pub fn read<Cases: DeserializeOwned, Shared: DeserializeOwned>(
    name: &str,
) -> Golden<Cases, Shared> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}.json"));
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
