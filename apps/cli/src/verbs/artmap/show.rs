//! `impasto artmap show`: lists the samples of a file, or the tiles of a map.

use std::path::PathBuf;

use artmap::map::{ArtMap, Between};
use artmap::sample::SampleSet;
use artmap::sheet::sheet;
use artmap::texel_file::TexelFileError;
use clap::{Args, ValueEnum};

use super::map_table::{csv_tiles, map_json, print_tiles, summary};
use super::table::{pigment_names, print_samples, sample_json, set_json, spacing};
use crate::console::Console;
use crate::failure::Result;
use crate::plain_picture::{picture_bytes, picture_output};

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
    /// Print JSON. Samples: provenance, spacing, pigments, and of each name, size, texels,
    /// lightness, colour, mm_per_texel, height_mm, guessed_relief. A map: as `artmap check`
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

    /// Reads the file. One of another format is told as one without samples.
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
        let figures = map.figures();
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
