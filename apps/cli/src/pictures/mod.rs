//! Verbs that draw, paint or map, one file each, and the options that they share.
mod engine;
mod exports;
mod technique;
mod animation;
mod report;
mod map;
mod identify;
mod simulate_scan;
mod paint;
mod relight;
mod watercolor;
mod artmap;
mod painterly;
mod stencil;
mod gpu;

use clap::Subcommand;

use crate::console::Console;
use crate::failure::Result;

/// A verb that draws, paints or maps, with its options.
#[derive(Debug, Subcommand)]
pub(crate) enum PictureVerb {
    Report(Box<report::Report>),
    Map(Box<map::Map>),
    Identify(Box<identify::Identify>),
    SimulateScan(simulate_scan::SimulateScan),
    Paint(Box<paint::Paint>),
    Relight(Box<relight::Relight>),
    Watercolor(Box<watercolor::Watercolor>),
    Artmap(artmap::Artmap),
    Painterly(Box<painterly::Painterly>),
    Stencil(Box<stencil::Stencil>),
    Gpu(gpu::Gpu),
}

impl PictureVerb {
    pub(crate) fn run(self, console: &mut Console<'_>) -> Result<()> {
        match self {
            Self::Report(verb) => verb.run(console),
            Self::Map(verb) => verb.run(console),
            Self::Identify(verb) => verb.run(console),
            Self::SimulateScan(verb) => verb.run(console),
            Self::Paint(verb) => verb.run(console),
            Self::Relight(verb) => verb.run(console),
            Self::Watercolor(verb) => verb.run(console),
            Self::Artmap(verb) => verb.run(console),
            Self::Painterly(verb) => verb.run(console),
            Self::Stencil(verb) => verb.run(console),
            Self::Gpu(verb) => verb.run(console),
        }
    }
}
