//! Errors of the libraries as the page takes them: JSON in the words of the page.

use std::error::Error;

use serde_json::json;
use spectra::hint::{Explain, Fault, Hint};
use wasm_bindgen::JsValue;

/// Result of a call of the page.
pub(crate) type Result<T> = std::result::Result<T, JsValue>;

/// Where the page has each setting that hints name. Others are options of the program alone.
const CONTROLS: [(&str, &str); 29] = [
    ("reference", "\"White\""),
    ("percent", "\"Readings are in\": percent"),
    ("fraction", "\"Readings are in\": fractions"),
    ("format", "\"Format\""),
    ("pigments", "\"Columns of pigments\""),
    ("recipes", "the CSV of recipes in \"Recipes of the samples\""),
    ("saunderson", "\"Surface\" (k1 and k2)"),
    ("specular", "\"Gloss of the readings\""),
    ("below_surface", "\"Readings below the surface\""),
    ("smoothness", "\"Smoothness\""),
    ("unevenness", "\"Unevenness\""),
    ("exclude", "\"Samples to leave out\""),
    ("amounts", "\"Amounts\""),
    ("method", "\"Method\""),
    ("white_reading", "\"White reading\""),
    ("dark_reading", "\"Dark readings\""),
    ("tile", "\"Reflectance of the white\""),
    ("full_scale", "\"Largest count\""),
    ("least_light", "\"Least light\""),
    ("illuminant", "\"Light\""),
    ("observer", "\"Observer\""),
    ("thickness", "\"Thickness\""),
    ("over", "\"Over\""),
    ("only", "\"Only these pigments\""),
    ("with", "\"With\""),
    ("without", "\"Without\""),
    ("at_most", "\"Pigments at most\""),
    ("least", "\"Least share\""),
    ("tolerance", "\"Tolerance\""),
];

/// A hint that names the controls of the page.
pub(crate) fn hint_text(hint: &Hint) -> String {
    hint.with_settings(|name, value| {
        if (name, value) == ("dark_reading", Some("0")) {
            return "\"Dark is subtracted already\"".to_owned();
        }
        let control = CONTROLS.iter().find(|(setting, _)| *setting == name);
        // A word in capitals stands for what the user writes.
        let is_word = |value: &str| !value.chars().any(|c| c.is_ascii_lowercase() || c == '"');
        let is_number = |value: &str| value.parse::<f64>().is_ok();
        match (control, value.filter(|value| !is_word(value) || is_number(value))) {
            (Some((_, control)), None) => (*control).to_owned(),
            (Some((_, control)), Some(value)) => {
                format!("{control}: {}", value.trim_matches('"'))
            }
            (None, None) => format!("`--{}` of the program impasto", name.replace('_', "-")),
            (None, Some(value)) => {
                format!("`--{} {value}` of the program impasto", name.replace('_', "-"))
            }
        }
    })
}

/// An error with its causes.
pub(crate) fn failure(error: &dyn Explain) -> JsValue {
    let mut causes = Vec::new();
    let mut cause: Option<&dyn Error> = error.source();
    let message = error.to_string();
    while let Some(error) = cause {
        let text = error.to_string();
        if text != message {
            causes.push(text);
        }
        cause = error.source();
    }
    let fault = match error.fault() {
        Fault::Input => "input",
        Fault::Setting => "setting",
        Fault::Environment => "environment",
    };
    let hint = error.hint().map(|hint| hint_text(&hint));
    told(&json!({ "message": message, "causes": causes, "hint": hint, "fault": fault }))
}

/// A setting of the page that no library reads.
pub(crate) fn setting(message: &str, hint: &str) -> JsValue {
    told(&json!({ "message": message, "causes": [], "hint": hint, "fault": "setting" }))
}

fn told(failure: &serde_json::Value) -> JsValue {
    JsValue::from_str(&failure.to_string())
}

/// Results whose errors reach the page.
pub(crate) trait Told<T> {
    /// The error as the page takes it.
    fn told(self) -> Result<T>;
}

impl<T, E: Explain> Told<T> for std::result::Result<T, E> {
    fn told(self) -> Result<T> {
        self.map_err(|error| failure(&error))
    }
}

/// Options that the page passes as JSON.
pub(crate) fn options<T: serde::de::DeserializeOwned>(json: &str) -> Result<T> {
    serde_json::from_str(json)
        .map_err(|error| setting(&format!("options of the page: {error}"), "load the page again"))
}
