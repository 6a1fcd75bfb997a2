//! Options for paintings with pigments.

use std::path::PathBuf;
use std::sync::Arc;

use calibrate::library::PigmentLibrary;
use clap::Args;
use render::paint::document::Slots;
use render::paint::ground::{GroundKind, GroundSpec};

use crate::canvas::grounds;
use crate::failure::Result;
use crate::input::{built_in_library, library};
use crate::palette::palette;

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
pub(super) struct PigmentOptions {
    /// Paint the first picture with pigments, and show it as a painting, with relief and gloss; exports
    /// other than --picture imply it
    #[arg(long)]
    with_pigments: bool,
    /// Library of the pigments for the colours of a model or photograph [default: that of the map, or
    /// the Van Gogh oils]
    #[arg(long, value_name = "LIBRARY")]
    pigments: Option<PathBuf>,
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
    /// File of the library, if one is given.
    pub(super) fn input(&self) -> Option<PathBuf> {
        self.pigments.clone()
    }

    /// Title, ground and pigments, if the picture is a painting: if `wanted` or asked for here.
    pub(super) fn materials(&self, title: &str, wanted: bool) -> Result<Option<Materials>> {
        let chosen = self.pigments.is_some() || !self.palette.is_empty();
        if !(wanted || self.with_pigments || chosen) {
            return Ok(None);
        }
        let pigments = match chosen {
            false => None,
            true => {
                let library =
                    self.pigments.as_deref().map_or_else(|| Ok(built_in_library()), library)?;
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
