//! `impasto library merge`: one library of several.

use std::path::PathBuf;

use calibrate::curation::{MergeSettings, Prefer, Source, merged};
use clap::{Args, ValueEnum};
use serde_json::json;

use super::grid_option::ResamplingOptions;
use crate::console::Console;
use crate::failure::Result;
use crate::input::{ViewingOptions, library};
use crate::output::Output;

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PreferName {
    First,
    Last,
}

/// One library of several
///
/// K and S of relative libraries are brought to one reference white: those of each later library
/// are divided by the S of the white that the first has as its reference, found there by its name
/// or by --as. That keeps every mixture's K/S. Pigments that stand in two libraries are compared.
/// Libraries of different surfaces, of shares and of amounts do not mix.
#[derive(Debug, Args)]
pub(super) struct Merge {
    /// The pigment libraries (JSON); the first gives grid and surface
    #[arg(required = true, num_args = 2.., value_name = "LIBRARY")]
    libraries: Vec<PathBuf>,
    /// Where to write the library
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// The white that all libraries share, as the first calls it [default: its reference]
    #[arg(long, value_name = "PIGMENT")]
    reference: Option<String>,
    /// What another library calls that white (may be repeated)
    #[arg(long = "as", value_name = "PIGMENT")]
    aliases: Vec<String>,
    /// Which of two different pigments of one name stays [default: an error; of the white, the
    /// first]
    #[arg(long, value_enum)]
    prefer: Option<PreferName>,
    /// The new library's title [default: all titles]
    #[arg(long)]
    title: Option<String>,
    #[command(flatten)]
    resampling: ResamplingOptions,
    /// Take pigments found under another surface as if it were the first's
    #[arg(long)]
    any_surface: bool,
    /// Absolute amounts of all libraries are in one unit, on one area
    #[arg(long)]
    same_unit: bool,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: pigments, common, warnings
    #[arg(long)]
    json: bool,
}

impl Merge {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let output = Output::open(&self.output, &self.libraries)?;
        let sources = self
            .libraries
            .iter()
            .map(|path| Ok(Source { file: path.display().to_string(), library: library(path)? }))
            .collect::<Result<Vec<Source>>>()?;
        let settings = MergeSettings {
            reference: self.reference,
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
                "the evidence of each fit is left out; the pigments' notes tell its errors".into(),
            );
        }
        console.warnings(&found.warnings)?;
        output.write(found.library.to_json())?;
        if self.json {
            let common = found.common.iter().map(|(name, file, delta_e)| {
                json!({ "name": name, "file": file, "masstone_ciede2000": delta_e })
            });
            return console.json(&json!({
                "pigments": found.library.pigments.len(),
                "reference": found.library.reference,
                "common": common.collect::<Vec<_>>(),
                "warnings": found.warnings,
            }));
        }
        for (name, file, delta_e) in &found.common {
            console.line(format!("{name}: that of {file} is {delta_e:.2} CIEDE2000 off"))?;
        }
        console.line(format!(
            "{}: {} pigments of {} libraries",
            self.output.display(),
            found.library.pigments.len(),
            sources.len()
        ))
    }
}
