//! Single settings from the command line: `--set KEY=VALUE`.

use crate::failure::{Failure, Result};

/// A change of one setting.
pub(crate) struct SettingChange {
    /// Name in messages: the option as it was written.
    pub(crate) name: String,
    /// A line of TOML.
    pub(crate) toml: String,
}

/// The changes of all options `--set`. `example` is shown if one has no `=`.
pub(crate) fn changes(options: &[String], example: &str) -> Result<Vec<SettingChange>> {
    let change = |option: &String| {
        let Some((key, value)) = option.split_once('=') else {
            return Err(Failure::usage(
                format!("--set takes KEY=VALUE, found `{option}`"),
                format!("try --set {example}"),
            ));
        };
        let toml = format!("{} = {}", key.trim(), as_toml(value.trim()));
        Ok(SettingChange { name: format!("--set {option}"), toml })
    };
    options.iter().map(change).collect()
}

/// Converts an option's value to TOML: words need no quotes here, and `.5` is a number.
fn as_toml(value: &str) -> String {
    if let Ok(whole) = value.parse::<i64>() {
        return whole.to_string();
    }
    if let Ok(number) = value.parse::<f64>() {
        return format!("{number:?}").to_lowercase();
    }
    // Lists are written as in a file.
    let bare = ["true", "false"].contains(&value) || value.starts_with(['"', '\'', '[']);
    if bare { value.to_owned() } else { format!("{value:?}") }
}
