//! What all verbs of painting share: the options for presets and settings of a technique, and
//! painting behind a progress bar.

use std::path::{Path, PathBuf};

use artmap::painted::{PaintedSettings, Style, SwatchPainter};
use artmap::sample::SampleSet;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use documents::settings::{Preset, changed};
use paint::technique::Technique;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::StageFolder;
use crate::progress::followed;
use crate::readings::{is_toml, text};

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
            console.line(preset.text().trim_end())?;
        }
        Ok(self.show_preset.is_some())
    }
}

impl<T: Styled> StyleOptions<T> {
    /// The preset, if one is named.
    pub(crate) fn preset(&self) -> Option<T::Preset> {
        self.preset
    }

    /// Path of the file, if there is one.
    pub(crate) fn input(&self) -> Option<&PathBuf> {
        self.settings.as_ref()
    }

    /// The settings of preset, file and single changes.
    pub(crate) fn settings(&self) -> Result<T::Settings> {
        let mut settings = self.preset.map_or_else(T::Settings::default, Preset::settings);
        if let Some(path) = &self.settings {
            settings = T::changed_by_file(&settings, path, &text(path)?)?;
        }
        self.each_set(|name, toml| {
            settings = changed(&settings, name, toml)?;
            Ok(())
        })?;
        Ok(settings)
    }

    /// Calls `change` with each option `--set`, as it was written and as a line of TOML.
    pub(crate) fn each_set(&self, mut change: impl FnMut(&str, &str) -> Result<()>) -> Result<()> {
        self.set.iter().try_for_each(|option| {
            let Some((key, value)) = option.split_once('=') else {
                return Err(Failure::usage(
                    format!("--set takes KEY=VALUE, found `{option}`"),
                    format!("try --set {}", T::EXAMPLES.first().copied().unwrap_or_default()),
                ));
            };
            let toml = format!("{} = {}", key.trim(), as_toml(value.trim()));
            change(&format!("--set {option}"), &toml).map_err(Failure::of_option)
        })
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

/// Converts an option's value to TOML: words need no quotes here, and `.5` is a number.
fn as_toml(value: &str) -> String {
    if let Ok(whole) = value.parse::<i64>() {
        return whole.to_string();
    }
    if let Ok(number) = value.parse::<f64>() {
        return format!("{number:?}").to_lowercase();
    }
    // Lists are written as in a file.
    let bare = ["true", "false"].contains(&value) || value.starts_with(['"', '\'', '[']);
    if bare { value.to_owned() } else { format!("{value:?}") }
}

/// Prepares the painter of a subject.
pub(crate) fn prepared<T: Technique>(
    subject: T::Subject<'_>,
    settings: &T::Settings,
    console: &Console<'_>,
) -> Result<T, T::Error> {
    followed(console, |task| T::prepare(subject, settings, task))
}

/// Paints a subject in one view, behind a spinner or bar.
pub(crate) fn painted<T: Technique>(
    painter: &mut T,
    view: T::View<'_>,
    console: &Console<'_>,
) -> Result<T::Picture, T::Error> {
    followed(console, |task| painter.paint(view, task))
}

/// Writes the steps to a picture into a folder.
pub(crate) fn write_stages<T: Technique>(
    painter: &mut T,
    view: T::View<'_>,
    folder: &StageFolder,
    console: &mut Console<'_>,
) -> Result<()> {
    let stages = followed(console, |task| painter.stages(view, task))?;
    folder.write(&stages, console)
}

/// The style of samples that ships with this name, or the style in a file, with its path.
pub(crate) fn style_of(named: &Path) -> Result<(Style, Option<PathBuf>)> {
    if is_toml(named) {
        return Ok((Style::open(named)?, Some(named.to_owned())));
    }
    Ok((Style::named(&named.to_string_lossy())?, None))
}

/// Samples painted by the engine in a style.
pub(crate) fn samples(
    style: &Style,
    colors: &PaintedSettings,
    console: &Console<'_>,
) -> Result<SampleSet> {
    let mut painter = prepared::<SwatchPainter>(colors, style, console)?;
    Ok(painted(&mut painter, (), console)?)
}
