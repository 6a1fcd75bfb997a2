//! Options for settings: a preset, a file, single settings.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use painterly::{Preset, Settings};

use crate::failure::{Failure, Result};
use crate::input::text;
use crate::setting_changes::changes;

#[derive(Debug, Args)]
#[command(next_help_heading = "Style")]
pub(super) struct SettingsOptions {
    /// Preset of settings that ships with impasto [default: settings of their own]
    #[arg(long, value_name = "NAME", value_parser = preset_names())]
    preset: Option<Preset>,
    /// Settings from a file (TOML); others keep the values of the preset
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    /// Change one setting, such as `overlap.sharpness=8` or `colour.from=model`; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl SettingsOptions {
    /// Path of the file, if there is one.
    pub(super) fn input(&self) -> Option<&PathBuf> {
        self.settings.as_ref()
    }

    /// Name of the style that suits the preset.
    pub(super) fn style(&self) -> &'static str {
        self.preset.unwrap_or(Preset::Impressionist).style()
    }

    /// Reads the settings.
    pub(super) fn settings(&self) -> Result<Settings> {
        let mut settings = self.preset.map_or_else(Settings::default, Preset::settings);
        if let Some(path) = &self.settings {
            let name = path.display().to_string();
            let text = text(path)?;
            settings = settings.changed(&name, &text)?;
        }
        for change in changes(&self.set, "overlap.sharpness=8")? {
            let changed = settings.changed(&change.name, &change.toml);
            settings = changed.map_err(|error| Failure::from(error).of_option())?;
        }
        Ok(settings)
    }
}

/// Parses the name of a preset; an error lists the names.
pub(super) fn preset_names() -> impl TypedValueParser<Value = Preset> {
    let names = PossibleValuesParser::new(Preset::ALL.map(Preset::name));
    names.try_map(|name| name.parse::<Preset>())
}
