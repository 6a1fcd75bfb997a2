//! Texts of settings that all techniques share: lines of a TOML file, and names of presets.

use toml::de::{DeTable, DeValue};

/// The line, counted from 1, of the byte `place` in `text`.
pub fn line_of(text: &str, place: usize) -> usize {
    let before = &text.as_bytes()[..place.min(text.len())];
    1 + before.iter().filter(|byte| **byte == b'\n').count()
}

/// The line, counted from 1, on which the value of `key` (`group.key`) starts in a TOML text; 1 if the
/// text does not have it.
pub fn line_of_value(text: &str, key: &str) -> usize {
    line_of(text, start_of(text, key).unwrap_or(0))
}

/// The byte at which the value of `group.key` starts.
fn start_of(text: &str, key: &str) -> Option<usize> {
    let table = DeTable::parse(text).ok()?;
    let mut parts = key.split('.');
    let mut value = table.get_ref().get(parts.next()?)?;
    for part in parts {
        let DeValue::Table(inner) = value.get_ref() else { return None };
        value = inner.get(part)?;
    }
    Some(value.span().start)
}

/// The way out for the `name` of a preset that there is not: a preset that is spelt like it, or all
/// of `presets`.
pub fn way_to_preset(name: &str, presets: &[&str]) -> String {
    crate::did_you_mean(name, presets.iter().copied()).unwrap_or_else(|| all_presets(presets))
}

/// The way out where settings cannot be read: the names of `presets`.
pub fn all_presets(presets: &[&str]) -> String {
    format!("presets are {}; a file of your own ends in .toml", presets.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_found_on_its_line() {
        let text = "a = 1\n[b]\n\nc = [\n 2,\n]\nd = 3\n";
        for (key, line) in [("a", 1), ("b.c", 4), ("b.d", 7), ("b.e", 1), ("a.b", 1)] {
            assert_eq!(line_of_value(text, key), line, "{key}");
        }
        assert_eq!([0, 5, 6, 999].map(|place| line_of(text, place)), [1, 1, 2, 8]);
    }

    #[test]
    fn a_misspelt_preset_is_told_with_the_one_that_is_meant() {
        let presets = ["portrait", "landscape", "sketch"];
        assert_eq!(way_to_preset("portrit", &presets), "did you mean portrait?");
        let all = "presets are portrait, landscape, sketch; a file of your own ends in .toml";
        assert_eq!(way_to_preset("xyz", &presets), all);
    }
}
