//! The style of a watercolor: a preset, a file of settings, single settings.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use render::watercolor::{Preset, Settings, SettingsError};

use crate::failure::{Failure, Result};

#[derive(Debug, Args)]
#[command(next_help_heading = "Look")]
pub(super) struct StyleOptions {
    /// Settings that come with impasto [default: those between]
    #[arg(long, value_name = "NAME", value_parser = preset_names())]
    preset: Option<Preset>,
    /// Settings from a file (TOML); what it leaves out stays as the preset has it
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    /// Change one setting, as `edges.strength=2` or `paper.kind=rough`; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl StyleOptions {
    /// The settings, and the files they were read from.
    pub(super) fn settings(&self) -> Result<(Settings, Vec<PathBuf>)> {
        let mut settings = self.preset.map_or_else(Settings::default, Preset::settings);
        let mut inputs = Vec::new();
        if let Some(path) = &self.settings {
            let name = path.display().to_string();
            let text = std::fs::read_to_string(path).map_err(|error| {
                SettingsError::Unreadable { name: name.clone(), reason: error.to_string() }
            })?;
            let before = settings.clone();
            (settings.paper.scan, settings.toon.greys) = (None, None);
            settings = settings.changed(&name, &text)?;
            // Paths of pictures are relative to the file that names them.
            let folder = path.parent().unwrap_or(Path::new(""));
            let beside = |named: Option<String>, before: Option<String>| {
                named.map(|file| folder.join(file).display().to_string()).or(before)
            };
            settings.paper.scan = beside(settings.paper.scan, before.paper.scan);
            settings.toon.greys = beside(settings.toon.greys, before.toon.greys);
            inputs.push(path.clone());
        }
        for change in &self.set {
            let Some((key, value)) = change.split_once('=') else {
                return Err(Failure::usage(
                    format!("--set takes KEY=VALUE, found `{change}`"),
                    "--set edges.strength=2 is such a change",
                ));
            };
            let text = format!("{} = {}", key.trim(), as_toml(value.trim()));
            settings = settings.changed(&format!("--set {change}"), &text)?;
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

/// A value in TOML notation: words need no quotes here, and `.5` is a number.
fn as_toml(value: &str) -> String {
    if let Ok(whole) = value.parse::<i64>() {
        return whole.to_string();
    }
    if let Ok(number) = value.parse::<f64>() {
        return format!("{number:?}").to_lowercase();
    }
    let bare = ["true", "false"].contains(&value) || value.starts_with(['"', '\'']);
    if bare { value.to_owned() } else { format!("{value:?}") }
}
