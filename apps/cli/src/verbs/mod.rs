//! Verbs of the command line, one file each.
mod fit;
mod validate;
mod mix;
mod color;
mod light;
mod quadrature;
mod recipe_search;
mod correct;
mod library;
mod plan;
mod report;
mod map;
mod simulate_scan;
mod demo;
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

/// A verb with its options.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    Fit(fit::Fit),
    Validate(validate::Validate),
    Mix(mix::Mix),
    #[command(alias = "colour")]
    Color(color::Color),
    Light(light::Light),
    Quadrature(quadrature::Quadrature),
    Match(recipe_search::Match),
    Correct(Box<correct::Correct>),
    Library(library::Library),
    Plan(plan::Plan),
    Report(report::Report),
    Map(Box<map::Map>),
    SimulateScan(simulate_scan::SimulateScan),
    Demo(demo::Demo),
    Paint(Box<paint::Paint>),
    Relight(Box<relight::Relight>),
    Watercolor(Box<watercolor::Watercolor>),
    Artmap(artmap::Artmap),
    Painterly(Box<painterly::Painterly>),
    Stencil(Box<stencil::Stencil>),
    Gpu(gpu::Gpu),
}

impl Verb {
    pub(crate) fn run(self, console: &mut Console<'_>) -> Result<()> {
        match self {
            Self::Fit(verb) => verb.run(console),
            Self::Validate(verb) => verb.run(console),
            Self::Mix(verb) => verb.run(console),
            Self::Color(verb) => verb.run(console),
            Self::Light(verb) => verb.run(console),
            Self::Quadrature(verb) => verb.run(console),
            Self::Match(verb) => verb.run(console),
            Self::Correct(verb) => verb.run(console),
            Self::Library(verb) => verb.run(console),
            Self::Plan(verb) => verb.run(console),
            Self::Report(verb) => verb.run(console),
            Self::Map(verb) => verb.run(console),
            Self::SimulateScan(verb) => verb.run(console),
            Self::Demo(verb) => verb.run(console),
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
