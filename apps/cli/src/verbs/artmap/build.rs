//! `impasto artmap build` makes a map of samples, `impasto artmap check` checks it, and `impasto
//! artmap show` lists the samples of a file or the tiles of a map. You see them side by side if you
//! ask for a sheet.

use std::path::PathBuf;

use artmap::map::{ArtMap, Between, MapFigures, file};
use artmap::sample::SampleSet;
use artmap::sheet::sheet;
use artmap::synthesis::{Features, Stage, SynthesisSettings};
use artmap::texel_file::TexelFileError;
use clap::{Args, ValueEnum};

use super::table::{
    FileAndSheet, csv_tiles, map_json, pigment_names, print_samples, print_tiles, sample_json,
    set_json, spacing, summary,
};
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::StageFolder;
use crate::pictures::{picture_bytes, picture_output};
use crate::progress::Waiting;
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
        let figures = MapFigures::of(&map);
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
        let map = ArtMap::open(&self.map)?;
        let figures = MapFigures::of(&map);
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

/// Content of a file.
enum Content {
    Samples(SampleSet),
    Map(Box<ArtMap>),
}

impl Show {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let output = picture_output(self.sheet.as_deref(), std::slice::from_ref(&self.file))?;
        let content = self.content()?;
        if let Some(output) = output {
            let picture = match &content {
                Content::Samples(set) => sheet(set),
                Content::Map(map) => map.sheet(match self.between {
                    TonesBetween::Dissolve => Between::Dissolve,
                    TonesBetween::Blend => Between::Blend,
                }),
            };
            let bytes = picture_bytes(&picture, &output, console)?;
            output.write(bytes, console)?;
        }
        match content {
            Content::Samples(set) => self.show_samples(&set, console),
            Content::Map(map) => self.show_map(&map, console),
        }
    }

    /// Reads the file. If it has another format, we say that it has no samples.
    fn content(&self) -> Result<Content> {
        match SampleSet::open(&self.file) {
            Ok(set) => Ok(Content::Samples(set)),
            Err(error @ TexelFileError::Format { .. }) => match ArtMap::open(&self.file) {
                Err(TexelFileError::Format { .. }) => Err(error.into()),
                map => Ok(Content::Map(Box::new(map?))),
            },
            Err(error) => Err(error.into()),
        }
    }

    fn show_map(&self, map: &ArtMap, console: &mut Console<'_>) -> Result<()> {
        let figures = MapFigures::of(map);
        if self.csv {
            return csv_tiles(&map_json(map, &figures), console);
        }
        if self.json {
            return console.json(&map_json(map, &figures));
        }
        console.line(format!("{}; {}", map.provenance, summary(map)))?;
        print_tiles(&figures, console)
    }

    fn show_samples(&self, set: &SampleSet, console: &mut Console<'_>) -> Result<()> {
        if self.csv {
            return console.csv_rows(&set.samples.iter().map(sample_json).collect::<Vec<_>>());
        }
        if self.json {
            return console.json(&set_json(set, set.samples.iter().map(sample_json).collect()));
        }
        let pigments = pigment_names(set);
        let pigments = match pigments.is_empty() {
            true => "colours only".to_owned(),
            false => pigments.join(", "),
        };
        console.line(format!("{}, strokes {} apart; {pigments}", set.provenance, spacing(set)))?;
        print_samples(set, console)
    }
}
