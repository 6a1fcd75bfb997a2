//! JSON that people can read and compare: one key per line, a row of numbers on one line.

use serde_json::Value;

/// Writes `value` as text, indented by two spaces and ending in a new line.
#[must_use]
pub fn to_text(value: &Value) -> String {
    let mut text = String::new();
    write(value, 0, &mut text);
    text.push('\n');
    text
}

fn write(value: &Value, depth: usize, text: &mut String) {
    let line = |text: &mut String, depth: usize| {
        text.push('\n');
        text.push_str(&"  ".repeat(depth));
    };
    match value {
        Value::Array(items) if items.iter().any(|item| item.is_object() || item.is_string()) => {
            text.push('[');
            for (index, item) in items.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { "," });
                line(text, depth + 1);
                write_inline_if_flat(item, depth + 1, text);
            }
            line(text, depth);
            text.push(']');
        }
        Value::Object(map) if !map.is_empty() => {
            text.push('{');
            for (index, (key, item)) in map.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { "," });
                line(text, depth + 1);
                text.push_str(&Value::from(key.as_str()).to_string());
                text.push_str(": ");
                write(item, depth + 1, text);
            }
            line(text, depth);
            text.push('}');
        }
        _ => text.push_str(&value.to_string()),
    }
}

/// Writes a flat record, such as one sample's error, on one line.
fn write_inline_if_flat(value: &Value, depth: usize, text: &mut String) {
    match value {
        Value::Object(map) if map.values().all(|v| !v.is_object() && !v.is_array()) => {
            text.push_str(&value.to_string());
        }
        _ => write(value, depth, text),
    }
}
