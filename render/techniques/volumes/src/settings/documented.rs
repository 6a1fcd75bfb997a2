//! Settings as a TOML file with a comment above each key.

use super::setting::{Setting, Takes};
use super::whole::{Settings, text_of, value_of};

/// Longest line of a comment.
const WIDTH: usize = 90;

impl Settings {
    /// The text of a TOML file of these settings: `title` as a comment, then each key below its
    /// meaning, unit and range. Reading it gives the same settings to the bit.
    #[must_use]
    pub fn documented(&self, title: &str) -> String {
        let table = self.table();
        let mut text = comment(title);
        let mut group = "";
        for setting in Self::all() {
            let (own_group, key) = setting.key.split_once('.').unwrap_or(("", setting.key));
            if own_group != group {
                text.push_str(&format!("\n[{own_group}]\n"));
                group = own_group;
            } else if own_group.is_empty() {
                text.push('\n');
            }
            let value = value_of(&table, setting.key).map(text_of).unwrap_or_default();
            text.push_str(&comment(&meaning(setting)));
            text.push_str(&format!("{key} = {value}\n"));
        }
        text
    }
}

/// Meaning, unit and range of a setting in a sentence.
fn meaning(setting: &Setting) -> String {
    let about = setting.about.trim_end_matches('.');
    let range = match setting.takes {
        Takes::Switch => String::new(),
        takes if setting.unit.is_empty() => format!(" ({takes})"),
        takes => format!(" ({}, {takes})", setting.unit),
    };
    format!("{about}{range}.")
}

/// `text` as lines of a comment.
fn comment(text: &str) -> String {
    let mut lines = String::new();
    let mut line = "#".to_owned();
    for word in text.split_whitespace() {
        if line.len() + 1 + word.len() > WIDTH {
            lines.push_str(&line);
            lines.push('\n');
            line = "#".to_owned();
        }
        line.push(' ');
        line.push_str(word);
    }
    format!("{lines}{line}\n")
}
