//! `impasto artmap build`: a map of samples.

use std::path::PathBuf;

use artmap::map::{ArtMap, Between, file};
use artmap::sample::SampleSet;
use artmap::synthesis::{Features, Stage, SynthesisSettings};
use clap::{Args, ValueEnum};

use super::files::FileAndSheet;
use super::map_table::{csv_tiles, map_json, print_tiles, summary};
use crate::console::Console;
use crate::failure::Result;
use crate::plain_picture::picture_bytes;
use crate::progress::Waiting;
use crate::readings::remark_repeated;
use crate::stages::StageFolder;

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
/// where those of the first tile stand (Yan, Chi, Lee and Lin 2008, section 4). Samples painted
/// with the same strokes show the same places. Pigments and relief of the samples follow.
#[derive(Debug, Args)]
pub(super) struct Build {
    /// Samples (.exr, as `artmap sample` and `artmap paint` write them); of several files with the
    /// same pigments, all together
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
    /// Write the steps into this folder, as PNG: samples; what patches are compared by (edges,
    /// lightness, a*, b*, height); most similar patches; the levels of each tile
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
        let files = FileAndSheet::open(&self.output, self.sheet.as_deref(), &self.samples)?;
        let folder = self.stages.as_ref();
        let folder = folder.map(|folder| StageFolder::open(folder, &self.samples)).transpose()?;
        let sets = self.samples.iter().map(|path| SampleSet::open(path));
        let set = SampleSet::joined(sets.collect::<std::result::Result<Vec<_>, _>>()?)?;
        let waiting = Waiting::new("building the map", console.shows_progress());
        let (map, stages) = match folder {
            Some(_) => ArtMap::with_stages(&set, &self.settings())?,
            None => (ArtMap::of(&set, &self.settings())?, Vec::new()),
        };
        let figures = map.figures();
        drop(waiting);
        if let Some(folder) = folder {
            write_stages(&folder, &stages, console)?;
        }
        files.write(file::write(&map)?, || map.sheet(Between::default()), console)?;
        if self.csv {
            return csv_tiles(&map_json(&map, &figures), console);
        }
        if self.json {
            return console.json(&map_json(&map, &figures));
        }
        console.line(format!("{}: {}", self.output.display(), summary(&map)))?;
        print_tiles(&figures, console)?;
        for fault in figures.faults() {
            console.remark(fault.to_string())?;
        }
        Ok(())
    }

    fn settings(&self) -> SynthesisSettings {
        SynthesisSettings {
            size: self.size,
            first: self.first.clone(),
            features: match self.features {
                ComparedBy::Tone => Features::Tone,
                ComparedBy::Paper => Features::Paper,
            },
            links: self.links,
            follow: self.follow,
            uniformity: self.uniformity,
            seed: self.seed,
        }
    }
}

/// Writes the steps of a synthesis, numbered from 1.
fn write_stages(folder: &StageFolder, stages: &[Stage], console: &mut Console<'_>) -> Result<()> {
    let outputs = folder.outputs(stages.iter().map(|stage| stage.name.as_str()))?;
    for (output, stage) in outputs.into_iter().zip(stages) {
        let bytes = picture_bytes(&stage.picture, &output, console)?;
        output.put(bytes)?;
    }
    folder.told(console)
}
