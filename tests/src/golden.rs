//! Golden files: values by colour-science, with the tolerance to meet.

use std::path::PathBuf;

use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A golden file: how it was made, how near to come, and its cases. Keys that
/// only some files have land in `shared`.
#[derive(Debug, Deserialize)]
pub struct Golden<Cases, Shared = serde_json::Value> {
    /// Largest difference allowed.
    pub tolerance: f64,
    /// The cases.
    pub cases: Cases,
    /// Other keys.
    #[serde(flatten)]
    pub shared: Shared,
}

/// The golden file `tests/golden/NAME.json`.
///
/// # Panics
/// If it is missing or of another form, with the reason.
#[must_use]
pub fn read<Cases: DeserializeOwned, Shared: DeserializeOwned>(
    name: &str,
) -> Golden<Cases, Shared> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}.json"));
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
