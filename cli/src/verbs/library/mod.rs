//! `impasto library`: look into pigment libraries, join and change them.

mod list;

mod show;

mod grid_option;

mod merge;

mod convert;

mod rename;

mod subset;

mod export;

mod from_rgb;

mod check;

mod diff;

use clap::{Args, Subcommand};

use crate::console::Console;
use crate::failure::Result;

pub(super) use list::print_pigments;

/// Look into pigment libraries, join and change them
#[derive(Debug, Args)]
pub(crate) struct Library {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    List(list::List),
    Show(show::Show),
    Check(check::Check),
    Diff(diff::Diff),
    Merge(merge::Merge),
    Convert(convert::Convert),
    Rename(rename::Rename),
    Subset(subset::Subset),
    Export(export::Export),
    FromRgb(from_rgb::FromRgb),
}

impl Library {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        match self.what {
            What::List(verb) => verb.run(console),
            What::Show(verb) => verb.run(console),
            What::Check(verb) => verb.run(console),
            What::Diff(verb) => verb.run(console),
            What::Merge(verb) => verb.run(console),
            What::Convert(verb) => verb.run(console),
            What::Rename(verb) => verb.run(console),
            What::Subset(verb) => verb.run(console),
            What::Export(verb) => verb.run(console),
            What::FromRgb(verb) => verb.run(console),
        }
    }
}
