//! `impasto identify`: which pigments of a library explain spectra that were measured at points.

use std::path::{Path, PathBuf};

use clap::{Arg, Args};
use documents::file::{FileError, is_there};
use maps::IdentifyRequest;
use spectra::instrument::split_file_and_name;

use super::map::{failure, of_pigments};
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::chosen;
use crate::readings::{ReadingOptions, select_spectra};
use crate::request_options::{CommandLine, RequestOptions};

/// Identify the pigments of a library in spectra measured at points
///
/// For every spectrum, for example of a fibre-optic spectrometer (FORS), you learn which pigments are there,
/// their shares with standard deviations, how probable each pigment and each set of pigments is, and how well
/// their mixture explains the spectrum. We assume that the paint hides its ground and mixes by two-constant
/// Kubelka-Munk, as `map` does for scans. Every spectrum is compared with all sets of pigments and stands for
/// itself. Pigments that its wavelengths cannot tell apart count as one. Tested on measured swatches only.
#[derive(Debug, Args)]
pub(crate) struct Identify {
    /// The spectra: a CSV (column `sample`, then wavelengths) or an instrument's file; FILE#NAME for one of them
    spots: String,
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else the Van Gogh oils that ship]
    library: Option<PathBuf>,
    #[command(flatten, next_help_heading = "Pigments")]
    request: RequestOptions<IdentifyRequest>,
    #[command(flatten, next_help_heading = "Reading the spectra")]
    reading: ReadingOptions,
    /// Print JSON: of each spectrum pigments, sets, chi2, rms, and both curves
    #[arg(long, help_heading = None)]
    json: bool,
    /// Print a row for each pigment of each set as CSV
    #[arg(long, conflicts_with = "json", help_heading = None)]
    csv: bool,
}

impl CommandLine for IdentifyRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "sets" => option.value_name("N").hide_default_value(true),
            _ => of_pigments(key, option),
        }
    }
}

impl Identify {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let request = self.request.request()?;
        self.check_order()?;
        let library = chosen(self.library.as_deref(), console)?.library;
        let Some(selected) = select_spectra(&self.spots, &self.reading, console)? else {
            let (file, _) = split_file_and_name(&self.spots);
            let missing = std::io::Error::from(std::io::ErrorKind::NotFound);
            return Err(FileError::reading(Path::new(file), missing).into());
        };
        let found = request.run(&library, &selected.averaged).map_err(failure)?;
        console.remarks(&found.remarks)?;
        if self.csv {
            return console.csv_rows(&found.rows());
        }
        if self.json {
            return console.json(&found.to_json());
        }
        for group in &found.groups {
            console.line(format!("counted as one: {}", group.pigments.join(", ")))?;
        }
        for line in found.spectra.iter().flat_map(|spectrum| spectrum.lines()) {
            console.line(line)?;
        }
        Ok(())
    }

    /// Refuses a library in the place of the spectra.
    fn check_order(&self) -> Result<()> {
        let Some(second) = &self.library else { return Ok(()) };
        let is_json = |path: &Path| path.extension().is_some_and(|end| end == "json");
        if is_json(Path::new(&self.spots)) && !is_json(second) && is_there(second) {
            return Err(Failure::usage(
                "the spectra go first, the library after them",
                format!("impasto identify {} {}", second.display(), self.spots),
            ));
        }
        Ok(())
    }
}
