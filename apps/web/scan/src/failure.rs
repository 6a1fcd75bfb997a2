//! Errors of the libraries, in the words of the panel.

use documents::hint::Explain;
use pigment::{Remark, RemarkKind};
use serde_json::{Value, json};

pub(crate) use told::{Controls, Result};

/// Settings of maps that a hint may name, each with its control in the panel. Other settings exist only as
/// options of the program.
pub(crate) const CONTROLS: [(&str, &str); 11] = [
    ("at_most", "\"Pigments of a pixel at most\""),
    ("palette", "\"Only these pigments\""),
    ("spot", "spot of the map"),
    ("region", "\"Rows and columns\""),
    ("scale", "\"A white reads\""),
    ("percent", "\"Values are\": percent"),
    ("fraction", "\"Values are\": fractions"),
    ("full_scale", "\"Largest count of the detector\""),
    ("white_reading", "\"White reading\""),
    ("dark_reading", "\"Dark reading\""),
    ("tile", "\"Reflectance of the white\""),
];

/// A request that the page passes as JSON.
pub(crate) fn request<T: serde::de::DeserializeOwned>(json: &str) -> Result<T> {
    told::request(json, &CONTROLS)
}

/// For each remark: `warning`, `text` and `hint`, which names `controls`.
pub(crate) fn remarks<'a>(
    remarks: impl IntoIterator<Item = &'a Remark>,
    controls: &Controls,
) -> Value {
    let told = remarks.into_iter().map(|remark| {
        json!({
            "warning": remark.kind == RemarkKind::Warning,
            "text": remark.text,
            "hint": remark.hint.as_ref().map(|hint| told::hint_text(hint, controls)),
        })
    });
    told.collect()
}

/// Results whose errors reach the page.
pub(crate) trait Told<T> {
    fn told(self) -> Result<T>;
}

impl<T, E: Explain> Told<T> for std::result::Result<T, E> {
    fn told(self) -> Result<T> {
        self.map_err(|error| told::refusal(&error, &CONTROLS))
    }
}
