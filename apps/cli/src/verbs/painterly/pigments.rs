//! Options for paintings with pigments.

use std::path::PathBuf;
use std::sync::Arc;

use calibrate::library::PigmentLibrary;
use clap::Args;
use paint::document::Slots;
use paint::ground::{GroundKind, GroundSpec};

use crate::canvas::grounds;
use crate::console::Console;
use crate::failure::Result;
use crate::library_choice::quietly_chosen;
use crate::palette::palette;

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
pub(super) struct PigmentOptions {
    /// Paint the first picture with pigments, and show it as a painting, with relief and gloss; exports
    /// other than --picture imply it
    #[arg(long)]
    with_pigments: bool,
    /// Library of the pigments for the colours of a model or photograph [default: that of the map, else
    /// that of IMPASTO_LIBRARY, else the Van Gogh oils that ship]
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// The library, as it was named before
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments for those colours, separated by commas [default: those that come nearest]
    #[arg(long, value_name = "PIGMENTS")]
    palette: Vec<String>,
    /// Ground: linen, paper or panel
    #[arg(long, value_name = "KIND", default_value = "panel", value_parser = grounds())]
    ground: GroundKind,
}

/// Title, ground and pigments of a painting.
pub(super) struct Materials {
    pub(super) title: String,
    pub(super) ground: GroundSpec,
    /// Pigments for the colours of the subject, if they were chosen.
    pub(super) pigments: Option<(Arc<PigmentLibrary>, Option<Slots>)>,
}

impl PigmentOptions {
    fn path(&self) -> Option<&PathBuf> {
        self.pigments.as_ref().or(self.pigments_before.as_ref())
    }

    /// File of the library, if one is given.
    pub(super) fn input(&self) -> Option<PathBuf> {
        self.path().cloned()
    }

    /// Title, ground and pigments, if the picture is a painting: if `wanted` or asked for here.
    pub(super) fn materials(
        &self,
        title: &str,
        wanted: bool,
        console: &mut Console<'_>,
    ) -> Result<Option<Materials>> {
        let chosen = self.path().is_some() || !self.palette.is_empty();
        if !(wanted || self.with_pigments || chosen) {
            return Ok(None);
        }
        let pigments = match chosen {
            false => None,
            true => {
                let path = self.path().map(PathBuf::as_path);
                let library = quietly_chosen(path, console)?.library;
                let slots = match self.palette.is_empty() {
                    true => None,
                    false => Some(palette(&self.palette, &library)?),
                };
                Some((Arc::new(library), slots))
            }
        };
        Ok(Some(Materials { title: title.to_owned(), ground: self.ground.spec(1), pigments }))
    }
}
