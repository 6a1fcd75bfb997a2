//! Scripts as JSON: one action per line.

use serde::Deserialize;
use serde_json::Value;

use super::action::Action;
use super::error::ScriptError;
use super::limits::MAX_FILE_BYTES;
use super::script::{FormatVersion, StrokeScript};

impl StrokeScript {
    /// Reads a script from `bytes`, the content of the file named `file`.
    ///
    /// # Errors
    /// [`ScriptError`] for a file that is too long, not UTF-8, not JSON, or of another
    /// format or version, for unknown, missing and repeated keys, and for values out of
    /// range (see [`StrokeScript::check`]).
    pub fn from_json(file: &str, bytes: &[u8]) -> Result<Self, ScriptError> {
        let named = || file.to_owned();
        if bytes.len() > MAX_FILE_BYTES {
            let bytes = bytes.len();
            let limit = MAX_FILE_BYTES;
            return Err(ScriptError::TooLong { file: named(), bytes, limit });
        }
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let (sound, rest) = bytes.split_at(error.valid_up_to());
            let line = 1 + sound.iter().filter(|byte| **byte == b'\n').count();
            ScriptError::Encoding { file: named(), line, byte: rest.first().copied().unwrap_or(0) }
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let script: Self =
            serde_json::from_str(text).map_err(|error| explained(file, text, &error))?;
        script.check_values().map_err(|invalid| ScriptError::Value { file: named(), invalid })?;
        Ok(script)
    }

    /// The script without its actions, with numbers rounded to the digits of a file.
    ///
    /// # Errors
    /// [`ScriptError`] for values out of range (see [`StrokeScript::check`]).
    pub fn rounded_header(&self) -> Result<Self, ScriptError> {
        Self::from_json(&self.title, self.header().to_json()?.as_bytes())
    }

    /// Writes the script as JSON with one action per line. Samples have four decimals, all
    /// other numbers six significant digits. The same script gives the same bytes.
    ///
    /// # Errors
    /// [`ScriptError`] for values out of range (see [`StrokeScript::check`]).
    pub fn to_json(&self) -> Result<String, ScriptError> {
        self.check()?;
        let unwritable = |error: serde_json::Error| ScriptError::Syntax {
            file: self.title.clone(),
            line: 0,
            column: 0,
            reason: error.to_string(),
        };
        // The actions are written one by one: as one value they would take much memory.
        let head = serde_json::to_value(self.header()).map_err(unwritable)?;
        let mut text = "{\n".to_owned();
        for (key, value) in
            head.as_object().into_iter().flatten().filter(|(key, _)| *key != "actions")
        {
            text.push_str(&format!("  \"{key}\": "));
            write(value, &mut text);
            text.push_str(",\n");
        }
        text.push_str("  \"actions\": [");
        for (index, action) in self.actions.iter().enumerate() {
            text.push_str(if index == 0 { "\n    " } else { ",\n    " });
            text.push_str(&action_line(action).map_err(unwritable)?);
        }
        text.push_str(if self.actions.is_empty() { "]\n}\n" } else { "\n  ]\n}\n" });
        Ok(text)
    }
}

/// An action as one line of a file, with its numbers rounded.
pub(crate) fn action_line(action: &Action) -> Result<String, serde_json::Error> {
    let action = &action.rounded();
    let mut text = String::new();
    write(&serde_json::to_value(action)?, &mut text);
    Ok(text)
}

/// Converts an error of the parser; if the cause is another format or version, names that.
fn explained(file: &str, text: &str, error: &serde_json::Error) -> ScriptError {
    #[derive(Deserialize)]
    struct Kind {
        #[serde(default)]
        format: Value,
        #[serde(default)]
        version: Value,
    }
    let file = file.to_owned();
    if error.is_data()
        && let Ok(Kind { format, version }) = serde_json::from_str(text)
    {
        if format != "strokes" {
            return ScriptError::Format { file, found: format.to_string() };
        }
        if version != FormatVersion::NUMBER {
            let newest = FormatVersion::NUMBER;
            return ScriptError::Version { file, found: version.to_string(), newest };
        }
    }
    // The parser's message ends with line and column, which this error states separately.
    let reason = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let reason = reason.strip_suffix(&place).unwrap_or(&reason);
    let reason = documents::plain_parser_message(reason);
    ScriptError::Syntax { file, line: error.line(), column: error.column(), reason }
}

/// Appends `value` to `text` on one line.
fn write(value: &Value, text: &mut String) {
    match value {
        Value::Object(map) => {
            text.push('{');
            for (index, (key, item)) in map.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { ", " });
                text.push_str(&Value::from(key.as_str()).to_string());
                text.push_str(": ");
                write(item, text);
            }
            text.push('}');
        }
        Value::Array(items) => {
            text.push('[');
            for (index, item) in items.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { ", " });
                match item {
                    // Numbers of samples are already rounded.
                    Value::Array(row) => write_row(row, text),
                    _ => write(item, text),
                }
            }
            text.push(']');
        }
        Value::Number(number) => match number.as_f64() {
            Some(value) if number.is_f64() => {
                text.push_str(&plain(pigment::digits::rounded(value)));
            }
            _ => text.push_str(&number.to_string()),
        },
        _ => text.push_str(&value.to_string()),
    }
}

fn write_row(row: &[Value], text: &mut String) {
    text.push('[');
    for (index, item) in row.iter().enumerate() {
        text.push_str(if index == 0 { "" } else { "," });
        match item.as_f64() {
            Some(number) => text.push_str(&plain(number)),
            None => write(item, text),
        }
    }
    text.push(']');
}

/// A number without `.0`, and without the sign of -0.
fn plain(number: f64) -> String {
    if number == 0.0 { "0".to_owned() } else { number.to_string() }
}
