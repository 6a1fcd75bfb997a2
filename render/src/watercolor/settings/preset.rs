//! Settings that come with the program.

use std::str::FromStr;

use super::file::SettingsError;
use super::whole::Settings;

/// A set of settings by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// Soft light, fine grain, edges that stay where they are.
    Portrait,
    /// Wet clouds on rough paper.
    Landscape,
    /// Few colours, strong edges, much bare paper.
    Sketch,
}

impl Preset {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Portrait, Self::Landscape, Self::Sketch];

    /// As the command line has it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Portrait => "portrait",
            Self::Landscape => "landscape",
            Self::Sketch => "sketch",
        }
    }

    /// Its file, a comment above each key.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Portrait => include_str!("../presets/portrait.toml"),
            Self::Landscape => include_str!("../presets/landscape.toml"),
            Self::Sketch => include_str!("../presets/sketch.toml"),
        }
    }

    /// What its file says.
    ///
    /// # Panics
    /// Never: a test reads all of them.
    #[must_use]
    pub fn settings(self) -> Settings {
        Settings::from_toml(self.name(), self.text()).expect("a preset is sound")
    }
}

impl FromStr for Preset {
    type Err = SettingsError;

    fn from_str(name: &str) -> Result<Self, SettingsError> {
        let found = Self::ALL.into_iter().find(|preset| preset.name() == name);
        found.ok_or_else(|| SettingsError::Preset { name: name.to_owned() })
    }
}
