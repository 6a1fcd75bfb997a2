//! `impasto library`: inspects, merges and changes pigment libraries.

mod list;
mod show;
mod resampling;
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

/// Inspect, merge and change pigment libraries
#[derive(Debug, Args)]
pub(crate) struct Library {
    #[command(subcommand)]
    verb: LibraryVerb,
}

#[derive(Debug, Subcommand)]
enum LibraryVerb {
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
        match self.verb {
            LibraryVerb::List(verb) => verb.run(console),
            LibraryVerb::Show(verb) => verb.run(console),
            LibraryVerb::Check(verb) => verb.run(console),
            LibraryVerb::Diff(verb) => verb.run(console),
            LibraryVerb::Merge(verb) => verb.run(console),
            LibraryVerb::Convert(verb) => verb.run(console),
            LibraryVerb::Rename(verb) => verb.run(console),
            LibraryVerb::Subset(verb) => verb.run(console),
            LibraryVerb::Export(verb) => verb.run(console),
            LibraryVerb::FromRgb(verb) => verb.run(console),
        }
    }
}
