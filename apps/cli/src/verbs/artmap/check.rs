//! `impasto artmap check`: checks a map.

use std::path::PathBuf;

use artmap::map::ArtMap;
use clap::Args;

use super::map_table::{csv_tiles, map_json, print_tiles, summary};
use crate::console::Console;
use crate::failure::{Failure, Result};

/// Check a map for tiles that do not agree, seams, and tones too close to each other
///
/// A map with faults, and a file that is no map, end with exit status 1. Coherence is the
/// correlation of the strokes with those of the first tile: 0.6 is wanted, of it or of the
/// neighbour on the way to it. Border is the step of lightness where a tile repeats over the steps
/// within: 1 where no seam shows.
#[derive(Debug, Args)]
pub(super) struct Check {
    /// The map (.exr, as `artmap build` writes it)
    map: PathBuf,
    /// Print JSON: provenance, size, spacing, pigments, settings, and of each tile name, lightness,
    /// contrast, stroke_length, coherence, neighbour_coherence, border; faults
    #[arg(long)]
    json: bool,
    /// Print the tiles as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Check {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let map = ArtMap::open(&self.map)?;
        let figures = map.figures();
        let faults = figures.faults();
        if self.csv {
            csv_tiles(&map_json(&map, &figures), console)?;
        } else if self.json {
            console.json(&map_json(&map, &figures))?;
        } else {
            console.line(summary(&map))?;
            print_tiles(&figures, console)?;
            for fault in &faults {
                console.line(format!("fault: {fault}"))?;
            }
        }
        match faults.into_iter().next() {
            None => Ok(()),
            Some(first) => {
                Err(Failure::from(first)
                    .within(format!("{}: the map has faults", self.map.display())))
            }
        }
    }
}
