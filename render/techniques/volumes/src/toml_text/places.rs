//! Places of values in a text of TOML.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::key_path::{KeyPath, KeyStep};

/// The line, counted from 1, of a byte offset in `text`.
pub(super) fn line_of(text: &str, offset: usize) -> usize {
    let before = &text.as_bytes()[..offset.min(text.len())];
    1 + before.iter().filter(|byte| **byte == b'\n').count()
}

/// The byte offset of the key at `path`, or of the last key on the way that the text has.
pub(super) fn offset_of(table: &Spanned<DeTable<'_>>, path: &KeyPath) -> usize {
    let mut offset = 0;
    let mut table = Some(table.get_ref());
    let mut list = None;
    for step in &path.0 {
        let value = match step {
            KeyStep::Key(key) => {
                let entry = table.and_then(|table| table.get_key_value(key.as_str()));
                entry.map(|(key, value)| (key.span().start, value))
            }
            KeyStep::Index(index) => {
                let value = list.and_then(|list: &toml::de::DeArray<'_>| list.get(*index));
                value.map(|value| (value.span().start, value))
            }
        };
        let Some((start, value)) = value else { break };
        offset = start;
        table = value.get_ref().as_table();
        list = value.get_ref().as_array();
    }
    offset
}

/// The path of the innermost key or value whose text holds these bytes.
pub(super) fn path_at(table: &Spanned<DeTable<'_>>, bytes: &Range<usize>) -> Option<KeyPath> {
    in_table(table.get_ref(), &KeyPath::default(), bytes)
}

fn in_table(table: &DeTable<'_>, path: &KeyPath, bytes: &Range<usize>) -> Option<KeyPath> {
    // A table may reach over lines outside of its own span, so every value is searched.
    table.iter().find_map(|(key, value)| {
        in_value(value, &path.key(key.get_ref()), bytes)
            .or_else(|| holds(&key.span(), bytes).then(|| path.key(key.get_ref())))
    })
}

fn in_value(value: &Spanned<DeValue<'_>>, path: &KeyPath, bytes: &Range<usize>) -> Option<KeyPath> {
    let inner = match value.get_ref() {
        DeValue::Table(table) => in_table(table, path, bytes),
        DeValue::Array(list) => {
            let mut values = list.iter().enumerate();
            values.find_map(|(index, value)| in_value(value, &path.index(index), bytes))
        }
        _ => None,
    };
    inner.or_else(|| holds(&value.span(), bytes).then(|| path.clone()))
}

fn holds(span: &Range<usize>, bytes: &Range<usize>) -> bool {
    !bytes.is_empty() && span.start <= bytes.start && bytes.end <= span.end
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "seconds = 6\n[[pour]]\nat = [0,\n  1]\n[[pour]]\nrecipe = { B = 2 }\n[pour.inner]\nx = 1\n";

    #[test]
    fn a_path_has_a_line_and_a_line_its_path() {
        let table = DeTable::parse(TEXT).unwrap();
        let pour = KeyPath::of("pour");
        for (path, line) in [
            (KeyPath::of("seconds"), 1),
            (pour.index(0), 2),
            (pour.index(0).key("at").index(1), 4),
            (pour.index(1).key("recipe").key("B"), 6),
            (pour.index(1).key("inner").key("x"), 8),
        ] {
            let offset = offset_of(&table, &path);
            assert_eq!(line_of(TEXT, offset), line, "{path}");
            assert_eq!(path_at(&table, &(offset..offset + 1)), Some(path.clone()), "{path}");
        }
        let missing = offset_of(&table, &pour.index(1).key("radius"));
        assert_eq!(line_of(TEXT, missing), 5);
    }
}
