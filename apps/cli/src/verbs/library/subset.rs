//! `impasto library subset`: keeps some pigments of a library.

use std::path::PathBuf;

use calibrate::curation::{subset, with_reference};
use clap::Args;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::{chosen, split};
use crate::output::Output;

/// Keep some pigments of a library; their K and S do not change
///
/// The reference white must be among them. --white chooses another, and all K and S are then
/// divided by its S. Only the summary of the evidence is kept, marked as that of the whole fit.
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto library subset [OPTIONS] --output <FILE> [LIBRARY] [PIGMENT]..."
)]
pub(super) struct Subset {
    /// The pigment library (JSON) [default: that of IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then the pigments to keep; a name may be abbreviated
    /// [default: all]
    #[arg(value_name = "[LIBRARY] PIGMENT")]
    words: Vec<String>,
    /// A pigment to leave out (may be repeated)
    #[arg(long, value_name = "PIGMENT")]
    without: Vec<String>,
    /// The pigment whose S becomes 1 [default: the library's reference]
    #[arg(long, alias = "reference", value_name = "PIGMENT")]
    white: Option<String>,
    /// The library file to write (JSON)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

impl Subset {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, keep) = split(&self.words, true);
        if keep.is_empty() && self.without.is_empty() {
            return Err(Failure::usage(
                "nothing to leave out",
                "name pigments to keep, or give --without",
            ));
        }
        let chosen = chosen(path.as_deref(), console)?;
        let output = Output::open(&self.output, &chosen.inputs())?;
        let file = chosen.name();
        let mut before = chosen.library;
        if let Some(reference) = &self.white {
            before = with_reference(&file, &before, reference)?;
        }
        let after = subset(&file, &before, keep, &self.without)?;
        if after.pigments.len() < before.pigments.len() && before.evidence.is_some() {
            console.remark(
                "evidence: kept the summary of the whole fit, left out the errors of samples",
            )?;
        }
        output.write(after.to_json(), console)?;
        let names: Vec<&str> = after.pigments.iter().map(|p| p.name.as_str()).collect();
        console.line(format!("{}: {}", self.output.display(), names.join(", ")))
    }
}
