//! Options for settings: a preset, a file, single settings.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use volumes::script::Script;
use volumes::settings::{Preset, SettingsError};

use crate::failure::{Failure, Result};
use crate::input::text;
use crate::setting_changes::changes;

#[derive(Debug, Args)]
#[command(next_help_heading = "Style")]
pub(super) struct SettingsOptions {
    /// Preset of settings that ships with impasto [default: that of the script, or sketch; with
    /// a LIBRARY and no script, grisaille]
    #[arg(long, value_name = "NAME", value_parser = preset_names())]
    preset: Option<Preset>,
    /// Settings from a file (TOML); others keep the values of the preset
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    /// Change one setting, such as `motion.microstructure=0.3`; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl SettingsOptions {
    /// Path of the file, if there is one.
    pub(super) fn input(&self) -> Option<&PathBuf> {
        self.settings.as_ref()
    }

    /// Changes the settings of a script. `usual` is the preset of a script that names none.
    pub(super) fn apply(&self, script: &mut Script, usual: Option<Preset>) -> Result<()> {
        script.preset = self.preset.or(script.preset).or(usual);
        if let Some(path) = &self.settings {
            let name = path.display().to_string();
            let text = text(path)?;
            script.change_settings(&name, &text)?;
        }
        for change in changes(&self.set, "motion.microstructure=0.3")? {
            let changed = script.change_settings(&change.name, &change.toml);
            changed.map_err(|error| Failure::from(error).of_option())?;
        }
        Ok(())
    }
}

/// Parses the name of a preset; an error lists the names.
pub(super) fn preset_names() -> impl TypedValueParser<Value = Preset> {
    let names = PossibleValuesParser::new(Preset::ALL.map(Preset::name));
    names.try_map(|name| name.parse::<Preset>().map_err(|error: SettingsError| error.to_string()))
}
