//! `impasto fit`: measurements to a pigment library.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;

use super::calibration_options::CalibrationOptions;
use super::fit_report;
use crate::console::Console;
use crate::input::ViewingOptions;
use crate::output::Output;
use crate::progress::Waiting;

/// Fit K and S of every pigment to measured mixtures, and write the library
///
/// Prints the colour error of every sample: CIEDE2000 between its measured K/S in a film that hides
/// and the fitted mixture (for absolute amounts, between measured and fitted film). K and S do not
/// depend on --illuminant and --observer, which only set under what errors are told.
#[derive(Debug, Args)]
pub(crate) struct Fit {
    #[command(flatten)]
    options: CalibrationOptions,
    /// The library file to write (JSON); without it errors are printed only
    #[arg(short, long, value_name = "LIBRARY")]
    output: Option<PathBuf>,
    /// Title of the library [default: the first file's name]
    #[arg(long)]
    title: Option<String>,
    /// Licence of the figures
    #[arg(long, default_value = "not stated")]
    licence: String,
    /// Where the measurements come from
    #[arg(long, default_value = "not stated")]
    source: String,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: samples, pigments, rms, delta_e, per_sample, warnings, seconds
    #[arg(long)]
    json: bool,
}

impl Fit {
    pub(super) fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        let start = Instant::now();
        let viewing = self.viewing.viewing()?;
        let open = |path| Output::open(path, &self.options.files());
        let output = self.output.as_deref().map(open).transpose()?;
        let job = self.options.job(console)?;
        let waiting = Waiting::new("fitting", console.screen.progress);
        let calibration = job.calibrate(&viewing)?;
        drop(waiting);
        fit_report::remark_films(&calibration, console)?;
        let mut library = calibration.library;
        library.title = self.title.unwrap_or_else(|| stem(&job.inputs[0].path));
        library.licence = self.licence;
        library.source = self.source;
        let text = library.to_json();
        let evidence = library.evidence.as_ref().expect("a fit has evidence");
        if let Some(output) = output {
            output.write(text)?;
        }
        if self.json {
            return console.json(&fit_report::library_json(
                &library,
                evidence,
                start.elapsed().as_secs_f64(),
            ));
        }
        console.warnings(&evidence.warnings)?;
        fit_report::print(&library, evidence, usize::MAX, console)?;
        match &self.output {
            Some(path) => console.remark(format!("written: {}", path.display())),
            None => {
                console.remark("nothing written; give --output LIBRARY.json to keep the library")
            }
        }
    }
}

/// A file's name without folder and ending.
fn stem(path: &str) -> String {
    let stem = Path::new(path).file_stem();
    stem.map_or_else(|| path.to_owned(), |stem| stem.to_string_lossy().into_owned())
}
