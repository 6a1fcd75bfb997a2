//! The table of a language: its texts by the English ones.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use super::choice::Language;

/// Translations by the English texts.
pub type Table = BTreeMap<String, String>;

/// The German texts. A test checks that the file can be read; without it the window is English.
static GERMAN: LazyLock<Table> =
    LazyLock::new(|| serde_json::from_str(include_str!("german.json")).unwrap_or_default());

/// The table of a language; `None` for English, whose texts stand in the sources.
#[must_use]
pub fn table(language: Language) -> Option<&'static Table> {
    match language {
        Language::English => None,
        Language::German => Some(&GERMAN),
    }
}

/// Names of the placeholders of a text, such as `count` in `{count} layers`.
#[must_use]
pub fn placeholders(text: &str) -> BTreeSet<&str> {
    let parts = text.split('{').skip(1);
    let named = parts.filter_map(|part| part.split_once('}'));
    named.map(|(name, _)| name.split_once(':').map_or(name, |(name, _)| name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn placeholders_are_found_with_and_without_digits() {
        let found: Vec<&str> = placeholders("{b:.1} of {a}, {b}").into_iter().collect();
        assert_eq!(found, ["a", "b"]);
        assert!(placeholders("none").is_empty());
    }

    #[test]
    fn the_german_texts_can_be_read() {
        let read: Result<Table, _> = serde_json::from_str(include_str!("german.json"));
        assert!(read.unwrap().len() > 100);
    }
}
