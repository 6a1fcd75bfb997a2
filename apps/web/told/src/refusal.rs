//! Turns errors of the libraries into JSON, in the words of the page.

use std::error::Error;

use documents::hint::{Explain, Fault, Hint};
use documents::request::request_from_json;
use serde_json::json;
use wasm_bindgen::JsValue;

/// Result of a call of a page.
pub type Result<T> = std::result::Result<T, JsValue>;

/// Settings that a hint may name, each with its control on the page. Other settings exist only as
/// options of the program.
pub type Controls = [(&'static str, &'static str)];

/// A hint that names the controls of the page.
#[must_use]
pub fn hint_text(hint: &Hint, controls: &Controls) -> String {
    hint.with_settings(|name, value| {
        if (name, value) == ("dark_reading", Some("0")) {
            return "\"Dark is subtracted already\"".to_owned();
        }
        let control = controls.iter().find(|(setting, _)| *setting == name);
        // A word in capitals stands for what the user writes.
        let value = value.filter(|value| {
            value.chars().any(|c| c.is_ascii_lowercase() || c == '"')
                || value.parse::<f64>().is_ok()
        });
        match (control, value) {
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
#[must_use]
pub fn refusal(error: &dyn Explain, controls: &Controls) -> JsValue {
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
    let hint = error.hint().map(|hint| hint_text(&hint, controls));
    told(&json!({ "message": message, "causes": causes, "hint": hint, "fault": fault }))
}

/// The error of a setting that the page itself checks, because no library reads it.
#[must_use]
pub fn setting(message: &str, hint: &str) -> JsValue {
    told(&json!({ "message": message, "causes": [], "hint": hint, "fault": "setting" }))
}

fn told(failure: &serde_json::Value) -> JsValue {
    JsValue::from_str(&failure.to_string())
}

/// A request that the page passes as JSON.
///
/// # Errors
/// The refusal of a key that does not exist, or of a value that its key does not take.
pub fn request<T: serde::de::DeserializeOwned>(json: &str, controls: &Controls) -> Result<T> {
    request_from_json(json).map_err(|error| refusal(&error, controls))
}
