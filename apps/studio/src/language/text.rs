//! Texts in the language that the thread speaks.

use std::fmt::{Display, Write};

use super::current::spoken;
use super::table::table;

/// The text in the language that this thread speaks, or the English text itself where the table
/// of the language has none. A word of several meanings has its use before it, as in
/// `theme|Light`, which is shown as `Light` in English.
#[must_use]
pub fn tr(english: &str) -> &str {
    translation(english)
        .unwrap_or_else(|| english.split_once('|').map_or(english, |(_, text)| text))
}

/// An English text of a table, which is translated where it is shown: the same text, so that all
/// texts to translate can be found in the sources.
#[must_use]
pub const fn english(text: &'static str) -> &'static str {
    text
}

/// The translation of a text; `None` in English, and where the table of the language has none.
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

/// Formats a text with values in the language that this thread speaks, as
/// `tr_format!("{count} layers", count = layers.len())`. Every placeholder has a name, and every
/// name is listed after the text; a value of the same name needs no more. In English it is
/// `format!`, which checks the names while it is compiled.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Language, speak};

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
}
