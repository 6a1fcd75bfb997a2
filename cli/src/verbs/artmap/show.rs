//! `impasto artmap show`: lists the samples of a file.

use std::path::PathBuf;

use clap::Args;
use render::artmap::sample::SampleSet;
use render::artmap::sheet::sheet;

use super::files::{picture_bytes, picture_output};
use super::table::{pigment_names, print_samples, sample_json, set_json, spacing};
use crate::console::Console;
use crate::failure::Result;

/// List the samples of a file, or draw them side by side
#[derive(Debug, Args)]
pub(super) struct Show {
    /// The samples (.exr, as `artmap sample` and `artmap paint` write them)
    samples: PathBuf,
    /// Write a picture of all samples side by side, dark to light, the relief of the paint under a
    /// raking light below (.png, .exr)
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
    /// Print JSON: provenance, spacing, pigments, and of each sample name, size, texels, lightness,
    /// colour, mm_per_texel, height_mm, guessed_relief
    #[arg(long)]
    json: bool,
}

impl Show {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let output = picture_output(self.sheet.as_deref(), std::slice::from_ref(&self.samples))?;
        let set = SampleSet::open(&self.samples)?;
        if let Some(output) = output {
            let bytes = picture_bytes(&sheet(&set), &output, console)?;
            output.write(bytes)?;
        }
        if self.json {
            return console.json(&set_json(&set, set.samples.iter().map(sample_json).collect()));
        }
        let pigments = pigment_names(&set);
        let pigments = match pigments.is_empty() {
            true => "colours only".to_owned(),
            false => pigments.join(", "),
        };
        console.line(format!("{}, strokes {} apart; {pigments}", set.provenance, spacing(&set)))?;
        print_samples(&set, console)
    }
}
