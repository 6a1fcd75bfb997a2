//! `impasto paint` paints a recorded script. With `--from` it paints a photograph in strokes, or
//! separates it into pigments if you ask for this.

use std::path::{Path, PathBuf};

use clap::Args;
use documents::{counted, counted_as};
use paint::ground::GroundKind;
use paint::separation::ColorErrors;
use paint::session::ReplayReport;
use pictures::{
    PictureError, PictureOutcome, PictureRequest, PigmentRequest, PlayedSession, ScriptOutcome,
    ScriptRequest, StrokesRequest, TechniqueOutcome, TechniqueRequest, TimelapseOutcome,
};
use serde_json::json;

use super::animation::TimelapseOptions;
use super::engine::EngineOptions;
use super::exports::{Exports, grounds, heard, painted};
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::{VARIABLE, default_path, named_or_default};

/// Paint a script of strokes, or a photograph, with calibrated pigments
///
/// A script (strokes/1, JSON) describes canvas, pigments and brushes, then lists the actions: load,
/// stroke, wipe, dry, light .. The paint is thick and wet, and moves as in Baxter, Wendt and Lin
/// (2004); colour is Kubelka-Munk at eight wavelengths chosen for the light. The same script gives
/// the same paint, to the bit, on every machine and backend.
///
/// With --from, a photograph is separated into pigments and painted stroke by stroke, coarse to
/// fine; --separate writes the amount of each pigment at every pixel, and paints nothing.
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto paint [OPTIONS] <SCRIPT> [LIBRARY]\n       impasto paint [OPTIONS] --from <PHOTO> [LIBRARY]"
)]
pub(crate) struct Paint {
    /// The script (.json), then the pigment library (JSON) [default: the one that the script names, if
    /// it is found beside the script; else the one in IMPASTO_LIBRARY, else the Van Gogh oils that ship].
    /// With --from only the library
    #[arg(required_unless_present = "from", num_args = 1..=2, value_names = ["SCRIPT", "LIBRARY"])]
    words: Vec<PathBuf>,
    /// Old name of LIBRARY
    #[arg(long, value_name = "LIBRARY", hide = true)]
    library: Option<PathBuf>,
    #[command(flatten)]
    engine: EngineOptions,
    #[command(flatten)]
    exports: Exports,
    /// Let a script name its start and pictures of grounds outside of its own folder
    #[arg(long, conflicts_with = "from")]
    allow_outside: bool,
    /// Print JSON: actions, strokes, substeps, cells, backend, canvas; of a timelapse its frames,
    /// frames_found and size
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    timelapse: TimelapseOptions,
    // Must be last: its help heading applies to all options that follow.
    #[command(flatten)]
    photograph: PhotographOptions,
}

impl Paint {
    pub(super) fn run(mut self, console: &mut Console<'_>) -> Result<()> {
        let mut words = std::mem::take(&mut self.words).into_iter();
        let script = if self.photograph.is_present() { None } else { words.next() };
        if let Some(second) = words.next() {
            if let Some(first) = self.library.replace(second.clone()) {
                return Err(two_libraries(&first, &second));
            }
            if let Some(third) = words.next() {
                return Err(two_libraries(&second, &third));
            }
        }
        match script {
            Some(script) => self.script(script, console),
            None => {
                let outcome = painted(&self.request()?, console)?;
                report(&outcome, self.json, console)
            }
        }
    }

    /// The picture that these options ask for, with the library that you name, or else the default one.
    fn request(&self) -> Result<PictureRequest> {
        let library = match &self.library {
            None => named_or_default(None)?.map(|(path, _)| path),
            named => named.clone(),
        };
        let PhotographOptions { from, palette, .. } = &self.photograph;
        let technique = TechniqueRequest::Strokes(self.photograph.strokes());
        let pigments =
            PigmentRequest { library, palette: palette.clone(), ..PigmentRequest::default() };
        let request = PictureRequest::new(from.clone().unwrap_or_default(), technique);
        let exports = self.exports.request();
        Ok(PictureRequest { pigments, exports, device: self.engine.device(), ..request })
    }

    fn script(self, script: PathBuf, console: &mut Console<'_>) -> Result<()> {
        let request = ScriptRequest {
            script,
            library: self.library.clone(),
            default_library: default_path(),
            allow_outside: self.allow_outside,
            exports: self.exports.request(),
            timelapse: self.timelapse.request(),
            undo_memory: self.engine.undo_memory(),
            device: self.engine.device(),
        };
        let mut job =
            heard(console, |task, listener| request.open(task, listener).map_err(refusal))?;
        while let Some(mut session) = job.session(|floor| self.engine.engine(floor, console))? {
            let played =
                heard(console, |task, listener| Ok(job.play(&mut session, task, listener)?))?;
            if let PlayedSession::Painting(report) = &played {
                warn(report, console)?;
            }
            if !self.json {
                print(played, job.outcome(), console)?;
            }
        }
        if !self.json {
            return Ok(());
        }
        console.json(&serde_json::to_value(job.outcome()).expect("JSON holds it"))
    }
}

/// Converts an error of a script. For the default library, the message names its variable.
fn refusal(error: PictureError) -> Failure {
    match error {
        PictureError::DefaultLibrary(error) => {
            Failure::from(error).within(format!("the default library, which {VARIABLE} names"))
        }
        error => error.into(),
    }
}

fn two_libraries(first: &Path, second: &Path) -> Failure {
    let both =
        format!("{} and {} are both named as the library", first.display(), second.display());
    Failure::usage(both, "leave one of them out")
}

/// Warns of undo and redo actions without effect, and of strokes that cannot be undone.
fn warn(report: &ReplayReport, console: &mut Console<'_>) -> Result<()> {
    let ReplayReport { idle, not_undoable, .. } = *report;
    if idle > 0 {
        console.warnings(&[format!(
            "{} had nothing to undo or redo",
            counted(idle, "undo or redo action")
        )])?;
    }
    if not_undoable > 0 {
        console.warnings(&[format!(
            "{} too large to undo (raise --undo-memory)",
            counted_as(not_undoable, "stroke was", "strokes were")
        )])?;
    }
    Ok(())
}

/// Prints the summary of a session of a script.
fn print(played: PlayedSession, outcome: &ScriptOutcome, console: &mut Console<'_>) -> Result<()> {
    match played {
        PlayedSession::Timelapse(TimelapseOutcome { frames, found, size: (width, height) }) => {
            let found = if found > 0 { format!(", {found} found") } else { String::new() };
            let frames = counted(frames, "frame");
            console.line(format!("{frames} of {width} x {height} pixels{found}"))
        }
        PlayedSession::Painting(ReplayReport { actions, strokes, substeps, .. }) => {
            let ScriptOutcome { canvas: (width, height), backend, dry_layers, .. } = outcome;
            console.line(format!(
                "{width} x {height} cells, {}, {} of {}, {}, on {backend}",
                counted(actions, "action"),
                counted(strokes, "stroke"),
                counted(substeps, "sub-step"),
                counted(*dry_layers, "dry layer"),
            ))
        }
    }
}

/// Options for painting a photograph.
#[derive(Debug, Args)]
#[command(next_help_heading = "Photographs")]
pub(crate) struct PhotographOptions {
    /// Paint this photograph (PNG, JPEG, TIFF or WebP; without a colour profile read as sRGB)
    #[arg(long, value_name = "PHOTO")]
    from: Option<PathBuf>,
    /// Up to eight pigments of the library, separated by commas [default: those that come nearest
    /// to the photograph's colours]
    #[arg(long, value_name = "PIGMENTS", requires = "from")]
    palette: Vec<String>,
    /// Width of the painting; its height follows the photograph's shape
    #[arg(long, value_name = "MM", default_value_t = 200.0, requires = "from")]
    width_mm: f64,
    /// Width of a cell; smaller cells show finer relief, half the width takes four times as long
    #[arg(long, value_name = "MM", default_value_t = 0.25, requires = "from")]
    cell_mm: f64,
    /// Ground to paint on
    #[arg(long, value_parser = grounds(), default_value = "linen", requires = "from")]
    ground: GroundKind,
    /// Widths of the brushes in mm, separated by commas; used from the broadest to the finest
    /// [default: 16,8,4,2,1 on 200 mm, and in proportion]
    #[arg(long, value_name = "MM", value_delimiter = ',', requires = "from")]
    brushes: Vec<f64>,
    /// Difference in CIELAB above which an area is painted over; less takes more strokes
    #[arg(long, value_name = "DELTA_E", default_value_t = 6.0, requires = "from")]
    tolerance: f64,
    /// Seed of all random choices
    #[arg(long, value_name = "N", default_value_t = 1, requires = "from")]
    seed: u64,
    /// Write the strokes as a script (.json) that paints the same, bit for bit
    #[arg(long, value_name = "FILE", requires = "from")]
    strokes_out: Option<PathBuf>,
    /// Write a map of each pigment, the picture they make and its colour error into this folder;
    /// paints nothing unless another file is asked for
    #[arg(long, value_name = "FOLDER", requires = "from")]
    separate: Option<PathBuf>,
    /// Let the ground show through in --separate, which reaches lighter and purer colours
    #[arg(long, requires = "separate")]
    thin: bool,
}

impl PhotographOptions {
    /// Whether a photograph is painted.
    pub(super) fn is_present(&self) -> bool {
        self.from.is_some()
    }

    /// Canvas, brushes and further files that these options ask for.
    fn strokes(&self) -> StrokesRequest {
        StrokesRequest {
            width_mm: self.width_mm,
            cell_mm: self.cell_mm,
            ground: self.ground.name().to_owned(),
            brushes_mm: self.brushes.clone(),
            tolerance: self.tolerance,
            seed: self.seed,
            strokes_out: self.strokes_out.clone(),
            separate: self.separate.clone(),
            thin: self.thin,
        }
    }
}

/// Prints the summary of a photograph: of the painting, or of the separation if nothing was painted.
fn report(outcome: &PictureOutcome, as_json: bool, console: &mut Console<'_>) -> Result<()> {
    let PictureOutcome { size: (width, height), backend, technique, pigments, .. } = outcome;
    let TechniqueOutcome::Strokes { levels, error, separation_error, .. } = technique else {
        return Ok(());
    };
    let Some(error) = error else {
        return report_separation(separation_error.as_ref(), pigments, as_json, console);
    };
    if as_json {
        return console.json(&json!({
            "canvas": [width, height],
            "backend": backend,
            "palette": pigments,
            "levels": levels,
            "error": error,
        }));
    }
    console.line(format!(
        "{width} x {height} cells on {backend}, painted with {}",
        pigments.join(", ")
    ))?;
    for level in levels {
        console.line(format!(
            "{} of {} mm: {}, then a mean colour error of {:.2} at its scale",
            level.shape,
            level.size_mm,
            counted(level.strokes, "stroke"),
            level.mean_error
        ))?;
    }
    let finest_mm = levels.last().map_or(0.0, |level| level.size_mm);
    console.line(format!(
        "colour error at the scale of the {finest_mm} mm brush (CIEDE2000): {}",
        error_summary(error)
    ))
}

fn report_separation(
    error: Option<&ColorErrors>,
    pigments: &[String],
    as_json: bool,
    console: &mut Console<'_>,
) -> Result<()> {
    let Some(error) = error else { return Ok(()) };
    if as_json {
        return console.json(&json!({"palette": pigments, "error": error}));
    }
    console.line(format!("separated into {}", pigments.join(", ")))?;
    console.line(format!("colour error (CIEDE2000): {}", error_summary(error)))
}

/// Formats colour errors in one line.
fn error_summary(errors: &ColorErrors) -> String {
    let ColorErrors { mean, median, p95, max, out_of_gamut, .. } = errors;
    format!(
        "mean {mean:.2}, median {median:.2}, 95th percentile {p95:.2}, largest {max:.2}; {:.1} % out of gamut",
        100.0 * out_of_gamut
    )
}
