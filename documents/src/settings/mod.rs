//! Settings that you declare once.
//!
//! You write one row of [`settings!`](crate::settings!) for each setting, with field, type,
//! default, range, unit and meaning. The macro makes the documented struct, its default, the list
//! of rows, the check of ranges, the TOML file with comments, and the scaling with the size of a
//! picture. Presets ([`presets!`](crate::presets!)) are files with only the values that differ from
//! the default.
//!
//! ```
//! use documents::hint::Explain;
//!
//! documents::settings! {
//!     /// Pigment at the rim of a wash.
//!     pub struct EdgeSettings {
//!         strength: f32 = 3.0, Number(0.0, 10.0) => "What density gains at the rim";
//!         width_px: f32 = 1.0, Number(0.0, 20.0), "px", Length => "Width of the rim";
//!         color as "colour": Option<String> = None, Color => "Only washes of this colour", like "#506a8c";
//!     }
//! }
//!
//! documents::settings! {
//!     /// A style of watercolour.
//!     pub struct Settings: File {
//!         seed: u64 = 1, Any => "The same seed, the same picture";
//!         [edges]: EdgeSettings => "the rim of a wash";
//!     }
//! }
//!
//! let settings = Settings::from_toml("mine.toml", "[edges]\nstrength = 5")?;
//! assert_eq!((settings.edges.strength, settings.seed), (5.0, 1));
//! assert_eq!(settings.changed("here", "seed = 2")?.edges, settings.edges);
//!
//! let error = Settings::from_toml("mine.toml", "[edges]\nstrength = 11").unwrap_err();
//! assert_eq!(error.to_string(), "mine.toml, line 2: edges.strength takes 0 to 10, found `11`");
//! assert_eq!(error.hint().map(|hint| hint.to_string()).as_deref(), Some("3 is usual"));
//!
//! let text = "\
//! ## Mine
//!
//! ## The same seed, the same picture.
//! seed = 1
//!
//! [edges] # the rim of a wash
//! ## What density gains at the rim (0 to 10).
//! strength = 5.0
//! ## Width of the rim (px, 0 to 20).
//! width_px = 1.0
//! ## Only washes of this colour (a colour written #rrggbb).
//! ## colour = \"#506a8c\"
//! ";
//! assert_eq!(settings.documented("Mine"), text);
//! # Ok::<(), documents::settings::SettingsError>(())
//! ```

mod declared;

use std::fmt;
use std::str::FromStr;

use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::Value;

use crate::text::{Checked, KeyPath};

pub use declared::{
    OutOfRange, SettingsError, changed, changed_by, check, differences, digest, documented,
    guide_table, open, out_of_range, read as from_toml, rows,
};

/// A table of settings. The macro [`settings!`](crate::settings!) implements this.
pub trait Table: Serialize + DeserializeOwned + Default + Clone {
    /// The settings, in the order of a file.
    const ROWS: &'static [Row];

    /// Multiplies all lengths by `by`, and all areas by its square.
    fn scale(&mut self, by: f32);

    /// Checks that settings fit together. Faults name keys below `base`.
    ///
    /// # Errors
    /// The fault of a value that does not fit those beside it.
    fn check_together(&self, base: &KeyPath) -> Checked;

    /// The values of all settings in the order of [`rows`]. Only rows of numbers (`Number` and `Whole`) have a
    /// value here, all others `None`.
    fn numbers(&self) -> Vec<Option<f64>>;
}

/// Settings that ship under a name, which [`presets!`](crate::presets!) declares.
pub trait Preset: Copy + Send + Sync + FromStr<Err = SettingsError> + 'static {
    /// The settings that have this name.
    type Settings: Table;

    /// All presets, in the order in which programs list them.
    const ALL: &'static [Self];

    /// The name in lower case, which `parse` accepts.
    fn name(self) -> &'static str;

    /// The settings of the preset.
    fn settings(self) -> Self::Settings;

    /// The text of a TOML file of all settings of the preset, with a comment above each key.
    fn text(self) -> String;
}

/// One setting: its key, the values that it takes, and what it does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Key in its table.
    pub key: &'static str,
    /// Values that it takes.
    pub takes: Takes,
    /// Unit of the numbers. This is empty for shares and words.
    pub unit: &'static str,
    /// How it changes with the size of a picture.
    pub scales: Scales,
    /// Its meaning in a sentence without a full stop.
    pub about: &'static str,
    /// A value as you would write it, if you may leave the setting out.
    pub example: Option<&'static str>,
}

/// Values that a setting takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Takes {
    /// A number from the first to the second.
    Number(f64, f64),
    /// A whole number from the first to the second.
    Whole(u64, u64),
    /// Any whole number from 0 on, e.g. a seed.
    Any,
    /// One of these whole numbers.
    OneOf(&'static [u64]),
    /// A list of numbers from the first to the second.
    Numbers(f64, f64),
    /// One of these words.
    Words(&'static [&'static str]),
    /// Any text, e.g. a path.
    Text,
    /// A list of texts, such as names of pigments.
    Texts,
    /// `true` or `false`.
    Switch,
    /// A colour written `#rrggbb`.
    Color,
    /// A table in one line whose type checks itself, such as `{ kind = "linen" }`.
    Inline,
    /// A table of settings.
    Table(&'static [Row]),
}

/// How a setting changes if you make a picture larger.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scales {
    /// It does not change.
    #[default]
    No,
    /// It grows as the width of the picture.
    Length,
    /// It grows as the square of the width.
    Area,
}

impl Takes {
    /// Whether a setting takes `value`.
    #[must_use]
    pub fn fits(&self, value: &Value) -> bool {
        match (self, value) {
            (Self::Number(least, most), value) => is_within(value, *least, *most),
            (Self::Whole(least, most), Value::Integer(number)) => {
                u64::try_from(*number).is_ok_and(|number| (*least..=*most).contains(&number))
            }
            (Self::Any, Value::Integer(number)) => *number >= 0,
            (Self::OneOf(numbers), Value::Integer(number)) => {
                u64::try_from(*number).is_ok_and(|number| numbers.contains(&number))
            }
            (Self::Numbers(least, most), Value::Array(list)) => {
                list.iter().all(|value| is_within(value, *least, *most))
            }
            (Self::Words(words), Value::String(word)) => words.contains(&word.as_str()),
            (Self::Text, Value::String(_)) | (Self::Switch, Value::Boolean(_)) => true,
            (Self::Color, Value::String(text)) => is_color(text),
            (Self::Texts, Value::Array(list)) => list.iter().all(Value::is_str),
            (Self::Inline | Self::Table(_), Value::Table(_)) => true,
            _ => false,
        }
    }
}

impl fmt::Display for Takes {
    /// Writes the range for messages, e.g. `0 to 1`. Writes nothing if any value of the type will
    /// do.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(least, most) => write!(f, "{least} to {most}"),
            Self::Whole(least, most) => write!(f, "a whole number from {least} to {most}"),
            Self::OneOf(numbers) => {
                let texts: Vec<String> = numbers.iter().map(u64::to_string).collect();
                match &texts[..] {
                    [before @ .., last] if !before.is_empty() => {
                        write!(f, "{} or {last}", before.join(", "))
                    }
                    _ => f.write_str(&texts.join(", ")),
                }
            }
            Self::Numbers(least, most) => write!(f, "numbers from {least} to {most}"),
            Self::Words(words) => {
                let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                f.write_str(&quoted.join(", "))
            }
            Self::Color => f.write_str("a colour written #rrggbb"),
            Self::Texts => f.write_str("a list of texts"),
            Self::Any | Self::Text | Self::Switch | Self::Inline | Self::Table(_) => Ok(()),
        }
    }
}

/// Whether a number lies in a range. We compare a number of single precision with the digits that
/// we write, so that the ends of a range belong to it.
fn is_within(value: &Value, least: f64, most: f64) -> bool {
    value.as_float().is_some_and(|number| (least..=most).contains(&as_written(number)))
}

/// Gives a number of single precision the digits that it has in a file. Others stay as they are.
fn as_written(number: f64) -> f64 {
    let single = number as f32;
    if f64::from(single) != number {
        return number;
    }
    single.to_string().parse().unwrap_or(number)
}

/// Writes a value for a file. Numbers of single precision have their few digits.
#[must_use]
pub fn text_of(value: &Value) -> String {
    match value {
        Value::Float(number) => format!("{:?}", as_written(*number)).to_lowercase(),
        Value::Array(list) => {
            format!("[{}]", list.iter().map(text_of).collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}

/// Whether a text is a colour written `#rrggbb`.
#[must_use]
pub fn is_color(text: &str) -> bool {
    let digits = text.strip_prefix('#').unwrap_or_default();
    digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_a_range_are_taken_and_no_more() {
        let rate = Takes::Number(0.05, 0.067);
        for (value, wanted) in [(0.067_f32, true), (0.05, true), (0.067_000_01, false)] {
            assert_eq!(rate.fits(&Value::Float(f64::from(value))), wanted, "{value}");
        }
        let numbers = Takes::Numbers(0.0, 1.0);
        let words = Takes::Words(&["a", "b"]);
        for (takes, good, bad) in [
            (Takes::Number(0.0, 1.0), "1.0", "1.0000000001"),
            (Takes::Number(0.0, 1.0), "0.0", "nan"),
            (Takes::Whole(1, 4), "4", "5"),
            (Takes::Whole(0, 4), "0", "-1"),
            (Takes::Any, "9000000000", "-1"),
            (Takes::OneOf(&[1, 2, 4]), "2", "3"),
            (numbers, "[0.0, 1.0]", "[0.5, 1.5]"),
            (numbers, "[]", "0.5"),
            (words, "\"b\"", "\"c\""),
            (Takes::Text, "\"\"", "1"),
            (Takes::Switch, "false", "0"),
            (Takes::Texts, "[\"a\", \"b\"]", "[\"a\", 1]"),
            (Takes::Inline, "{ kind = \"linen\" }", "\"linen\""),
            (Takes::Color, "\"#fBf9f4\"", "\"#fbf9f\""),
            (Takes::Color, "\"#000000\"", "\"#00000\u{e9}\""),
        ] {
            let fits = [good, bad].map(|text| {
                let table: toml::Table = format!("a = {text}").parse().unwrap();
                takes.fits(&table["a"])
            });
            assert_eq!(fits, [true, false], "{takes:?}");
        }
        assert_eq!(Takes::OneOf(&[1, 2, 4]).to_string(), "1, 2 or 4");
        assert_eq!(words.to_string(), "\"a\", \"b\"");
    }

    #[test]
    fn numbers_have_the_digits_of_their_precision() {
        for (number, text) in [
            (f64::from(0.1_f32), "0.1"),
            (0.1, "0.1"),
            (0.123_456_789_012, "0.123456789012"),
            (3.0, "3.0"),
            (f64::NAN, "nan"),
            (f64::from(1e-4_f32), "0.0001"),
        ] {
            assert_eq!(text_of(&Value::Float(number)), text);
        }
    }
}
