//! How a watercolor looks: a preset, a file, single settings.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use render::watercolor::{Preset, Settings};

use crate::failure::Refusal;
use crate::input::unreadable;

#[derive(Debug, Args)]
#[command(next_help_heading = "Look")]
pub(super) struct LookOptions {
    /// Settings that come with impasto: portrait, landscape or sketch [default: those between]
    #[arg(long, value_name = "NAME")]
    preset: Option<Preset>,
    /// Settings from a file (TOML); what it leaves out stays as the preset has it
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    /// Change one setting, as `edges.strength=2` or `paper.kind=rough`; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl LookOptions {
    /// The settings, and the files they were read from.
    pub(super) fn settings(&self) -> anyhow::Result<(Settings, Vec<PathBuf>)> {
        let mut settings = self.preset.map_or_else(Settings::default, Preset::settings);
        let mut inputs = Vec::new();
        if let Some(path) = &self.settings {
            let text = std::fs::read_to_string(path).with_context(|| unreadable(path))?;
            let before = settings.paper.scan.take();
            settings = settings.changed(&path.display().to_string(), &text)?;
            // A scan stands beside the file that names it.
            let folder = path.parent().unwrap_or(Path::new(""));
            let named = settings.paper.scan.map(|scan| folder.join(scan).display().to_string());
            settings.paper.scan = named.or(before);
            inputs.push(path.clone());
        }
        for change in &self.set {
            let Some((key, value)) = change.split_once('=') else {
                return Err(Refusal::usage(
                    format!("--set takes KEY=VALUE, found `{change}`"),
                    "--set edges.strength=2 is such a change",
                ));
            };
            let text = format!("{} = {}", key.trim(), as_toml(value.trim()));
            settings = settings.changed(&format!("--set {change}"), &text)?;
        }
        inputs.extend(settings.paper.scan.as_ref().map(PathBuf::from));
        Ok((settings, inputs))
    }
}

/// A value as TOML has it: words need no quotes here.
fn as_toml(value: &str) -> String {
    let bare = value.parse::<f64>().is_ok() || ["true", "false"].contains(&value);
    let quoted = value.starts_with(['"', '\'']);
    if bare || quoted { value.to_owned() } else { format!("{value:?}") }
}
