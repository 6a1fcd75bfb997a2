//! `impasto artmap build` makes a map of samples, `impasto artmap check` checks it, and `impasto
//! artmap show` lists the samples of a file or the tiles of a map. You see them side by side if you
//! ask for a sheet.

use std::path::PathBuf;

use artmap::{
    map::Between,
    synthesis::{Features, SynthesisSettings},
};
use clap::{Args, ValueEnum};
use documents::Task;
use pictures::{ArtMapCheckRequest, ArtMapRequest, BrushworkOutcome, SheetRequest};

use super::table::{Printed, names, print_samples, print_tiles, spacing, summary};
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::pictures::exports::heard;
use crate::readings::remark_repeated;

/// Properties by which patches are compared.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum ComparedBy {
    /// Strength of edges, lightness, height, a* and b*
    Tone,
    /// Strength of edges, a* and b*, as published
    Paper,
}

/// Make a map of samples: one tile of each, from dark to light, that repeats without seams
///
/// Each tile is put together from patches of its sample, so that the strokes of all tiles stand
/// where those of the first tile stand (Yan, Chi, Lee and Lin 2008, section 4). If the samples were
/// painted with the same strokes, all tiles show the same places of their samples. Tiles keep the
/// pigments and the relief of the samples.
#[derive(Debug, Args)]
pub(super) struct Build {
    /// Files of samples (.exr, as `artmap sample` and `artmap paint` write them). Several files with the
    /// same pigments make one map
    #[arg(required = true)]
    samples: Vec<PathBuf>,
    /// Width and height of the tiles in texels, 64 to 1024
    #[arg(long, value_name = "N", default_value_t = SynthesisSettings::default().size)]
    size: usize,
    /// Sample whose tile is made first and which the others follow [default: the one with the
    /// strongest contrast]
    #[arg(long, value_name = "NAME")]
    first: Option<String>,
    /// Properties by which patches of different samples are compared
    #[arg(long, value_enum, default_value = "tone")]
    features: ComparedBy,
    /// Number of patches of each sample that a patch of the first tile is linked to, 1 to 512
    #[arg(long, value_name = "N", default_value_t = SynthesisSettings::default().links)]
    links: usize,
    /// How closely tiles follow the first one, 0 to 16; less makes better seams
    #[arg(long, value_name = "X", default_value_t = SynthesisSettings::default().follow)]
    follow: f32,
    /// How evenly the parts of a sample are used, 0 to 16
    #[arg(long, value_name = "X", default_value_t = SynthesisSettings::default().uniformity)]
    uniformity: f32,
    /// Seed of the first tile
    #[arg(long, value_name = "N", default_value_t = SynthesisSettings::default().seed)]
    seed: u64,
    /// Write the map (.exr)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Write a picture of all tiles, dark to light: tiles, tones in between, tiles repeated, relief
    /// (.png, .exr)
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
    /// Write intermediate stages into this folder, as PNG: samples; the properties by which patches are
    /// compared (edges, lightness, a*, b*, height); most similar patches; the levels of each tile
    #[arg(long, value_name = "FOLDER")]
    stages: Option<PathBuf>,
    /// Print JSON: provenance, size, spacing, pigments, settings, and of each tile name, lightness,
    /// contrast, stroke_length, coherence, neighbour_coherence, border; faults
    #[arg(long)]
    json: bool,
    /// Print the tiles as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Build {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        remark_repeated(&self.samples, console)?;
        let output = self.output.display().to_string();
        let printed = Printed::of(self.json, self.csv);
        let request = self.request();
        let map = heard(console, |task, listener| Ok(request.run_heard(task, listener)?))?;
        if printed.as_data(&map, "tiles", console)? {
            return Ok(());
        }
        console.line(format!("{output}: {}", summary(&map)))?;
        print_tiles(&map, console)?;
        for fault in &map.faults {
            console.remark(fault.to_string())?;
        }
        Ok(())
    }

    /// The map that these options ask for.
    fn request(self) -> ArtMapRequest {
        ArtMapRequest {
            samples: self.samples,
            size: self.size,
            first: self.first,
            features: match self.features {
                ComparedBy::Tone => Features::Tone,
                ComparedBy::Paper => Features::Paper,
            },
            links: self.links,
            follow: self.follow,
            uniformity: self.uniformity,
            seed: self.seed,
            output: self.output,
            sheet: self.sheet,
            stages: self.stages,
        }
    }
}

/// Check a map for tiles that do not agree, seams, and tones too close to each other
///
/// A map with faults, and a file that is no map, end with exit status 1. Coherence is the
/// correlation of the strokes of a tile with the strokes of the first tile. It should be 0.6 or more,
/// either with the first tile or with the neighbour on that side. Border compares the steps of
/// lightness where copies of a tile meet with the steps inside the tile: at 1 no seam shows.
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
        let path = self.map.display().to_string();
        let map = ArtMapCheckRequest { map: self.map }.run(&Task::default())?;
        if !Printed::of(self.json, self.csv).as_data(&map, "tiles", console)? {
            console.line(summary(&map))?;
            print_tiles(&map, console)?;
            for fault in &map.faults {
                console.line(format!("fault: {fault}"))?;
            }
        }
        match map.faults.into_iter().next() {
            None => Ok(()),
            Some(first) => Err(Failure::from(first).within(format!("{path}: the map has faults"))),
        }
    }
}

/// List the samples or the tiles of a file, or draw them side by side
#[derive(Debug, Args)]
pub(super) struct Show {
    /// Samples or a map (.exr, as `artmap sample`, `artmap paint` and `artmap build` write them)
    file: PathBuf,
    /// Write a picture of all samples or tiles side by side, dark to light (.png, .exr)
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
    /// How the tones between the tiles of a map are made on the sheet
    #[arg(long, value_enum, default_value = "dissolve")]
    between: TonesBetween,
    /// Print JSON. For samples: provenance, spacing and pigments, then for each sample its name, size,
    /// texels, lightness, colour, mm_per_texel, height_mm and guessed_relief. For a map: the JSON of
    /// `artmap check`
    #[arg(long)]
    json: bool,
    /// Print the samples or tiles as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum TonesBetween {
    /// Strokes change one after the other
    Dissolve,
    /// Mean of both tiles, as published
    Blend,
}

impl Show {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let printed = Printed::of(self.json, self.csv);
        let request = SheetRequest {
            file: self.file,
            sheet: self.sheet,
            between: match self.between {
                TonesBetween::Dissolve => Between::Dissolve,
                TonesBetween::Blend => Between::Blend,
            },
        };
        match heard(console, |task, listener| Ok(request.run_heard(task, listener)?))? {
            BrushworkOutcome::Samples(set) => {
                if printed.as_data(&set, "samples", console)? {
                    return Ok(());
                }
                let pigments = names(&set.pigments);
                let apart = spacing(&set);
                console.line(format!("{}, strokes {apart} apart; {pigments}", set.provenance))?;
                print_samples(&set.samples, console)
            }
            BrushworkOutcome::Map(map) => {
                if printed.as_data(&map, "tiles", console)? {
                    return Ok(());
                }
                console.line(format!("{}; {}", map.provenance, summary(&map)))?;
                print_tiles(&map, console)
            }
        }
    }
}
