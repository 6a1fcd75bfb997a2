//! The languages of the window. The sources hold English texts, and each other language has a table
//! with their translations.
//!
//! You show a text through [`tr`], one with values through `tr_format`. Both look it up in the
//! table of the language that [`speak`] chose for this thread. If the table lacks a text, you see
//! the English one. Tables of data hold English texts, which we translate where we show them.
//!
//! Only the thread of the window chooses a language. All others speak English, as the tests do.
//! The session writes labels of actions in English, so we recognise these by their pattern.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{Display, Write};
use std::sync::{LazyLock, OnceLock};

use serde::{Deserialize, Serialize};

/// Formats a text with values in the language of this thread, e.g. `tr_format!("{count} layers",
/// count = layers.len())`. Every placeholder has a name, and you list every name after the text. If
/// a variable has this name, the name alone is enough. In English this is `format!`, which checks
/// the names when it is compiled.
macro_rules! tr_format {
    (@value $name:ident) => { $name };
    (@value $name:ident $value:expr) => { $value };
    ($text:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        match $crate::language::translation($text) {
            None => format!($text $(, $name = tr_format!(@value $name $($value)?))*),
            Some(pattern) => $crate::language::filled(
                pattern,
                &[$((
                    stringify!($name),
                    &tr_format!(@value $name $($value)?) as &dyn std::fmt::Display,
                )),*],
            ),
        }
    };
}

pub(crate) use tr_format;

/// A language of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// The texts in the sources.
    #[default]
    English,
    /// The texts of `german.json`.
    German,
}

impl Language {
    /// Every language, as listed in the preferences.
    pub const ALL: [Self; 2] = [Self::English, Self::German];

    /// Name of the language in the language itself, e.g. `Deutsch`.
    #[must_use]
    pub fn own_name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::German => "Deutsch",
        }
    }

    /// The language in the environment variables `LC_ALL`, `LC_MESSAGES` and `LANG`. The first that
    /// is not empty decides. English if it names none of our languages.
    #[must_use]
    pub fn of_environment() -> Self {
        Self::of_locales(["LC_ALL", "LC_MESSAGES", "LANG"].map(|name| std::env::var(name).ok()))
    }

    /// The language of a name, e.g. `de-AT`.
    #[must_use]
    pub fn of_name(name: &str) -> Self {
        Self::of_locales([Some(name.to_owned()), None, None])
    }

    /// The language of the first name that is not empty, e.g. `de_AT.UTF-8`.
    fn of_locales(names: [Option<String>; 3]) -> Self {
        let name = names.into_iter().flatten().find(|name| !name.is_empty());
        let word = name.as_deref().and_then(|name| name.split(['_', '.', '@', '-']).next());
        if word == Some("de") { Self::German } else { Self::English }
    }
}

/// A table from English texts to their translations.
pub type Table = BTreeMap<String, String>;

/// The German texts. A test checks this file. Without it the window would be English.
static GERMAN: LazyLock<Table> =
    LazyLock::new(|| serde_json::from_str(include_str!("german.json")).unwrap_or_default());

/// The table of a language; `None` for English, because the sources hold its texts.
#[must_use]
pub fn table(language: Language) -> Option<&'static Table> {
    match language {
        Language::English => None,
        Language::German => Some(&GERMAN),
    }
}

/// Names of the placeholders of a text, e.g. `count` in `{count} layers`.
#[must_use]
pub fn placeholders(text: &str) -> BTreeSet<&str> {
    let parts = text.split('{').skip(1);
    let named = parts.filter_map(|part| part.split_once('}'));
    named.map(|(name, _)| name.split_once(':').map_or(name, |(name, _)| name)).collect()
}

thread_local! {
    static SPOKEN: Cell<Language> = const { Cell::new(Language::English) };
}

/// The language of the system, once the program has set it.
static SYSTEM: OnceLock<Language> = OnceLock::new();

/// Sets the language of the system. Call this once when the program starts. Libraries and tests do
/// not, so they speak English in any environment.
pub fn set_system(language: Language) {
    // Only the first call counts.
    let _ = SYSTEM.set(language);
}

/// Makes this thread speak the chosen language, or else the language of the system.
pub fn speak(chosen: Option<Language>) {
    let system = SYSTEM.get().copied().unwrap_or_default();
    SPOKEN.set(chosen.unwrap_or(system));
}

/// The language of this thread.
#[must_use]
pub fn spoken() -> Language {
    SPOKEN.get()
}

/// The text in the language of this thread, or the English text if the table lacks it. If a word
/// has several meanings, write its use before it. For example, `theme|Light` is `Light` in English.
#[must_use]
pub fn tr(english: &str) -> &str {
    translation(english)
        .unwrap_or_else(|| english.split_once('|').map_or(english, |(_, text)| text))
}

/// Marks an English text that we translate where we show it, so that you can find all texts to
/// translate in the sources. This returns the text itself.
#[must_use]
pub const fn english(text: &'static str) -> &'static str {
    text
}

/// The translation of a text; `None` in English, and if the table lacks it.
#[must_use]
pub fn translation(english: &str) -> Option<&'static str> {
    table(spoken())?.get(english).map(String::as_str)
}

/// Fills the placeholders of a translation: `{name}`, `{name:.1}` for a number of digits, and
/// `{name:+.1}` with a sign. A placeholder without a value stays as it is.
#[must_use]
pub fn filled(pattern: &str, values: &[(&str, &dyn Display)]) -> String {
    let mut text = String::new();
    let mut rest = pattern;
    while let Some((before, placeholder, after)) = next(rest) {
        text.push_str(before);
        let (name, form) = placeholder.split_once(':').unwrap_or((placeholder, ""));
        let value = values.iter().find(|(known, _)| *known == name);
        // Writing to a text cannot fail.
        let _ = match (value, form.strip_prefix('+').unwrap_or(form).strip_prefix('.')) {
            (Some((_, value)), digits) => {
                let digits = digits.and_then(|digits| digits.parse::<usize>().ok());
                match (digits, form.starts_with('+')) {
                    (Some(digits), true) => write!(text, "{value:+.digits$}"),
                    (Some(digits), false) => write!(text, "{value:.digits$}"),
                    (None, _) => write!(text, "{value}"),
                }
            }
            (None, _) => write!(text, "{{{placeholder}}}"),
        };
        rest = after;
    }
    text + rest
}

/// Splits a text at its first placeholder.
fn next(text: &str) -> Option<(&str, &str, &str)> {
    let (before, rest) = text.split_once('{')?;
    let (placeholder, after) = rest.split_once('}')?;
    Some((before, placeholder, after))
}

/// Patterns of the labels. A label has the first pattern that fits.
pub const PATTERNS: [&str; 34] = [
    "stroke on the palette, {brush}",
    "stroke, {brush}",
    "blend on the palette, {brush}",
    "blend, {brush}",
    "scrape on the palette, {brush}",
    "scrape, {brush}",
    "erase on the palette, {brush}",
    "erase, {brush}",
    "dry all",
    "dry {share} %",
    "other pigments",
    "light {light}",
    "gloss",
    "stiffness {value}",
    "no name for a layer",
    "name {name}",
    "show {layer}",
    "hide {layer}",
    "merge layer {number} with the one below",
    "merge two layers",
    "squeeze {paint} on the canvas",
    "squeeze {paint}",
    "mask by all paint",
    "mask by {layer}",
    "mask inverted",
    "mask off",
    "mask",
    "scrape the canvas",
    "scrape the palette",
    "swap",
    "{share} % of {layer}",
    "{layer} to place {number}",
    "{new} for {old}, {layer}",
    "layer {number}",
];

/// Patterns of the paint in a label.
pub const PAINTS: [&str; 2] = ["{first} and {second}", "{count} pigments"];

/// Words of the libraries that you see in the window: heads of brushes, tools of scenes, and names
/// in the labels of the history.
pub const WORDS: [&str; 17] = [
    "round",
    "flat",
    "filbert",
    "bright",
    "fan",
    "rigger",
    "mop",
    "knife",
    "Pour",
    "Push",
    "Lift",
    "Dry",
    "Wet",
    "wet paint",
    "medium",
    "paint",
    "Layer {number}",
];

/// The label of a layer without a name, e.g. `Layer 3`, in the language of this thread. If you have
/// named the layer, your name stays.
#[must_use]
pub fn layer_label(english: &str) -> String {
    const UNNAMED: &str = "Layer {number}";
    match (translation(UNNAMED), matched(UNNAMED, english).as_deref()) {
        (Some(pattern), Some([(name, number)])) if number.parse::<u32>().is_ok() => {
            filled(pattern, &[(name, number)])
        }
        _ => word(english).to_owned(),
    }
}

/// A word of the libraries in the language of this thread. Any other text stays as it is.
fn word(english: &str) -> &str {
    translation(english).filter(|_| WORDS.contains(&english)).unwrap_or(english)
}

/// The label of a brush in the list, in the language of this thread. This translates shapes, also
/// with a number. If you have named the brush, your name stays.
#[must_use]
pub fn brush_label(english: &str) -> String {
    match english.rsplit_once(' ') {
        Some((shape, number)) if number.parse::<u32>().is_ok() => {
            format!("{} {number}", word(shape))
        }
        _ => word(english).to_owned(),
    }
}

/// A label of the history in the language of this thread. If no pattern fits, it stays as it is.
#[must_use]
pub fn action_label(english: &str) -> String {
    for pattern in PATTERNS {
        let (Some(translated), Some(values)) = (translation(pattern), matched(pattern, english))
        else {
            continue;
        };
        let values: Vec<(&str, String)> =
            values.into_iter().map(|(name, value)| (name, value_text(name, value))).collect();
        let values: Vec<(&str, &dyn Display)> =
            values.iter().map(|(name, value)| (*name, value as &dyn Display)).collect();
        return filled(translated, &values);
    }
    english.to_owned()
}

/// A value of a label: a layer by its number, paint of several pigments, or a word with a
/// translation.
fn value_text(name: &str, value: &str) -> String {
    for pattern in PAINTS.iter().filter(|_| name == "paint") {
        if let (Some(translated), Some(parts)) = (translation(pattern), matched(pattern, value)) {
            let parts: Vec<(&str, &dyn Display)> =
                parts.iter().map(|(name, part)| (*name, part as &dyn Display)).collect();
            return filled(translated, &parts);
        }
    }
    match (matched("layer {number}", value).as_deref(), translation("layer {number}")) {
        (Some([(name, number)]), Some(pattern)) => filled(pattern, &[(name, number)]),
        _ => layer_label(&brush_label(value)),
    }
}

/// Values of the placeholders of `pattern` in `text`, each as short as possible. `None` if the
/// pattern does not fit.
fn matched<'a>(pattern: &'a str, text: &'a str) -> Option<Vec<(&'a str, &'a str)>> {
    let (before, rest) = pattern.split_once('{').unwrap_or((pattern, ""));
    let mut rest = rest;
    let mut text = text.strip_prefix(before)?;
    let mut values = Vec::new();
    while let Some((name, after)) = rest.split_once('}') {
        let (literal, next) = after.split_once('{').unwrap_or((after, ""));
        let end = if literal.is_empty() { text.len() } else { text.find(literal)? };
        values.push((name, &text[..end]));
        text = &text[end + literal.len()..];
        rest = next;
    }
    text.is_empty().then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Language, speak};

    #[test]
    fn the_first_name_that_is_not_empty_decides() {
        fn language(names: [&str; 3]) -> Language {
            Language::of_locales(names.map(|name| Some(name.to_owned()).filter(|_| name != "-")))
        }
        assert_eq!(language(["-", "-", "-"]), Language::English);
        assert_eq!(language(["-", "-", "de_AT.UTF-8"]), Language::German);
        assert_eq!(language(["", "de", "en_GB.UTF-8"]), Language::German);
        assert_eq!(language(["C", "de_DE", "de_DE"]), Language::English);
        assert_eq!(language(["-", "-", "den_CA"]), Language::English, "Slavey is not German");
    }

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

    #[test]
    fn a_thread_speaks_english_until_another_language_is_chosen_for_it() {
        assert_eq!(spoken(), Language::English);
        speak(Some(Language::German));
        assert_eq!(spoken(), Language::German);
        assert_eq!(std::thread::spawn(spoken).join().unwrap(), Language::English);
        speak(None);
        assert_eq!(spoken(), Language::English, "no program has set the language of the system");
    }

    #[test]
    fn placeholders_are_filled_in_any_order_and_with_digits() {
        let values: [(&str, &dyn Display); 3] = [("a", &1.25), ("b", &"paint"), ("c", &-0.5)];
        assert_eq!(filled("{b}: {a:.1}, {a:+.0}, {c:+.2}", &values), "paint: 1.2, +1, -0.50");
        assert_eq!(filled("{a} {d} {", &values), "1.25 {d} {");
    }

    #[test]
    fn a_text_without_a_translation_stays_english() {
        speak(Some(Language::German));
        assert_eq!((tr("Undo"), tr("no such text")), ("R\u{fc}ckg\u{e4}ngig", "no such text"));
        speak(None);
        assert_eq!(tr("Undo"), "Undo");
    }

    #[test]
    fn a_use_before_a_word_tells_its_meanings_apart() {
        assert_eq!((tr("theme|Light"), tr("Light")), ("Light", "Light"));
        speak(Some(Language::German));
        assert_eq!((tr("theme|Light"), tr("Light")), ("Hell", "Licht"));
    }

    #[test]
    fn values_are_formatted_in_both_languages() {
        let count = 3;
        let text = || tr_format!("{count} of {of} layers", count, of = 2 + 3);
        assert_eq!(text(), "3 of 5 layers");
        speak(Some(Language::German));
        assert_eq!(tr_format!("{count} volumes", count), "3 Farbvolumen");
        assert_eq!(text(), "3 of 5 layers", "the table has none");
    }

    #[test]
    fn labels_stay_english_in_english_and_where_no_pattern_fits() {
        assert_eq!(action_label("stroke, round"), "stroke, round");
        speak(Some(Language::German));
        assert_eq!(action_label("crop"), "crop");
        assert_eq!(action_label("masks"), "masks");
    }

    #[test]
    fn names_of_the_painter_stay_as_they_are() {
        speak(Some(Language::German));
        let layers = ["Layer 12", "Layer of sky", "a|b"].map(layer_label);
        assert_eq!(layers, ["Schicht 12", "Layer of sky", "a|b"]);
        let brushes = ["round", "fan 2", "old 3", "a|b"].map(brush_label);
        assert_eq!(brushes, ["Rundpinsel", "F\u{e4}cherpinsel 2", "old 3", "a|b"]);
    }

    #[test]
    fn labels_are_translated_by_their_pattern() {
        speak(Some(Language::German));
        for (label, wanted) in [
            ("stroke on the palette, my brush", "Strich auf der Palette, my brush"),
            ("stroke, a, b", "Strich, a, b"),
            ("dry 62.5 %", "62.5 % trocknen"),
            ("hide layer 3", "Schicht 3 ausblenden"),
            ("50 % of layer 1", "Schicht 1 zu 50 %"),
            ("Zinc White for Lead White, wet paint", "Zinc White statt Lead White, nasse Farbe"),
            ("squeeze Minium and Viridian", "Minium und Viridian ausdr\u{fc}cken"),
            ("name sky and sea", "Name sky and sea"),
            ("squeeze medium on the canvas", "Malmittel auf die Leinwand dr\u{fc}cken"),
        ] {
            assert_eq!(action_label(label), wanted, "{label}");
        }
    }
}
