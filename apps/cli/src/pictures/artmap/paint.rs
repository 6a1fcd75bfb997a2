//! `impasto artmap paint`: samples painted by the engine in a style.

use std::path::PathBuf;

use artmap::painted::Style;
use clap::Args;
use clap::builder::PossibleValuesParser;
use documents::counted;
use pictures::{PictureError, SwatchRequest};

use super::table::{Printed, print_samples, spacing};
use crate::console::Console;
use crate::failure::{Context, Result};
use crate::library_choice::{VARIABLE, default_path};
use crate::pictures::exports::heard;

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
            return console.lines(Style::text(name)?);
        }
        let printed = Printed::of(self.json, self.csv);
        let named = self.library.or(self.pigments);
        let is_named = named.is_some();
        let request = SwatchRequest {
            style: self.style.unwrap_or_default(),
            library: named.or_else(default_path),
            hue: self.hue,
            tones: self.tones,
            seed: self.seed,
            output: self.output.unwrap_or_default(),
            sheet: self.sheet,
        };
        let set = heard(console, |task, listener| match request.run_heard(task, listener) {
            Err(error @ PictureError::Library(_)) if !is_named => {
                Err(error).context(|| format!("the default library, which {VARIABLE} names"))
            }
            run => Ok(run?),
        })?;
        if printed.as_data(&set, "samples", console)? {
            return Ok(());
        }
        console.line(format!(
            "{}: {} in the style {}, strokes {} apart, painted with {}",
            request.output.display(),
            counted(set.samples.len(), "tone"),
            set.style.as_deref().unwrap_or_default(),
            spacing(&set),
            set.pigments.join(", ")
        ))?;
        print_samples(&set.samples, console)
    }
}
