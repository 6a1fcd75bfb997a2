//! Text names of actions.

use serde::Serialize;
use serde_json::Value;

/// Name of an action that serializes as a text, as a number, or as an object with one key: its
/// texts and numbers joined by hyphens.
#[must_use]
pub fn name_of(action: &impl Serialize) -> String {
    // An action without a JSON form has an empty name, which no preferences hold.
    serde_json::to_value(action).map(|value| joined(&value)).unwrap_or_default()
}

fn joined(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Object(keys) => {
            let parts = keys.iter().map(|(key, value)| format!("{key}-{}", joined(value)));
            parts.collect::<Vec<_>>().join("-")
        }
        other => other.to_string(),
    }
}
