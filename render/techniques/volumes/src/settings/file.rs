//! Settings from TOML.

use std::path::Path;
use std::str::FromStr;

use super::error::SettingsError;
use super::preset::Preset;
use super::whole::Settings;
use crate::toml_text::{KeyPath, Source, TextError, read_text};

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
        Self::from_toml(&path.display().to_string(), &read_text(path)?)
    }

    /// Parses the text of a settings file. Errors call the file `name`.
    ///
    /// # Errors
    /// [`SettingsError`] with line and key.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, SettingsError> {
        let source = Source::parse(name, text)?;
        let settings: Self = source.typed()?;
        let checked = settings.check(&KeyPath::default());
        checked.map_err(|fault| source.located(fault))?;
        Ok(settings)
    }

    /// Checks settings that were made by code.
    ///
    /// # Errors
    /// [`SettingsError`] for the first value that is out of its range.
    pub fn valid(&self) -> Result<(), SettingsError> {
        Ok(self.check(&KeyPath::default()).map_err(TextError::Invalid)?)
    }

    fn check(&self, base: &KeyPath) -> crate::toml_text::Checked {
        self.check_ranges(base)?;
        self.check_together(base)
    }
}
