//! Settings from TOML, and the errors of such files.

use std::path::Path;
use std::str::FromStr;

use documents::ParserReason;
use documents::hint::{Explain, Fault, Hint};
use spectra::color::Rgb;

use super::preset::Preset;
use super::whole::Settings;
use documents::settings_text::{all_presets, line_of, line_of_value, way_to_preset};

impl Preset {
    /// The settings of the preset.
    ///
    /// # Panics
    /// Never: a test reads all presets.
    #[must_use]
    pub fn settings(self) -> Settings {
        Settings::from_toml(self.name(), self.text()).expect("a shipped preset is valid")
    }
}

impl FromStr for Preset {
    type Err = SettingsError;

    fn from_str(name: &str) -> Result<Self, SettingsError> {
        let found = Self::ALL.into_iter().find(|preset| preset.name() == name);
        found.ok_or_else(|| SettingsError::Preset { name: name.to_owned() })
    }
}

impl Settings {
    /// Reads a TOML file. Keys that it leaves out have the defaults.
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

    /// Parses the text of a settings file. Errors call the file `name`.
    ///
    /// # Errors
    /// [`SettingsError`] with line and key.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, SettingsError> {
        let settings: Self = toml::from_str(text).map_err(|error| {
            let line = line_of(text, error.span().map_or(0, |span| span.start));
            let ParserReason { reason, hint } = ParserReason::of(error.message());
            SettingsError::Line { name: name.to_owned(), line, reason, hint }
        })?;
        settings.check(name, text)?;
        Ok(settings)
    }

    /// Checks that all numbers are within their ranges and colours are written `#rrggbb`.
    fn check(&self, name: &str, text: &str) -> Result<(), SettingsError> {
        let line = |key| line_of_value(text, key);
        if let Some(figure) = self.figures().into_iter().find(|figure| !figure.fits()) {
            return Err(SettingsError::Figure {
                name: name.to_owned(),
                line: line(figure.key),
                key: figure.key,
                least: figure.least,
                most: figure.most,
                // As f32 the number prints as it is written in the file.
                value: figure.value as f32,
            });
        }
        let colors = [
            ("tones.dark", Some(&self.tones.dark)),
            ("toon.shadow_colour", Some(&self.toon.shadow_color)),
            ("paper.colour", Some(&self.paper.color)),
            ("dry_brush.colour", self.dry_brush.color.as_ref()),
        ];
        for (key, text) in colors {
            if let Some(text) = text.filter(|text| Rgb::from_hex(text).is_none()) {
                let name = name.to_owned();
                let text = text.clone();
                return Err(SettingsError::Color { name, line: line(key), key, text });
            }
        }
        Ok(())
    }
}

/// Settings cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// The file does not exist or is not text.
    #[error("{name}: {reason}")]
    Unreadable {
        /// Path of the file.
        name: String,
        /// Reason given by the system.
        reason: String,
    },
    /// The text is not TOML, or has an unknown key or a value of a wrong type.
    #[error("{name}, line {line}: {reason}")]
    Line {
        /// Name of the file.
        name: String,
        /// Line, counted from 1.
        line: usize,
        /// Reason of the parser.
        reason: String,
        /// The way out, where the reason gives one.
        hint: Option<String>,
    },
    /// A number is out of its range.
    #[error("{name}, line {line}: {key} takes {least} to {most}, found `{value}`")]
    Figure {
        /// Name of the file.
        name: String,
        /// Line, counted from 1.
        line: usize,
        /// Group and key: `wobble.amount_px`.
        key: &'static str,
        /// Smallest allowed value.
        least: f64,
        /// Largest allowed value.
        most: f64,
        /// Value in the file.
        value: f32,
    },
    /// A colour is not written `#rrggbb`.
    #[error("{name}, line {line}: {key} is written #rrggbb, found `{text}`")]
    Color {
        /// Name of the file.
        name: String,
        /// Line, counted from 1.
        line: usize,
        /// Group and key: `paper.colour`.
        key: &'static str,
        /// Text in the file.
        text: String,
    },
    /// There is no preset of this name.
    #[error("there is no preset `{name}`")]
    Preset {
        /// Name that was asked for.
        name: String,
    },
}

impl Explain for SettingsError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::verbatim(match self {
            Self::Preset { name } => way_to_preset(name, &Preset::ALL.map(Preset::name)),
            Self::Unreadable { .. } => all_presets(&Preset::ALL.map(Preset::name)),
            Self::Line { hint: Some(hint), .. } => hint.clone(),
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

    fn fault(&self) -> Fault {
        match self {
            Self::Unreadable { .. } => Fault::Environment,
            Self::Preset { .. } => Fault::Setting,
            _ => Fault::Input,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_preset_or_key_is_told_with_the_one_that_is_meant() {
        let unknown = "portrit".parse::<Preset>().unwrap_err();
        assert_eq!(unknown.hint().unwrap().to_string(), "did you mean portrait?");
        let unknown = Settings::from_toml("a.toml", "[edges]\nstrenght = 1").unwrap_err();
        assert_eq!(unknown.hint().unwrap().to_string(), "did you mean strength?");
        let unlike = Settings::from_toml("a.toml", "[edges]\nmoon = 1").unwrap_err();
        assert!(!unlike.hint().unwrap().to_string().contains("did you mean"), "{unlike}");
    }
}
