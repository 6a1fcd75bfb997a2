//! Settings from TOML, and what can be wrong with such a file.

use std::path::Path;

use spectra::color::Rgb;
use spectra::hint::{Explain, Hint};
use toml::de::{DeTable, DeValue};

use super::whole::Settings;

impl Settings {
    /// Reads a file; what it leaves out stays at the default.
    ///
    /// # Errors
    /// [`SettingsError`] with file, line and key.
    pub fn open(path: &Path) -> Result<Self, SettingsError> {
        let name = path.display().to_string();
        match std::fs::read_to_string(path) {
            Ok(text) => Self::from_toml(&name, &text),
            Err(error) => Err(SettingsError::Unreadable { name, reason: error.to_string() }),
        }
    }

    /// The same, of a file's text; `name` stands in errors.
    ///
    /// # Errors
    /// [`SettingsError`].
    pub fn from_toml(name: &str, text: &str) -> Result<Self, SettingsError> {
        let settings: Self = toml::from_str(text).map_err(|error| SettingsError::Line {
            name: name.to_owned(),
            line: line_of(text, error.span().map_or(0, |span| span.start)),
            reason: error.message().to_owned(),
        })?;
        settings.check(name, text)?;
        Ok(settings)
    }

    /// Whether all figures lie in their ranges and colours are such.
    fn check(&self, name: &str, text: &str) -> Result<(), SettingsError> {
        let line = |key| line_of(text, start_of(text, key).unwrap_or(0));
        if let Some(figure) = self.figures().into_iter().find(|figure| !figure.fits()) {
            return Err(SettingsError::Figure {
                name: name.to_owned(),
                line: line(figure.key),
                key: figure.key,
                least: figure.least,
                most: figure.most,
                // As the file has it: f32 does not hold every such number.
                value: figure.value as f32,
            });
        }
        let colors = [
            ("paper.colour", Some(&self.paper.color)),
            ("dry_brush.colour", self.dry_brush.color.as_ref()),
        ];
        for (key, text) in colors {
            if let Some(text) = text.filter(|text| Rgb::from_hex(text).is_none()) {
                let (name, text) = (name.to_owned(), text.clone());
                return Err(SettingsError::Color { name, line: line(key), key, text });
            }
        }
        Ok(())
    }
}

/// The line, counted from 1, of a place in `text`.
fn line_of(text: &str, place: usize) -> usize {
    let before = &text.as_bytes()[..place.min(text.len())];
    1 + before.iter().filter(|byte| **byte == b'\n').count()
}

/// Where the value of `group.key` starts.
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

/// Why a file holds no settings.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// No such file, or not text.
    #[error("{name}: {reason}")]
    Unreadable {
        /// The file.
        name: String,
        /// Why not.
        reason: String,
    },
    /// Not TOML, a key that is not known, or a value of another kind.
    #[error("{name}, line {line}: {reason}")]
    Line {
        /// The file.
        name: String,
        /// Counted from 1.
        line: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// A number out of its range.
    #[error("{name}, line {line}: {key} takes {least} to {most}, found `{value}`")]
    Figure {
        /// The file.
        name: String,
        /// Counted from 1.
        line: usize,
        /// Group and key.
        key: &'static str,
        /// The least.
        least: f64,
        /// The most.
        most: f64,
        /// What was given.
        value: f32,
    },
    /// No colour.
    #[error("{name}, line {line}: {key} is written #rrggbb, found `{text}`")]
    Color {
        /// The file.
        name: String,
        /// Counted from 1.
        line: usize,
        /// Group and key.
        key: &'static str,
        /// What was given.
        text: String,
    },
    /// No such preset.
    #[error("there is no preset `{name}`")]
    Preset {
        /// What was asked for.
        name: String,
    },
}

impl Explain for SettingsError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Unreadable { .. } | Self::Preset { .. } => {
                let names = super::Preset::ALL.map(super::Preset::name).join(", ");
                format!("presets are {names}; a file of your own ends in .toml")
            }
            Self::Line { .. } => {
                "start from a preset's file: there each key stands with its meaning".to_owned()
            }
            Self::Figure { key, .. } => {
                let value = Settings::default().figures().into_iter().find(|f| f.key == *key);
                let usual = value.map_or(0.0, |figure| figure.value as f32);
                format!("{usual} is usual")
            }
            Self::Color { .. } => "a warm white is \"#fbf9f4\"".to_owned(),
        }))
    }
}
