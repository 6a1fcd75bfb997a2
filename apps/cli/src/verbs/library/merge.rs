//! `impasto library merge`: merges libraries into one.

use std::path::PathBuf;

use calibrate::curation::{MergeSettings, Prefer, Source, merged};
use clap::{Args, ValueEnum};
use serde_json::json;

use super::resampling::ResamplingOptions;
use crate::console::Console;
use crate::failure::Result;
use crate::input::{ViewingOptions, library};
use crate::output::Output;
use crate::readings::remark_repeated;

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PreferName {
    First,
    Last,
}

/// Merge libraries into one
///
/// K and S of relative libraries are converted to one reference white, that of the first library:
/// those of each later library are divided by its own S of this white, found there by name or by
/// --as. This keeps the K/S of every mixture. Pigments that two libraries share are compared.
/// Libraries with different surfaces, or one of shares and one of amounts, cannot be merged.
#[derive(Debug, Args)]
pub(super) struct Merge {
    /// The pigment libraries (JSON); grid and surface are those of the first
    #[arg(required = true, num_args = 2.., value_name = "LIBRARY")]
    libraries: Vec<PathBuf>,
    /// The library file to write (JSON)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The white that all libraries share, by its name in the first [default: its reference]
    #[arg(long, alias = "reference", value_name = "PIGMENT")]
    white: Option<String>,
    /// Name of that white in another library (may be repeated)
    #[arg(long = "as", value_name = "PIGMENT")]
    aliases: Vec<String>,
    /// Which of two different pigments with the same name to keep [default: an error; for the
    /// white, the first]
    #[arg(long, value_enum)]
    prefer: Option<PreferName>,
    /// Title of the new library [default: all titles]
    #[arg(long)]
    title: Option<String>,
    #[command(flatten)]
    resampling: ResamplingOptions,
    /// Accept pigments fitted under another surface as if it were the first's
    #[arg(long)]
    any_surface: bool,
    /// Confirm that the absolute amounts of all libraries have the same unit and area
    #[arg(long)]
    same_unit: bool,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: pigments, common, warnings
    #[arg(long)]
    json: bool,
    /// Print the pigments that several libraries have as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Merge {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        remark_repeated(&self.libraries, console)?;
        let output = Output::open(&self.output, &self.libraries)?;
        let sources = self
            .libraries
            .iter()
            .map(|path| Ok(Source { file: path.display().to_string(), library: library(path)? }))
            .collect::<Result<Vec<Source>>>()?;
        let settings = MergeSettings {
            reference: self.white,
            aliases: self.aliases,
            prefer: self.prefer.map(|prefer| match prefer {
                PreferName::First => Prefer::First,
                PreferName::Last => Prefer::Last,
            }),
            interpolation: self.resampling.method(),
            ends: self.resampling.ends(),
            any_surface: self.any_surface,
            same_unit: self.same_unit,
            viewing: self.viewing.viewing()?,
        };
        let mut found = merged(&sources[0], &sources[1..], &settings)?;
        if let Some(title) = self.title {
            found.library.title = title;
        }
        if sources.iter().any(|source| source.library.evidence.is_some()) {
            found.warnings.push(
                "the evidence of each fit is left out; its errors are in the notes of the pigments"
                    .into(),
            );
        }
        console.warnings(&found.warnings)?;
        output.write(found.library.to_json(), console)?;
        let common = found.common.iter().map(|(name, file, delta_e)| {
            json!({ "name": name, "file": file, "masstone_ciede2000": delta_e })
        });
        if self.csv {
            return console.csv_rows(&common.collect::<Vec<_>>());
        }
        if self.json {
            return console.json(&json!({
                "pigments": found.library.pigments.len(),
                "reference": found.library.reference,
                "common": common.collect::<Vec<_>>(),
                "warnings": found.warnings,
            }));
        }
        for (name, file, delta_e) in &found.common {
            console.line(format!("{name}: that of {file} differs by {delta_e:.2} CIEDE2000"))?;
        }
        console.line(format!(
            "{}: {} of {} libraries",
            self.output.display(),
            documents::counted(found.library.pigments.len(), "pigment"),
            sources.len()
        ))
    }
}
