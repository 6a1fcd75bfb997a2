//! `impasto artmap`: samples of brushwork, from pictures or painted by the engine, and maps made of
//! them.

mod table;
mod paint;
mod sample;
mod build;

use clap::{Args, Subcommand};

use crate::console::Console;
use crate::failure::Result;

/// Take samples of brushwork from a painting, or let the engine paint some, and make maps of them
///
/// A sample is a passage of a painting with the strokes of one tone. All samples of a file are
/// upright (strokes run from top to bottom), have the same distance between strokes, and are sorted
/// from dark to light, after Yan, Chi, Lee and Lin (2008). Samples of an impasto painting keep its
/// pigments and its relief. A map has a tile of each sample: it repeats without seams, and the
/// strokes of all tiles stand at the same places.
#[derive(Debug, Args)]
pub(crate) struct Artmap {
    #[command(subcommand)]
    verb: ArtmapVerb,
}

#[derive(Debug, Subcommand)]
enum ArtmapVerb {
    Sample(Box<sample::Sample>),
    Paint(paint::Paint),
    Build(build::Build),
    Check(build::Check),
    Show(build::Show),
}

impl Artmap {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        match self.verb {
            ArtmapVerb::Sample(verb) => verb.run(console),
            ArtmapVerb::Paint(verb) => verb.run(console),
            ArtmapVerb::Build(verb) => verb.run(console),
            ArtmapVerb::Check(verb) => verb.run(console),
            ArtmapVerb::Show(verb) => verb.run(console),
        }
    }
}
