//! `impasto artmap paint`: samples painted by the engine in a style.

use std::path::PathBuf;
use std::sync::Arc;

use artmap::painted::{PaintedSettings, Style};
use artmap::sample::file;
use artmap::sheet::sheet;
use clap::Args;
use clap::builder::PossibleValuesParser;
use pictures::style_of;

use super::table::{FileAndSheet, pigment_names, print_samples, sample_json, set_json, spacing};
use crate::console::Console;
use crate::failure::Result;
use crate::library_choice::quietly_chosen;
use crate::technique::samples;

/// Paint samples with the engine: tones of one hue, from dark to light, in the strokes of a style
///
/// The tones are mixed from the pigments of the library in even steps of lightness, and painted on a
/// canvas of their own with measured pigments and true relief. The same command gives the same
/// bytes. Styles: oil-flat (short strokes of a flat brush), oil-long (long strokes of a filbert),
/// dabs (single touches), knife (slabs), hatching (lines of a rigger; dark tones have more of them),
/// dry-brush (over the grain of paper).
#[derive(Debug, Args)]
pub(super) struct Paint {
    /// Style: oil-flat, oil-long, dabs, knife, hatching, dry-brush, or a file (.toml)
    #[arg(long, value_name = "NAME|FILE", required_unless_present = "show_style")]
    style: Option<PathBuf>,
    /// Print the text of a style that ships, to be copied and changed, and do nothing else
    #[arg(long, value_name = "NAME", conflicts_with_all = ["style", "output"],
          value_parser = PossibleValuesParser::new(Style::ALL))]
    show_style: Option<String>,
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else the Van Gogh oils that ship]
    library: Option<PathBuf>,
    /// Old name of LIBRARY
    #[arg(long, value_name = "LIBRARY", hide = true, conflicts_with = "library")]
    pigments: Option<PathBuf>,
    /// Hue of the tones, as `#c9a227` or `L,a,b`; its lightness does not matter
    #[arg(long, value_name = "COLOUR", default_value = "#c9a227", allow_hyphen_values = true)]
    hue: String,
    /// Number of tones, 2 to 12
    #[arg(long, value_name = "N", default_value_t = 7)]
    tones: usize,
    /// Seed of the strokes [default: that of the style]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Write the samples (.exr)
    #[arg(short, long, value_name = "FILE", required_unless_present = "show_style")]
    output: Option<PathBuf>,
    /// Write a picture of all samples side by side, dark to light, the relief of the paint under a
    /// raking light below (.png, .exr)
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
    /// Print JSON: provenance, spacing, pigments, and of each sample name, size, texels, lightness,
    /// colour, mm_per_texel, height_mm, guessed_relief
    #[arg(long)]
    json: bool,
    /// Print the samples as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Paint {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if let Some(name) = &self.show_style {
            return console.line(Style::text(name)?.trim_end());
        }
        let named = self.style.clone().unwrap_or_default();
        let (style, file) = style_of(&named)?;
        let path = self.library.as_deref().or(self.pigments.as_deref());
        let chosen = quietly_chosen(path, console)?;
        let inputs: Vec<PathBuf> = chosen.inputs().into_iter().chain(file).collect();
        let output = self.output.clone().unwrap_or_default();
        let files = FileAndSheet::open(&output, self.sheet.as_deref(), &inputs)?;
        let settings = PaintedSettings {
            library: Arc::new(chosen.library),
            hue: self.hue.clone(),
            tones: self.tones,
            seed: self.seed,
        };
        let set = samples(&style, &settings, console)?;
        files.write(file::write(&set)?, || sheet(&set), console)?;
        if self.csv {
            return console.csv_rows(&set.samples.iter().map(sample_json).collect::<Vec<_>>());
        }
        if self.json {
            return console.json(&set_json(&set, set.samples.iter().map(sample_json).collect()));
        }
        console.line(format!(
            "{}: {} in the style {}, strokes {} apart, painted with {}",
            output.display(),
            documents::counted(set.samples.len(), "tone"),
            style.name,
            spacing(&set),
            pigment_names(&set).join(", ")
        ))?;
        print_samples(&set, console)
    }
}
