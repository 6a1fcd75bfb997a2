//! Options for the brushwork: a map from a file, or one of samples painted in a style.

use std::path::{Path, PathBuf};

use clap::Args;
use render::artmap::map::ArtMap;
use render::artmap::painted::{PaintedSettings, Style, painted_samples};
use render::artmap::synthesis::SynthesisSettings;

use crate::console::Console;
use crate::failure::Result;
use crate::progress::Waiting;

#[derive(Debug, Args)]
#[command(next_help_heading = "Brushwork")]
#[group(id = "brushwork", multiple = false)]
pub(super) struct BrushworkOptions {
    /// The map (.exr, as `artmap build` writes it)
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Paint samples in this style and make a map of them, with the defaults of `artmap paint` and
    /// `artmap build`: oil-flat, oil-long, dabs, knife, hatching, dry-brush, or a file (.toml)
    #[arg(long, value_name = "NAME|FILE")]
    style: Option<PathBuf>,
}

impl BrushworkOptions {
    /// Files that the map is made from.
    pub(super) fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        let file = self.style.iter().filter(|style| is_toml(style));
        self.map.iter().chain(file).cloned()
    }

    /// Reads the map or makes it. Without options the style is `oil-flat`.
    pub(super) fn map(&self, console: &Console<'_>) -> Result<ArtMap> {
        if let Some(path) = &self.map {
            return Ok(ArtMap::open(path)?);
        }
        let style = match &self.style {
            None => Style::named("oil-flat")?,
            Some(path) if is_toml(path) => Style::open(path)?,
            Some(name) => Style::named(&name.to_string_lossy())?,
        };
        let _waiting = Waiting::new("painting samples", console.screen.progress);
        let samples = painted_samples(&style, &PaintedSettings::default())?;
        Ok(ArtMap::of(&samples, &SynthesisSettings::default())?)
    }
}

fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"))
}
