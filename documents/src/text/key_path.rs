//! Paths of keys in a text, and where the values lie.

use std::fmt;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// One step to a value in TOML or JSON.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum KeyStep {
    /// Key of a table.
    Key(String),
    /// Index in a list, from 0.
    Index(usize),
}

/// The way from the whole text to a value.
///
/// ```
/// use documents::text::KeyPath;
///
/// let part = KeyPath::of("pour").index(1).key("recipe").key("B");
/// assert_eq!(part.to_string(), "[[pour]] 2, recipe.B");
/// assert_eq!(KeyPath::of("settings.motion.kick").to_string(), "settings.motion.kick");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct KeyPath(pub Vec<KeyStep>);

impl KeyPath {
    /// The path of keys that are joined by dots, e.g. `edges.strength`.
    #[must_use]
    pub fn of(keys: &str) -> Self {
        Self(keys.split('.').map(|key| KeyStep::Key(key.to_owned())).collect())
    }

    /// The path of `key` in the table at this path.
    #[must_use]
    pub fn key(&self, key: &str) -> Self {
        self.with(KeyStep::Key(key.to_owned()))
    }

    /// The path of the entry with `index`, from 0, of the list at this path.
    #[must_use]
    pub fn index(&self, index: usize) -> Self {
        self.with(KeyStep::Index(index))
    }

    /// The path of `other` in the table at this path.
    #[must_use]
    pub fn join(&self, other: &Self) -> Self {
        Self([&self.0[..], &other.0].concat())
    }

    fn with(&self, step: KeyStep) -> Self {
        let mut steps = self.0.clone();
        steps.push(step);
        Self(steps)
    }
}

impl fmt::Display for KeyPath {
    /// Writes keys joined by dots. Lists of tables stand in brackets, and we count entries from 1.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut after_entry = false;
        for (place, step) in self.0.iter().enumerate() {
            match step {
                KeyStep::Key(key) => {
                    let lead = match (place, after_entry) {
                        (0, _) => "",
                        (_, true) => ", ",
                        (_, false) => ".",
                    };
                    let of_tables = place == 0 && matches!(self.0.get(1), Some(KeyStep::Index(_)));
                    match of_tables {
                        true => write!(f, "{lead}[[{key}]]")?,
                        false => write!(f, "{lead}{key}")?,
                    }
                }
                KeyStep::Index(index) => write!(f, " {}", index + 1)?,
            }
            after_entry = matches!(step, KeyStep::Index(_));
        }
        Ok(())
    }
}

/// A value of a text and where it lies, in bytes.
#[derive(Debug)]
pub(super) struct Node {
    span: Range<usize>,
    inner: Inner,
}

#[derive(Debug)]
enum Inner {
    /// Keys with their places, and values.
    Table(Vec<(String, Range<usize>, Node)>),
    List(Vec<Node>),
    Plain,
}

impl Node {
    pub(super) fn of_toml(table: &Spanned<DeTable<'_>>) -> Self {
        Self { span: table.span(), inner: Inner::of_toml_table(table.get_ref()) }
    }

    /// The values of `text`, which is valid JSON.
    pub(super) fn of_json(text: &str) -> Self {
        JsonWalk { text: text.as_bytes(), at: 0 }.value()
    }

    /// Bytes of the value of a key at the top level.
    pub(super) fn value_span(&self, key: &str) -> Option<Range<usize>> {
        Some(self.entry(key)?.2.span.clone())
    }

    fn entry(&self, key: &str) -> Option<&(String, Range<usize>, Self)> {
        let Inner::Table(entries) = &self.inner else { return None };
        entries.iter().find(|(name, ..)| name == key)
    }

    /// The byte offset of the key at `path`. If the text does not have it, this is the last key on
    /// the way to it.
    pub(super) fn offset_of(&self, path: &KeyPath) -> usize {
        let mut offset = 0;
        let mut node = self;
        for step in &path.0 {
            let found = match (step, &node.inner) {
                (KeyStep::Key(key), _) => {
                    node.entry(key).map(|(_, span, value)| (span.start, value))
                }
                (KeyStep::Index(index), Inner::List(list)) => {
                    list.get(*index).map(|value| (value.span.start, value))
                }
                _ => None,
            };
            let Some((start, value)) = found else { break };
            offset = start;
            node = value;
        }
        offset
    }

    /// The path of the innermost key or value that holds these bytes.
    pub(super) fn path_at(&self, bytes: &Range<usize>) -> Option<KeyPath> {
        self.inner.path_at(&KeyPath::default(), bytes)
    }

    fn within(&self, path: KeyPath, bytes: &Range<usize>) -> Option<KeyPath> {
        let inner = self.inner.path_at(&path, bytes);
        inner.or_else(|| holds(&self.span, bytes).then_some(path))
    }
}

impl Inner {
    fn of_toml_table(table: &DeTable<'_>) -> Self {
        let entries = table.iter().map(|(key, value)| {
            (key.get_ref().clone().into_owned(), key.span(), Self::of_toml_value(value))
        });
        Self::Table(entries.collect())
    }

    fn of_toml_value(value: &Spanned<DeValue<'_>>) -> Node {
        let inner = match value.get_ref() {
            DeValue::Table(table) => Self::of_toml_table(table),
            DeValue::Array(list) => Self::List(list.iter().map(Self::of_toml_value).collect()),
            _ => Self::Plain,
        };
        Node { span: value.span(), inner }
    }

    // A table of TOML may reach over lines outside of its own span, so every value is searched.
    fn path_at(&self, path: &KeyPath, bytes: &Range<usize>) -> Option<KeyPath> {
        match self {
            Self::Table(entries) => entries.iter().find_map(|(key, span, value)| {
                let within = value.within(path.key(key), bytes);
                within.or_else(|| holds(span, bytes).then(|| path.key(key)))
            }),
            Self::List(list) => {
                let mut values = list.iter().enumerate();
                values.find_map(|(index, value)| value.within(path.index(index), bytes))
            }
            Self::Plain => None,
        }
    }
}

fn holds(span: &Range<usize>, bytes: &Range<usize>) -> bool {
    !bytes.is_empty() && span.start <= bytes.start && bytes.end <= span.end
}

/// Walks over valid JSON. On other text this ends early without a panic.
struct JsonWalk<'t> {
    text: &'t [u8],
    at: usize,
}

impl JsonWalk<'_> {
    fn value(&mut self) -> Node {
        self.skip_space();
        let start = self.at;
        let inner = match self.byte() {
            Some(b'{') => self.table(),
            Some(b'[') => self.list(),
            Some(b'"') => {
                self.string();
                Inner::Plain
            }
            _ => {
                while self.byte().is_some_and(|byte| !b",]} \t\r\n".contains(&byte)) {
                    self.at += 1;
                }
                Inner::Plain
            }
        };
        Node { span: start..self.at, inner }
    }

    fn table(&mut self) -> Inner {
        let mut entries = Vec::new();
        self.at += 1;
        while self.skip_to(b'"', b'}') {
            let start = self.at;
            self.string();
            let span = start..self.at;
            let key = self.text.get(span.clone()).unwrap_or_default();
            let key = serde_json::from_slice(key).unwrap_or_default();
            self.skip_space();
            self.at += 1;
            entries.push((key, span, self.value()));
        }
        Inner::Table(entries)
    }

    fn list(&mut self) -> Inner {
        let mut list = Vec::new();
        self.at += 1;
        loop {
            self.skip_space();
            match self.byte() {
                Some(b']') => {
                    self.at += 1;
                    break;
                }
                Some(b',') => self.at += 1,
                Some(_) => list.push(self.value()),
                None => break,
            }
        }
        Inner::List(list)
    }

    fn string(&mut self) {
        self.at += 1;
        while let Some(byte) = self.byte() {
            self.at += if byte == b'\\' { 2 } else { 1 };
            if byte == b'"' {
                break;
            }
        }
    }

    /// Moves to the next byte `wanted` and returns true. If `end` comes first, moves behind it and
    /// returns false.
    fn skip_to(&mut self, wanted: u8, end: u8) -> bool {
        while let Some(byte) = self.byte() {
            if byte == wanted {
                return true;
            }
            self.at += 1;
            if byte == end {
                break;
            }
        }
        false
    }

    fn skip_space(&mut self) {
        while self.byte().is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    fn byte(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::super::line_of;
    use super::*;

    const TOML: &str = "seconds = 6\n[[pour]]\nat = [0,\n  1]\n[[pour]]\nrecipe = { B = 2 }\n[pour.inner]\nx = 1\n";

    const JSON: &str = "{\"seconds\": 6,\n \"pour\":\n [{\"at\": [0,\n 1]}, {\n \"recipe\": {\"B\":\n 2, \"\\u0041\\\"\": \"}]\"\n}, \"inner\" : {\n\"x\": true } }]}";

    #[test]
    fn a_path_has_a_line_and_a_line_its_path() {
        let pour = KeyPath::of("pour");
        let [seconds, first] = [KeyPath::of("seconds"), pour.index(0)];
        let at = first.key("at").index(1);
        let recipe = pour.index(1).key("recipe");
        let inner = pour.index(1).key("inner").key("x");
        let places = [seconds, first, at, recipe.key("B"), inner];
        let toml = Node::of_toml(&DeTable::parse(TOML).unwrap());
        let json = Node::of_json(JSON);
        for (text, node, lines) in [(TOML, toml, [1, 2, 4, 6, 8]), (JSON, json, [1, 3, 4, 5, 8])] {
            for (path, line) in places.iter().zip(lines) {
                let offset = node.offset_of(path);
                assert_eq!(line_of(text, offset), line, "{path} in {text}");
                assert_eq!(node.path_at(&(offset..offset + 1)).as_ref(), Some(path), "{text}");
            }
            let missing = node.offset_of(&pour.index(1).key("radius"));
            assert_eq!(line_of(text, missing), if text == TOML { 5 } else { 4 });
        }
        let escaped = Node::of_json(JSON).offset_of(&recipe.key("A\""));
        assert_eq!(line_of(JSON, escaped), 6);
    }

    #[test]
    fn a_walk_over_broken_json_ends() {
        for end in 0..JSON.len() {
            let _ = Node::of_json(&JSON[..end]);
            let _ = Node::of_json(&JSON[end..]);
        }
    }
}
