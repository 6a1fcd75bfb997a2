//! The macros that declare settings and presets.
//!
//! The functions that they call read settings from TOML and write them: whole files, changes of
//! single settings, and comments.

use std::path::Path;

use toml::{Table as Toml, Value};

use super::{Row, Table, Takes, as_written, text_of};
use crate::hint::Explain;
use crate::text::{
    Checked, KeyPath, KeyStep, Source, TextError, USUAL_HINT, ValueFault, read_text,
};
use crate::{did_you_mean, name_list};

/// Declares a table of settings. You write one row for each setting. [The
/// module](mod@crate::settings) has an example.
///
/// A row is
///
/// ```text
/// field as "key": type = default, Takes(limits), "unit", Scales => "Meaning", like "example";
/// ```
///
/// where
///
/// | part | holds |
/// | --- | --- |
/// | `as "key"` | the key in the file, if it is not the name of the field |
/// | `Takes(limits)` | a variant of [`Takes`](crate::settings::Takes) |
/// | `"unit"` | the unit of the numbers. Leave it out if there is none |
/// | `Scales` | `Length` or `Area` if the setting changes with the size of a picture |
/// | `"Meaning"` | a sentence without its full stop: the doc comment of the field and the comment in the file |
/// | `like "example"` | only with the type `Option<String>`: a value for the file's comment if there is none |
///
/// Write nested tables after the rows: `[field as "key"]: Type => "meaning";`.
///
/// Write `pub struct Name: File { .. }` for a whole file. You get the functions `open`,
/// `from_toml`, `changed`, `valid` and `documented`. If settings depend on each other, write
/// `File(path)`. The function at `path` checks them: it takes the settings and the
/// [`KeyPath`](crate::text::KeyPath) of their table.
///
/// Your crate must depend on `serde` with its derive macros.
#[macro_export]
macro_rules! settings {
    (
        $(#[doc = $doc:expr])*
        $visibility:vis struct $name:ident $(: $file:ident $(($check:path))?)? {
            $(
                $field:ident $(as $key:literal)? : $type:ty = $default:expr, $takes:ident $(($($limit:expr),* $(,)?))?
                    $(, $unit:literal $(, $scales:ident)?)? => $about:literal $(, like $example:literal)?;
            )*
            $(
                [$group:ident $(as $group_key:literal)?] : $table:ty => $group_about:literal;
            )*
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Debug, Clone, PartialEq, ::serde::Serialize, ::serde::Deserialize)]
        #[serde(deny_unknown_fields, default)]
        $visibility struct $name {
            $(
                #[doc = ::core::concat!($about, ".")]
                #[doc = ""]
                #[doc = $crate::settings!(@values $default, $takes $(($($limit),*))?; $($unit)?)]
                $(
                    #[doc = ::core::concat!("May be left out; such as `", $example, "`.")]
                    #[serde(skip_serializing_if = "::core::option::Option::is_none")]
                )?
                #[serde($(rename = $key)?)]
                pub $field: $type,
            )*
            $(
                #[doc = ::core::concat!("Table: ", $group_about, ".")]
                #[serde($(rename = $group_key)?)]
                pub $group: $table,
            )*
        }

        impl ::core::default::Default for $name {
            fn default() -> Self {
                Self {
                    $($field: $default,)*
                    $($group: <$table as ::core::default::Default>::default(),)*
                }
            }
        }

        impl $crate::settings::Table for $name {
            const ROWS: &'static [$crate::settings::Row] = &[
                $($crate::settings::Row {
                    key: $crate::settings!(@key $field $($key)?),
                    takes: $crate::settings::Takes::$takes $(($($limit),*))?,
                    unit: $crate::settings!(@unit $($unit)?),
                    scales: $crate::settings!(@scales $($($scales)?)?),
                    about: $about,
                    example: $crate::settings!(@example $($example)?),
                },)*
                $($crate::settings::Row {
                    key: $crate::settings!(@key $group $($group_key)?),
                    takes: $crate::settings::Takes::Table(<$table as $crate::settings::Table>::ROWS),
                    unit: "",
                    scales: $crate::settings::Scales::No,
                    about: $group_about,
                    example: ::core::option::Option::None,
                },)*
            ];

            fn scale(&mut self, by: f32) {
                let _ = by;
                $($crate::settings!(@scale self.$field, by, $($($scales)?)?);)*
                $($crate::settings::Table::scale(&mut self.$group, by);)*
            }

            fn check_together(&self, base: &$crate::text::KeyPath) -> $crate::text::Checked {
                let _ = base;
                $($crate::settings::Table::check_together(
                    &self.$group,
                    &base.key($crate::settings!(@key $group $($group_key)?)),
                )?;)*
                $($($check(self, base)?;)?)?
                ::core::result::Result::Ok(())
            }

            fn numbers(&self) -> ::std::vec::Vec<::core::option::Option<f64>> {
                let own: ::std::vec::Vec<::core::option::Option<f64>> =
                    ::std::vec![$($crate::settings!(@number self.$field, $takes)),*];
                [own, $($crate::settings::Table::numbers(&self.$group)),*].concat()
            }
        }

        $($crate::settings!(@$file $name);)?
    };

    (@File $name:ident) => {
        impl $name {
            /// Reads a TOML file. If you leave out a key, it has its default.
            pub fn open(path: &::std::path::Path) -> ::core::result::Result<Self, $crate::settings::SettingsError> {
                $crate::settings::open(path)
            }

            /// Parses the text of a file of settings, which errors call `name`.
            pub fn from_toml(name: &str, text: &str) -> ::core::result::Result<Self, $crate::settings::SettingsError> {
                $crate::settings::from_toml(name, text)
            }

            /// A copy of these settings with the values of `text` (TOML), which errors call `name`.
            ///
            /// # Errors
            /// [`SettingsError`]($crate::settings::SettingsError) if the text is not TOML, a key is
            /// unknown, or a value is out of its range.
            pub fn changed(&self, name: &str, text: &str) -> ::core::result::Result<Self, $crate::settings::SettingsError> {
                $crate::settings::changed(self, name, text)
            }

            /// Checks settings that you made by code.
            pub fn valid(&self) -> ::core::result::Result<(), $crate::settings::SettingsError> {
                let checked = $crate::settings::check(self, &$crate::text::KeyPath::default());
                ::core::result::Result::Ok(checked.map_err($crate::text::TextError::Invalid)?)
            }

            /// The text of a TOML file of these settings: `title` as a comment, then each key below
            /// its meaning, unit and range. If you read it, you get the same settings to the bit.
            #[must_use]
            pub fn documented(&self, title: &str) -> ::std::string::String {
                $crate::settings::documented(self, title)
            }
        }
    };

    (@key $field:ident) => { ::core::stringify!($field) };
    (@key $field:ident $key:literal) => { $key };
    (@unit) => { "" };
    (@unit $unit:literal) => { $unit };
    (@scales) => { $crate::settings::Scales::No };
    (@scales $scales:ident) => { $crate::settings::Scales::$scales };
    (@example) => { ::core::option::Option::None };
    (@example $example:literal) => { ::core::option::Option::Some($example) };
    (@number $value:expr, Number) => { ::core::option::Option::Some($value as f64) };
    (@number $value:expr, Whole) => { ::core::option::Option::Some($value as f64) };
    (@number $value:expr, $takes:ident) => { ::core::option::Option::None };
    (@scale $value:expr, $by:expr,) => {};
    (@scale $value:expr, $by:expr, Length) => { $value *= $by };
    (@scale $value:expr, $by:expr, Area) => { $value *= $by * $by };

    (@values $default:expr, Number($least:expr, $most:expr); $($unit:literal)?) => {
        ::core::concat!(
            "From `", ::core::stringify!($least), "` to `", ::core::stringify!($most), "`", $(" ", $unit,)?
            "; `", ::core::stringify!($default), "` by default."
        )
    };
    (@values $default:expr, Whole($least:expr, $most:expr); $($unit:literal)?) => {
        $crate::settings!(@values $default, Number($least, $most); $($unit)?)
    };
    (@values $default:expr, Numbers($least:expr, $most:expr); $($unit:literal)?) => {
        $crate::settings!(@values $default, Number($least, $most); $($unit)?)
    };
    (@values $default:expr, Color; $($unit:literal)?) => {
        ::core::concat!("A colour written `#rrggbb`; `", ::core::stringify!($default), "` by default.")
    };
    (@values $default:expr, $takes:ident $(($($limit:expr),*))?; $($unit:literal)?) => {
        ::core::concat!("By default `", ::core::stringify!($default), "`.")
    };
}

/// Declares the presets of a file of settings as an enum. Give each variant a name, a file with the
/// values that differ from the default, and a sentence.
///
/// ```text
/// documents::presets! {
///     /// A shipped style with a name.
///     pub enum Preset of Settings {
///         Portrait = "portrait", "presets/portrait.toml" => "Portrait: soft light and fine grain.";
///     }
/// }
/// ```
///
/// You get `ALL`, `name`, `about`, `settings`, `changes` (the text of the file), `text` (all
/// settings with comments) and `FromStr`.
#[macro_export]
macro_rules! presets {
    (
        $(#[doc = $doc:expr])*
        $visibility:vis enum $name:ident of $settings:ident {
            $($variant:ident = $word:literal, $file:literal => $about:literal;)*
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, ::serde::Serialize, ::serde::Deserialize)]
        $visibility enum $name {
            $(
                #[doc = $about]
                #[serde(rename = $word)]
                $variant,
            )*
        }

        impl $name {
            /// All presets, in the order in which programs list them.
            pub const ALL: [Self; Self::NAMES.len()] = [$(Self::$variant),*];

            const NAMES: &'static [&'static str] = &[$($word),*];

            /// The name in lower case. You can `parse` it.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $word,)* }
            }

            /// A sentence on the style.
            #[must_use]
            pub fn about(self) -> &'static str {
                match self { $(Self::$variant => $about,)* }
            }

            /// The values that differ from the default, as TOML.
            #[must_use]
            pub fn changes(self) -> &'static str {
                match self { $(Self::$variant => ::core::include_str!($file),)* }
            }

            /// The settings of the preset.
            #[must_use]
            pub fn settings(self) -> $settings {
                $settings::from_toml(self.name(), self.changes()).expect("a shipped preset is valid")
            }

            /// The text of a TOML file of all settings of the preset, with a comment above each key.
            #[must_use]
            pub fn text(self) -> ::std::string::String {
                $crate::settings::documented(&self.settings(), self.about())
            }
        }

        impl $crate::settings::Preset for $name {
            type Settings = $settings;

            const ALL: &'static [Self] = &Self::ALL;

            fn name(self) -> &'static str {
                self.name()
            }

            fn settings(self) -> $settings {
                self.settings()
            }

            fn text(self) -> ::std::string::String {
                self.text()
            }
        }

        impl ::core::str::FromStr for $name {
            type Err = $crate::settings::SettingsError;

            fn from_str(name: &str) -> ::core::result::Result<Self, Self::Err> {
                let found = Self::ALL.into_iter().find(|preset| preset.name() == name);
                found.ok_or_else(|| $crate::settings::SettingsError::Preset {
                    name: name.to_owned(),
                    known: Self::NAMES,
                })
            }
        }
    };
}

/// Longest line of a comment.
const WIDTH: usize = 90;

/// We cannot read settings.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum SettingsError {
    /// The text has a fault.
    #[error(transparent)]
    Text(#[from] TextError),
    /// There is no preset of this name.
    #[error("there is no preset `{name}`")]
    #[hint(verbatim, "{}", way_to_preset(name, known))]
    #[fault(Setting)]
    Preset {
        /// Name that you asked for.
        name: String,
        /// Names of all presets.
        known: &'static [&'static str],
    },
}

fn way_to_preset(name: &str, known: &[&str]) -> String {
    did_you_mean(name, known.iter().copied()).unwrap_or_else(|| {
        let names = name_list(known, known.len(), ", ");
        format!("presets are {names}; a file of your own ends in .toml")
    })
}

/// Reads a TOML file. If you leave out a key, it has its default.
pub fn open<T: Table>(path: &Path) -> Result<T, SettingsError> {
    read(&path.display().to_string(), &read_text(path)?)
}

/// Parses the text of a file of settings, which errors call `name`.
pub fn read<T: Table>(name: &str, text: &str) -> Result<T, SettingsError> {
    let source = Source::toml(name, text)?;
    let settings: T = typed(&source)?;
    check(&settings, &KeyPath::default()).map_err(|fault| source.located(fault))?;
    Ok(settings)
}

/// A copy of `settings` with the values of `text` (TOML), which errors call `name`.
///
/// # Errors
/// [`SettingsError`] if the text is not TOML, a key is unknown, or a value is out of its range.
pub fn changed<T: Table>(settings: &T, name: &str, text: &str) -> Result<T, SettingsError> {
    let source = Source::toml(name, text)?;
    // The text is read alone first, so that errors give its lines and keys.
    typed::<T>(&source)?;
    let changed = changed_by(settings, &source.typed()?, &KeyPath::default());
    Ok(changed.map_err(|fault| source.located(fault))?)
}

/// A copy of `settings` with the values of `changes`. Faults name keys below `base`.
///
/// # Errors
/// The fault of the first value that does not fit.
pub fn changed_by<T: Table>(
    settings: &T,
    changes: &Toml,
    base: &KeyPath,
) -> Result<T, Box<ValueFault>> {
    let mut all = toml_of(settings, base)?;
    merge(&mut all, changes, T::ROWS);
    let whole: Result<T, toml::de::Error> = all.try_into();
    let changed = whole.map_err(|error| {
        let hint = "a preset's file has each key with its meaning";
        ValueFault::new(base, "keys and values of settings", error.message(), hint)
    })?;
    check(&changed, base)?;
    Ok(changed)
}

/// Replaces the keys of `changes`. Only tables of settings are merged key by key.
fn merge(all: &mut Toml, changes: &Toml, rows: &[Row]) {
    for (key, change) in changes {
        let takes = rows.iter().find(|row| row.key == key.as_str()).map(|row| row.takes);
        match (all.get_mut(key), change, takes) {
            (Some(Value::Table(all)), Value::Table(changes), Some(Takes::Table(rows))) => {
                merge(all, changes, rows);
            }
            (_, change, _) => {
                all.insert(key.clone(), change.clone());
            }
        }
    }
}

/// Checks that every value is in its range, and that values fit together. Faults name keys below
/// `base`.
///
/// # Errors
/// The fault of the first value that does not fit.
pub fn check<T: Table>(settings: &T, base: &KeyPath) -> Checked {
    let usual = toml_of(&T::default(), base)?;
    check_rows(T::ROWS, &toml_of(settings, base)?, &usual, base)?;
    settings.check_together(base)
}

fn check_rows(rows: &[Row], table: &Toml, usual: &Toml, base: &KeyPath) -> Checked {
    for row in rows {
        let Some(value) = table.get(row.key) else { continue };
        let key = base.key(row.key);
        let usual = usual.get(row.key);
        if let (Takes::Table(rows), Value::Table(table), Some(Value::Table(usual))) =
            (row.takes, value, usual)
        {
            check_rows(rows, table, usual, &key)?;
        } else if !row.takes.fits(value) {
            let usual = usual.map(plain).or(row.example.map(str::to_owned)).unwrap_or_default();
            let wanted = row.takes.to_string();
            return Err(ValueFault::new(&key, wanted, plain(value), format!("{usual} is usual")));
        }
    }
    Ok(())
}

/// A number that lies outside of its range.
#[derive(Debug, Clone, PartialEq)]
pub struct OutOfRange {
    /// Path of the setting, such as `edges.strength`.
    pub key: String,
    /// Its row.
    pub row: &'static Row,
    /// Its value.
    pub value: f64,
    /// The least value that it takes.
    pub least: f64,
    /// The greatest value that it takes.
    pub most: f64,
}

/// The first number of `settings` that lies outside of its range. Use this to write your own error.
/// [`check`] also finds other faults.
#[must_use]
pub fn out_of_range<T: Table>(settings: &T) -> Option<OutOfRange> {
    let all = rows::<T>().into_iter().zip(settings.numbers());
    all.filter_map(|((key, row), value)| Some((key, row, value?))).find_map(|(key, row, value)| {
        let (least, most) = match row.takes {
            Takes::Number(least, most) => (least, most),
            Takes::Whole(least, most) => (least as f64, most as f64),
            _ => return None,
        };
        let fits = (least..=most).contains(&as_written(value));
        (!fits).then_some(OutOfRange { key, row, value, least, most })
    })
}

/// Formats a value for a message: whole numbers without a decimal point, texts without quotes.
fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Float(number) => as_written(*number).to_string(),
        other => text_of(other),
    }
}

/// Reads the whole text as settings. If the parser gives no hint, ours names the usual value.
fn typed<T: Table>(source: &Source<'_>) -> Result<T, TextError> {
    source.typed().map_err(|mut error| {
        if let TextError::Syntax { key: Some(key), hint, .. } = &mut error
            && **hint == *USUAL_HINT
        {
            let all = Value::Table(Toml::try_from(T::default()).unwrap_or_default());
            let usual = key.0.iter().try_fold(&all, |value, step| match step {
                KeyStep::Key(key) => value.get(key),
                KeyStep::Index(_) => None,
            });
            if let Some(usual) = usual.filter(|usual| !usual.is_table()) {
                *hint = format!("{} is usual", plain(usual)).into();
            }
        }
        error
    })
}

/// The settings as a table of TOML. This fails for whole numbers that are too large for TOML.
fn toml_of<T: Table>(settings: &T, base: &KeyPath) -> Result<Toml, Box<ValueFault>> {
    Toml::try_from(settings).map_err(|error| {
        ValueFault::new(base, "values of TOML", error, "whole numbers reach to 2^63 - 1")
    })
}

/// The text of a TOML file of these settings: `title` as a comment, then each key below its
/// meaning, unit and range. If you read it, you get the same settings to the bit.
#[must_use]
pub fn documented<T: Table>(settings: &T, title: &str) -> String {
    let mut text = comment(title);
    let table = Toml::try_from(settings).unwrap_or_default();
    document_rows(&mut text, T::ROWS, &table, "");
    text
}

fn document_rows(text: &mut String, rows: &[Row], table: &Toml, path: &str) {
    for row in rows {
        let value = table.get(row.key);
        if let Takes::Table(rows) = row.takes {
            let path =
                if path.is_empty() { row.key.to_owned() } else { format!("{path}.{}", row.key) };
            let about =
                if row.about.is_empty() { String::new() } else { format!(" # {}", row.about) };
            text.push_str(&format!("\n[{path}]{about}\n"));
            let nothing = Toml::new();
            document_rows(text, rows, value.and_then(Value::as_table).unwrap_or(&nothing), &path);
            continue;
        }
        if path.is_empty() {
            text.push('\n');
        }
        text.push_str(&comment(&meaning(row)));
        match (value, row.example) {
            (Some(value), _) => text.push_str(&format!("{} = {}\n", row.key, text_of(value))),
            (None, Some(example)) => text.push_str(&format!("# {} = \"{example}\"\n", row.key)),
            (None, None) => {}
        }
    }
}

/// Meaning, unit and range of a setting in a sentence.
fn meaning(row: &Row) -> String {
    let range = row.takes.to_string();
    let both: Vec<&str> = [row.unit, &range].into_iter().filter(|text| !text.is_empty()).collect();
    match both.is_empty() {
        true => format!("{}.", row.about),
        false => format!("{} ({}).", row.about, both.join(", ")),
    }
}

/// Breaks `text` into lines of a comment.
fn comment(text: &str) -> String {
    let mut lines = String::new();
    let mut line = "#".to_owned();
    for word in text.split_whitespace() {
        if line.len() + 1 + word.len() > WIDTH {
            lines.push_str(&line);
            lines.push('\n');
            line = "#".to_owned();
        }
        line.push(' ');
        line.push_str(word);
    }
    format!("{lines}{line}\n")
}

/// The lines of TOML that turn `base` into `settings`.
#[must_use]
pub fn differences<T: Table>(settings: &T, base: &T) -> String {
    let [own, base] = [settings, base].map(|table| Toml::try_from(table).unwrap_or_default());
    let mut text = String::new();
    difference_rows(&mut text, T::ROWS, &own, &base, "");
    text
}

fn difference_rows(text: &mut String, rows: &[Row], own: &Toml, base: &Toml, path: &str) {
    for row in rows {
        let key = if path.is_empty() { row.key.to_owned() } else { format!("{path}.{}", row.key) };
        match (row.takes, own.get(row.key), base.get(row.key)) {
            (Takes::Table(rows), Some(Value::Table(own)), Some(Value::Table(base))) => {
                difference_rows(text, rows, own, base, &key);
            }
            (_, Some(own), base) if Some(own) != base => {
                text.push_str(&format!("{key} = {}\n", text_of(own)));
            }
            _ => {}
        }
    }
}

/// Every setting with its path, e.g. `edges.strength`, in the order of a file.
#[must_use]
pub fn rows<T: Table>() -> Vec<(String, &'static Row)> {
    let mut all = Vec::new();
    collect_rows(&mut all, T::ROWS, "");
    all
}

fn collect_rows(all: &mut Vec<(String, &'static Row)>, rows: &'static [Row], path: &str) {
    for row in rows {
        let key = if path.is_empty() { row.key.to_owned() } else { format!("{path}.{}", row.key) };
        match row.takes {
            Takes::Table(rows) => collect_rows(all, rows, &key),
            _ => all.push((key, row)),
        }
    }
}

/// All settings as a table in Markdown for guides: key, default, values, meaning.
#[must_use]
pub fn guide_table<T: Table>() -> String {
    let usual = Toml::try_from(T::default()).unwrap_or_default();
    let mut text = "| key | default | takes | meaning |\n| --- | --- | --- | --- |\n".to_owned();
    for (path, row) in rows::<T>() {
        let mut value = Some(&usual).and_then(|table| table.get(path.split('.').next()?));
        for key in path.split('.').skip(1) {
            value = value.and_then(|value| value.get(key));
        }
        let value = value.map_or(String::new(), |value| format!("`{}`", text_of(value)));
        let range = row.takes.to_string();
        let takes: Vec<&str> =
            [row.unit, &range].into_iter().filter(|text| !text.is_empty()).collect();
        let takes = takes.join(", ");
        text.push_str(&format!("| `{path}` | {value} | {takes} | {} |\n", row.about));
    }
    text
}

/// A number that changes if you change any bit of the settings: FNV-1a (Fowler, Noll and Vo 1991)
/// of all values in the order of their keys. Tests hold presets to this number.
#[must_use]
pub fn digest<T: Table>(settings: &T) -> u64 {
    let mut lines = Vec::new();
    digest_lines(&mut lines, "", &Value::Table(Toml::try_from(settings).unwrap_or_default()));
    lines.sort();
    lines.join("\n").bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte: u8| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

fn digest_lines(lines: &mut Vec<String>, path: &str, value: &Value) {
    let Value::Table(table) = value else {
        lines.push(format!("{path}={}", bits(value)));
        return;
    };
    for (key, value) in table {
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        digest_lines(lines, &path, value);
    }
}

/// Writes a value as text that shows every bit.
fn bits(value: &Value) -> String {
    match value {
        Value::Float(number) if f64::from(*number as f32) == *number => {
            format!("{:08x}", (*number as f32).to_bits())
        }
        Value::Float(number) => format!("{:016x}", number.to_bits()),
        Value::String(text) => text.clone(),
        Value::Array(list) => format!("[{}]", list.iter().map(bits).collect::<Vec<_>>().join(",")),
        other => other.to_string(),
    }
}
