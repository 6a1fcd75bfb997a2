//! `impasto library subset`: keeps some pigments of a library.

use std::path::PathBuf;

use calibrate::curation::{subset, with_reference};
use clap::Args;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::library;
use crate::output::Output;

/// Keep some pigments of a library; their K and S do not change
///
/// The reference white must be among them. --reference chooses another, and all K and S are then
/// divided by its S. Only the summary of the evidence is kept, marked as that of the whole fit.
#[derive(Debug, Args)]
pub(super) struct Subset {
    /// The pigment library (JSON)
    library: PathBuf,
    /// The pigments to keep; a name may be abbreviated [default: all]
    #[arg(value_name = "PIGMENT")]
    keep: Vec<String>,
    /// A pigment to leave out (may be repeated)
    #[arg(long, value_name = "PIGMENT")]
    without: Vec<String>,
    /// The pigment whose S becomes 1 [default: the library's reference]
    #[arg(long, value_name = "PIGMENT")]
    reference: Option<String>,
    /// The library file to write (JSON)
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
}

impl Subset {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if self.keep.is_empty() && self.without.is_empty() {
            return Err(Failure::usage(
                "nothing to leave out",
                "name pigments to keep, or give --without",
            ));
        }
        let output = Output::open(&self.output, std::slice::from_ref(&self.library))?;
        let mut before = library(&self.library)?;
        let file = self.library.display().to_string();
        if let Some(reference) = &self.reference {
            before = with_reference(&file, &before, reference)?;
        }
        let after = subset(&file, &before, &self.keep, &self.without)?;
        if after.pigments.len() < before.pigments.len() && before.evidence.is_some() {
            console.remark(
                "evidence: kept the summary of the whole fit, left out the errors of samples",
            )?;
        }
        output.write(after.to_json())?;
        let names: Vec<&str> = after.pigments.iter().map(|p| p.name.as_str()).collect();
        console.line(format!("{}: {}", self.output.display(), names.join(", ")))
    }
}
