//! Labels of actions in the history, which the session writes in English: they are recognised by
//! their pattern and translated where they are shown.

use std::fmt::Display;

use super::text::{filled, translation};

/// Patterns of the labels. The first that fits counts.
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

/// Words of the libraries that the window shows: heads of brushes, tools of scenes, and what the
/// labels of the history name.
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

/// The label of a layer that has no name, such as `Layer 3`, in the language that this thread
/// speaks. A name that the painter gave stays as it is.
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

/// A word of the libraries in the language that this thread speaks; another text stays as it is.
fn word(english: &str) -> &str {
    translation(english).filter(|_| WORDS.contains(&english)).unwrap_or(english)
}

/// The label of a brush in the list: that of its shape, also with a number, in the language that
/// this thread speaks. Another name that the painter gave stays as it is.
#[must_use]
pub fn brush_label(english: &str) -> String {
    match english.rsplit_once(' ') {
        Some((shape, number)) if number.parse::<u32>().is_ok() => {
            format!("{} {number}", word(shape))
        }
        _ => word(english).to_owned(),
    }
}

/// A label of the history in the language that this thread speaks. One that fits no pattern
/// stays as it is.
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

/// A value of a label: a layer by its number, paint of several pigments, or a word that has a
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

/// Values of the placeholders of a pattern that a text fits, each as short as possible.
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
