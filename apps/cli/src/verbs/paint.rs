//! `impasto paint` paints a recorded script. With `--from` it paints a photograph in strokes, or
//! separates it into pigments if you ask for this.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use calibrate::library::PigmentLibrary;
use clap::Args;
use documents::{counted, counted_as};
use graphics::export::{PictureFormat, picture_file};
use paint::document::Document;
use paint::file;
use paint::ground::GroundKind;
use paint::painting::Painting;
use paint::separation::ColorErrors;
use paint::session::{PaintingSession, ReplayError, ReplayReport};
use paint::strokes::{Action, ScriptLibrary, SideTable, StrokeScript};
use pictures::{
    PictureOutcome, PictureRequest, PigmentRequest, StrokesRequest, TechniqueOutcome,
    TechniqueRequest, gamut_remark,
};
use serde_json::{Map, Value, json};

use crate::animation::{TimelapseOptions, TimelapseReport};
use crate::console::Console;
use crate::engine::EngineOptions;
use crate::failure::{Context, Failure, Result};
use crate::library_choice::{named_or_default, quietly_chosen};
use crate::output::{Output, OutputFolder, create_folder};
use crate::pictures::{Exports, grounds, painted};
use crate::progress::Progress;
use crate::readings::library;

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
            Some(script) => self.script(&script, console),
            None => {
                let outcome = painted(&self.request()?, console)?;
                report(&outcome, self.json, console)
            }
        }
    }

    /// The picture of these options, with the library that you name, else the default one.
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

    fn script(self, path: &Path, console: &mut Console<'_>) -> Result<()> {
        let name = path.display().to_string();
        let bytes = documents::file::read(path)?;
        let mut script = StrokeScript::from_json(&name, &bytes)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).to_owned();
        let start = self.start(&script, &folder)?;
        let library = match &start {
            Some((_, start, _)) => start.library.clone(),
            None => self.script_library(&script, &folder, console)?,
        };
        script.resolve(&library)?;
        let saves = script.actions.iter().any(|action| matches!(action, Action::Save { .. }));
        let mut inputs = vec![path.to_owned()];
        inputs.extend(self.library.clone());
        inputs.extend(script.complete_picture_paths(&folder));
        inputs.extend(start.iter().map(|(path, ..)| path.clone()));
        let paints = self.exports.any() || saves;
        let json = self.json;
        let exports = self.exports.open(&inputs)?;
        let timelapse = self.timelapse.open(&inputs, |output| exports.writes(output))?;
        if !paints && timelapse.is_none() {
            return Err(Failure::usage(
                "nothing would be written",
                "add --picture painting.png, or --output painting.exr",
            ));
        }
        let plan = timelapse.as_ref().map(|timelapse| timelapse.plan(&script)).transpose()?;
        check_saves(&script, &folder, &inputs).context(|| name.clone())?;
        let (start, table) = start.map(|(_, start, table)| (start, table)).unzip();
        let (canvas, palette, brushes) =
            script.surfaces_with_table(&library, start, table.flatten())?;
        let mut summary = Map::new();
        if let (Some(timelapse), Some(plan)) = (&timelapse, &plan) {
            let canvas = canvas.clone();
            let palette = palette.clone();
            let mut session = open_session(&self.engine, canvas, palette, console)?;
            session.take_up(&brushes)?;
            let report = timelapse.write(plan, &mut session, console);
            let report = report.map_err(|failure| failure.within(&name))?;
            print_timelapse(&report, session.canvas(), &mut summary, json, console)?;
        }
        if paints {
            let mut session = open_session(&self.engine, canvas, palette, console)?;
            for brush in session.take_up(&brushes)? {
                console
                    .remark(format!("the brush `{brush}` has another head now and begins clean"))?;
            }
            let kept = brushes.iter().filter(|brush| brush.paint.is_some());
            let kept = kept.map(|brush| brush.name.as_str()).collect();
            for (index, brush) in script.unloaded_brushes(&kept) {
                console.remark(format!(
                    "{name}, action {index}: the brush `{brush}` paints before it was loaded, so it only moves paint that lies there"
                ))?;
            }
            let report = play(&script, &mut session, (&folder, &inputs), console);
            let report = report.map_err(|failure| failure.within(&name))?;
            exports.write(session.canvas_mut(), console)?;
            print(&report, session.canvas(), &mut summary, json, console)?;
        }
        if json { console.json(&Value::Object(summary)) } else { Ok(()) }
    }

    /// Opens the painting that the script continues, if it continues one, and the table beside it
    /// if the script asks for that.
    fn start(&self, script: &StrokeScript, folder: &Path) -> Result<Option<Start>> {
        let Some(start) = &script.start else { return Ok(None) };
        if self.library.is_some() {
            return Err(Failure::usage(
                format!("the script continues {start}, which has its own library"),
                "leave LIBRARY out",
            ));
        }
        let path = folder.join(start);
        let name = path.display().to_string();
        let bytes = documents::file::read(&path)?;
        let document = file::read(&name, &bytes)?;
        let table = if script.table { file::read_table(&name, &bytes)? } else { None };
        Ok(Some((path, document, table)))
    }

    /// The library that you name, else the one that the script names, else the default one.
    fn script_library(
        &self,
        script: &StrokeScript,
        folder: &Path,
        console: &mut Console<'_>,
    ) -> Result<PigmentLibrary> {
        if let Some(path) = &self.library {
            return library(path);
        }
        if script.library.is_none() {
            return Ok(quietly_chosen(None, console)?.library);
        }
        let ScriptLibrary { library, missing } = script.open_library(folder)?;
        if let Some(missing) = missing {
            console.warnings(&[format!(
                "the script names the library `{missing}`, which was not found; using the built-in oils (name another after the script)"
            )])?;
        }
        Ok(library)
    }
}

fn two_libraries(first: &Path, second: &Path) -> Failure {
    let both =
        format!("{} and {} are both named as the library", first.display(), second.display());
    Failure::usage(both, "leave one of them out")
}

/// Plays the script on `session`. Its files are saved below `folder`, and none of `inputs` is
/// overwritten.
fn play(
    script: &StrokeScript,
    session: &mut PaintingSession,
    (folder, inputs): (&Path, &[PathBuf]),
    console: &mut Console<'_>,
) -> Result<ReplayReport> {
    let bar = Progress::new(script.actions.len(), "painting", console.shows_progress());
    let mut remarks = Vec::new();
    let report = script.replay(
        session,
        |path, painting| save(folder, path, inputs, painting, &mut remarks).map_err(SaveFailure),
        || {
            bar.step();
            ControlFlow::Continue(())
        },
    );
    bar.done();
    for remark in remarks {
        console.remark(remark)?;
    }
    report.map_err(replay_failure)
}

/// Opens a painting session with the canvas and, if given, the palette.
fn open_session(
    engine: &EngineOptions,
    canvas: Document,
    palette: Option<Document>,
    console: &mut Console<'_>,
) -> Result<PaintingSession> {
    let undo_bytes = engine.undo_bytes();
    let backend = engine.engine(&canvas.ground.height, console)?;
    let canvas = Painting::open(canvas, backend, undo_bytes)?;
    let Some(palette) = palette else { return Ok(PaintingSession::new(canvas, None)?) };
    let backend = engine.engine(&palette.ground.height, console)?;
    let palette = Painting::open_under(palette, canvas.light().clone(), backend, undo_bytes)?;
    let mut session = PaintingSession::new(canvas, Some(palette))?;
    session.set_undo_bytes(undo_bytes);
    Ok(session)
}

/// Path of the painting that a script continues, the painting, and the table beside it.
type Start = (PathBuf, Document, Option<SideTable>);

/// Failure of a save action, in the form that the replay of a script returns.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct SaveFailure(Failure);

/// Converts the error of a replay, naming the action that failed.
fn replay_failure(error: ReplayError<SaveFailure>) -> Failure {
    match error {
        ReplayError::Script(error) => error.into(),
        ReplayError::Action { index, kind, error } => {
            Failure::from(*error).within(format!("action {index} ({kind})"))
        }
        ReplayError::Save { index, error: SaveFailure(failure) } => {
            failure.within(format!("action {index} (save)"))
        }
    }
}

/// Checks, before painting, that every file that the script saves can be written.
fn check_saves(script: &StrokeScript, folder: &Path, inputs: &[PathBuf]) -> Result<()> {
    let mut checked = BTreeSet::new();
    for (index, action) in script.actions.iter().enumerate() {
        if let Action::Save { path } = action
            && checked.insert(path)
        {
            check_save(&folder.join(path), inputs).context(|| format!("action {index} (save)"))?;
        }
    }
    Ok(())
}

/// Checks that you can write a file in a folder that we make later.
fn check_save(path: &Path, inputs: &[PathBuf]) -> Result<()> {
    match (path.parent(), path.file_name().and_then(|name| name.to_str())) {
        (Some(parent), Some(name)) if !parent.exists() && parent != Path::new("") => {
            OutputFolder::open(parent, inputs)?.check([name.to_owned()])
        }
        _ => Output::open(path, inputs).map(drop),
    }
}

/// Opens the file of a save action, with a path relative to the script's folder.
fn open_save(folder: &Path, path: &str, inputs: &[PathBuf]) -> Result<Output> {
    let path = folder.join(path);
    if let Some(parent) = path.parent() {
        create_folder(parent)?;
    }
    Output::open(&path, inputs)
}

/// Carries out a save action of the script: a PNG picture, or the painting itself.
fn save(
    folder: &Path,
    path: &str,
    inputs: &[PathBuf],
    painting: &mut Painting,
    remarks: &mut Vec<String>,
) -> Result<()> {
    let output = open_save(folder, path, inputs)?;
    let path = output.path();
    let bytes = if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        let picture = painting.picture()?;
        let file = picture_file(&picture, painting.cell_mm(), PictureFormat::Png8)?;
        remarks.extend(file.outside_gamut().map(|outside| gamut_remark(path, outside).to_string()));
        file.bytes
    } else {
        file::write(&painting.document()?)?
    };
    output.put(bytes)?;
    let wrote = format!("Wrote {}", output.path().display());
    // A script may save one file many times.
    if !remarks.contains(&wrote) {
        remarks.push(wrote);
    }
    Ok(())
}

/// Prints the summary of a replay, or adds it to `summary`.
fn print(
    report: &ReplayReport,
    painting: &Painting,
    summary: &mut Map<String, Value>,
    as_json: bool,
    console: &mut Console<'_>,
) -> Result<()> {
    let bounds = painting.bounds();
    let ReplayReport { actions, strokes, substeps, cells, idle, not_undoable } = *report;
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
    if as_json {
        let counts = [("actions", actions), ("strokes", strokes), ("substeps", substeps)];
        for (name, count) in counts.into_iter().chain([("cells", cells)]) {
            summary.insert(name.to_owned(), count.into());
        }
        add_canvas(summary, painting);
        return Ok(());
    }
    console.line(format!(
        "{} x {} cells, {}, {} of {}, {}, on {}",
        bounds.width,
        bounds.height,
        counted(actions, "action"),
        counted(strokes, "stroke"),
        counted(substeps, "sub-step"),
        counted(painting.state().dry.len(), "dry layer"),
        painting.backend(),
    ))
}

/// Prints the summary of a timelapse, or adds it to `summary`.
fn print_timelapse(
    report: &TimelapseReport,
    painting: &Painting,
    summary: &mut Map<String, Value>,
    as_json: bool,
    console: &mut Console<'_>,
) -> Result<()> {
    let TimelapseReport { frames, found, size: (width, height) } = *report;
    if as_json {
        summary.insert("frames".to_owned(), frames.into());
        summary.insert("frames_found".to_owned(), found.into());
        summary.insert("size".to_owned(), json!([width, height]));
        add_canvas(summary, painting);
        return Ok(());
    }
    let found = if found > 0 { format!(", {found} found") } else { String::new() };
    let frames = counted(frames, "frame");
    console.line(format!("{frames} of {width} x {height} pixels{found}"))
}

fn add_canvas(summary: &mut Map<String, Value>, painting: &Painting) {
    let bounds = painting.bounds();
    summary.insert("backend".to_owned(), painting.backend().into());
    summary.insert("canvas".to_owned(), json!([bounds.width, bounds.height]));
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

    /// Canvas, brushes and further files of these options.
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
