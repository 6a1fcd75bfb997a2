//! Options for presets and settings of a technique, which all verbs of painting share.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use documents::settings::Preset;
use paint::technique::Technique;
use pictures::StyleRequest;

use crate::console::Console;
use crate::failure::Result;

/// A technique with presets and settings that a verb takes as options.
pub(crate) trait Styled: Technique + std::fmt::Debug {
    /// The settings without `--preset`, as the help describes them.
    const USUAL: &'static str;
}

/// Options for settings: a preset, a file, single settings.
#[derive(Debug, Args)]
#[command(next_help_heading = "Style")]
pub(crate) struct StyleOptions<T: Styled> {
    #[arg(
        long,
        value_name = "NAME",
        value_parser = preset_names::<T::Preset>(),
        help = format!("Preset of settings that ships with impasto [default: {}]", T::USUAL)
    )]
    preset: Option<T::Preset>,
    /// Settings from a file (TOML); others keep the values of the preset
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    #[arg(long, value_name = "KEY=VALUE", help = set_help::<T>())]
    set: Vec<String>,
}

/// Option that prints a preset.
#[derive(Debug, Args)]
pub(crate) struct ShowPreset<T: Styled> {
    /// Print the settings of a preset, each with its meaning, and do nothing else
    #[arg(
        long,
        value_name = "NAME",
        conflicts_with = "subject",
        value_parser = preset_names::<T::Preset>()
    )]
    show_preset: Option<T::Preset>,
}

impl<T: Styled> ShowPreset<T> {
    /// Prints the preset, if one is asked for, and says whether it did.
    pub(crate) fn print(&self, console: &mut Console<'_>) -> Result<bool> {
        if let Some(preset) = self.show_preset {
            console.lines(preset.text())?;
        }
        Ok(self.show_preset.is_some())
    }
}

impl<T: Styled> StyleOptions<T> {
    /// The settings of these options.
    pub(crate) fn request(&self) -> StyleRequest {
        StyleRequest {
            preset: self.preset.map(|preset| preset.name().to_owned()),
            settings: self.settings.clone(),
            set: self.set.clone(),
        }
    }
}

/// Parses the name of a preset. Errors list the names.
fn preset_names<P: Preset>() -> impl TypedValueParser<Value = P> {
    let names = PossibleValuesParser::new(P::ALL.iter().map(|preset| preset.name()));
    names.try_map(|name| name.parse::<P>())
}

fn set_help<T: Technique>() -> String {
    let examples: Vec<String> = T::EXAMPLES.iter().map(|change| format!("`{change}`")).collect();
    format!("Change one setting, such as {}; may be repeated", examples.join(" or "))
}
