//! Options for the style of a watercolor: a preset, a file of settings, single settings.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use watercolor::{Preset, Settings};

use crate::failure::{Failure, Result};
use crate::input::text;
use crate::setting_changes::changes;

#[derive(Debug, Args)]
#[command(next_help_heading = "Style")]
pub(super) struct StyleOptions {
    /// Preset of settings that ships with impasto [default: settings between the presets]
    #[arg(long, value_name = "NAME", value_parser = preset_names())]
    preset: Option<Preset>,
    /// Settings from a file (TOML); others keep the values of the preset
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    /// Change one setting, such as `edges.strength=2` or `paper.kind=rough`; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl StyleOptions {
    /// Reads the settings. Returns them with the paths of the files that they use.
    pub(super) fn settings(&self) -> Result<(Settings, Vec<PathBuf>)> {
        let mut settings = self.preset.map_or_else(Settings::default, Preset::settings);
        let mut inputs = Vec::new();
        if let Some(path) = &self.settings {
            let name = path.display().to_string();
            let text = text(path)?;
            let before = settings.clone();
            (settings.paper.scan, settings.toon.greys) = (None, None);
            settings = settings.changed(&name, &text)?;
            // Paths of pictures are relative to the settings file.
            let folder = path.parent().unwrap_or(Path::new(""));
            let beside = |named: Option<String>, before: Option<String>| {
                named.map(|file| folder.join(file).display().to_string()).or(before)
            };
            settings.paper.scan = beside(settings.paper.scan, before.paper.scan);
            settings.toon.greys = beside(settings.toon.greys, before.toon.greys);
            inputs.push(path.clone());
        }
        for change in changes(&self.set, "edges.strength=2")? {
            let changed = settings.changed(&change.name, &change.toml);
            settings = changed.map_err(|error| Failure::from(error).of_option())?;
        }
        let pictures = settings.paper.scan.iter().chain(&settings.toon.greys);
        inputs.extend(pictures.map(PathBuf::from));
        Ok((settings, inputs))
    }
}

/// Parses the name of a preset; an error lists the names.
pub(super) fn preset_names() -> impl TypedValueParser<Value = Preset> {
    let names = PossibleValuesParser::new(Preset::ALL.map(Preset::name));
    names.try_map(|name| name.parse::<Preset>())
}
