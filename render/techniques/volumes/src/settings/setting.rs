//! A setting as data: its key, its range, its unit and its meaning.

use std::fmt;

use toml::Value;

/// Values that a setting takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Takes {
    /// A number from the first to the second.
    Number(f32, f32),
    /// A whole number from the first to the second.
    Whole(u64, u64),
    /// A list of numbers from the first to the second.
    Numbers(f32, f32),
    /// One of these words.
    Words(&'static [&'static str]),
    /// `true` or `false`.
    Switch,
    /// A colour written `#rrggbb`.
    Color,
}

/// A setting: where it stands, the values that it takes, and what it does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Group and key: `motion.pressure`.
    pub key: &'static str,
    /// Values that it takes.
    pub takes: Takes,
    /// Unit of the numbers; empty for shares and words.
    pub unit: &'static str,
    /// Its meaning in a sentence.
    pub about: &'static str,
}

impl Setting {
    pub(super) const fn new(
        key: &'static str,
        takes: Takes,
        unit: &'static str,
        about: &'static str,
    ) -> Self {
        Self { key, takes, unit, about }
    }

    /// Whether the setting takes `value`.
    #[must_use]
    pub fn fits(&self, value: &Value) -> bool {
        let within = |value: &Value, least: f32, most: f32| {
            value.as_float().is_some_and(|number| (least..=most).contains(&(number as f32)))
        };
        match (self.takes, value) {
            (Takes::Number(least, most), value) => within(value, least, most),
            (Takes::Whole(least, most), Value::Integer(number)) => {
                u64::try_from(*number).is_ok_and(|number| (least..=most).contains(&number))
            }
            (Takes::Numbers(least, most), Value::Array(list)) => {
                list.iter().all(|value| within(value, least, most))
            }
            (Takes::Words(words), Value::String(word)) => words.contains(&word.as_str()),
            (Takes::Switch, Value::Boolean(_)) => true,
            (Takes::Color, Value::String(text)) => spectra::color::Rgb::from_hex(text).is_some(),
            _ => false,
        }
    }
}

impl fmt::Display for Takes {
    /// Writes the range as messages have it: `0 to 1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(least, most) => write!(f, "{least} to {most}"),
            Self::Whole(least, most) => write!(f, "a whole number from {least} to {most}"),
            Self::Numbers(least, most) => write!(f, "numbers from {least} to {most}"),
            Self::Words(words) => {
                let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                f.write_str(&quoted.join(", "))
            }
            Self::Switch => f.write_str("true or false"),
            Self::Color => f.write_str("a colour written #rrggbb"),
        }
    }
}
