//! Paths of keys in TOML.

use std::fmt;

/// One step to a value in TOML.
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
/// use volumes::toml_text::KeyPath;
///
/// let part = KeyPath::of("pour").index(1).key("recipe").key("B");
/// assert_eq!(part.to_string(), "[[pour]] 2, recipe.B");
/// assert_eq!(KeyPath::of("settings.motion.kick").to_string(), "settings.motion.kick");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct KeyPath(pub Vec<KeyStep>);

impl KeyPath {
    /// The path with these keys, which are joined by dots.
    #[must_use]
    pub fn of(keys: &str) -> Self {
        Self(keys.split('.').map(|key| KeyStep::Key(key.to_owned())).collect())
    }

    /// The value of `key` in the table at this path.
    #[must_use]
    pub fn key(&self, key: &str) -> Self {
        self.with(KeyStep::Key(key.to_owned()))
    }

    /// The entry with `index`, from 0, of the list at this path.
    #[must_use]
    pub fn index(&self, index: usize) -> Self {
        self.with(KeyStep::Index(index))
    }

    /// The value of `other` in the table at this path.
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
    /// Writes keys joined by dots; lists of tables stand in brackets, and entries count from 1.
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
