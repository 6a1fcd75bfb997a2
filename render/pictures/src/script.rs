//! A script of strokes: the request, its job and its outcome. The job replays the script, writes the files that
//! the script saves, exports the painting, and writes a timelapse.

use std::{
    collections::BTreeSet,
    mem,
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use calibrate::{Remark, library::PigmentLibrary};
use documents::{
    Task,
    file::{self, NamedFiles, Output, Outside, create_folder},
};
use graphics::{
    export::{PictureFormat, picture_file},
    field::Field,
    picture_formats::begins_like_picture,
};
use paint::{
    document::Document,
    engine::PaintEngine,
    file as painting_file,
    painting::Painting,
    session::{PaintingSession, ReplayError, ReplayReport},
    strokes::{Action, KeptBrush, ScriptLibrary, SideTable, StrokeScript},
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer, ser::SerializeMap};

use crate::error::{PictureError, SettingError};
use crate::exports::{ExportRequest, Listener, Note, OpenExports, Written, gamut_remark};
use crate::relight::{opened_engine, undo_bytes, undo_memory};
use crate::request::Device;
use crate::timelapse::{OpenTimelapse, TimelapseOutcome, TimelapseRequest};

/// A script of strokes to paint. [`Self::run`] paints it.
///
/// All keys but `script` have defaults. As JSON:
///
/// ```
/// use documents::Task;
/// use documents::request::request_from_json;
/// use pictures::ScriptRequest;
///
/// let folder = tempfile::tempdir()?;
/// let script = folder.path().join("one-stroke.json");
/// std::fs::write(
///     &script,
///     r#"{
///         "format": "strokes", "version": 1, "title": "One stroke",
///         "canvas": {"width_mm": 8, "height_mm": 6, "cell_mm": 0.5},
///         "palette": {"W": "Lead White"},
///         "brushes": {"flat": {"shape": "flat", "size_mm": 3}},
///         "actions": [
///             {"load": {"brush": "flat", "recipe": {"W": 1}, "amount_mm": 0.3}},
///             {"stroke": {"brush": "flat", "samples": [[0, 2, 3, 0.5], [0.2, 6, 3, 0.5]]}}
///         ]
///     }"#,
/// )?;
/// let painting = folder.path().join("one-stroke.exr");
/// let json = format!(
///     r#"{{"script": {script:?}, "exports": {{"output": [{painting:?}]}}, "device": "cpu"}}"#
/// );
/// let outcome = request_from_json::<ScriptRequest>(&json)?.run(&Task::default())?;
/// assert_eq!(outcome.canvas, (16, 12));
/// assert_eq!(outcome.replay.map(|replay| replay.strokes), Some(1));
/// assert_eq!(outcome.files, [painting]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(description = "A script of strokes to paint")]
pub struct ScriptRequest {
    /// The script (.json)
    pub script: PathBuf,
    /// Library of the pigments [default: the one that the script names, if it is found beside the script].
    /// Leave it out for a script that continues a painting, which has its own library
    #[serde(default)]
    pub library: Option<PathBuf>,
    /// Library for a script that names no library [default: the Van Gogh oils that ship]
    #[serde(default)]
    pub default_library: Option<PathBuf>,
    /// Let the script name the painting that it continues, and pictures of grounds, outside of its own folder.
    /// Without this, these files must lie in that folder or below
    #[serde(default)]
    pub allow_outside: bool,
    /// Files of the painting
    #[serde(default)]
    pub exports: ExportRequest,
    /// File and frames of a timelapse
    #[serde(default)]
    pub timelapse: TimelapseRequest,
    /// Memory for undo in MiB, 0 to 1048576. When it is full, the oldest steps are dropped
    #[serde(default = "undo_memory")]
    pub undo_memory: u64,
    /// Device to compute on
    #[serde(default)]
    pub device: Device,
}

impl ScriptRequest {
    /// A request that writes only the files that the script saves.
    #[must_use]
    pub fn new(script: impl Into<PathBuf>) -> Self {
        Self {
            script: script.into(),
            library: None,
            default_library: None,
            allow_outside: false,
            exports: ExportRequest::default(),
            timelapse: TimelapseRequest::default(),
            undo_memory: undo_memory(),
            device: Device::default(),
        }
    }

    /// Checks the request and the script, paints the script, and writes all files. None of them replaces a file that
    /// the request reads, and nothing is written before everything is checked. `task` may end the work.
    ///
    /// # Errors
    /// [`PictureError`] for a setting that cannot be used, a file that cannot be read or written, a script that
    /// cannot be painted, and if `task` is cancelled.
    pub fn run(&self, task: &Task) -> Result<ScriptOutcome, PictureError> {
        let mut job = self.open(task, &mut |_| {})?;
        let mut warnings = Vec::new();
        while let Some(mut session) =
            job.session(|floor| opened_engine(self.device, floor, &mut |note| warnings.push(note)))?
        {
            for note in mem::take(&mut warnings) {
                job.written.pass(note, &mut |_| {});
            }
            job.play(&mut session, task, &mut |_| {})?;
        }
        Ok(job.finish())
    }

    /// Reads the script and all that it needs, and checks that its files can be written. Use this if you want to open
    /// the engines yourself, or to hear of each file when it is written.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn open(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<ScriptJob, PictureError> {
        let undo_bytes = undo_bytes(self.undo_memory)?;
        task.check()?;
        let mut written = Written::default();
        let path = &self.script;
        let name = path.display().to_string();
        let bytes = file::read(path)?;
        if begins_like_picture(&bytes) {
            let message = format!("{name} is a picture, not a script");
            let hint = "a picture is painted in strokes with [from], and a script is JSON";
            return Err(PictureError::Data { message, hint });
        }
        let mut script = StrokeScript::from_json(&name, &bytes)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).to_owned();
        let mut files = NamedFiles::of(path, Outside::allowed_if(self.allow_outside));
        let start = self.start(&script, &mut files)?;
        let library = match &start {
            Some((start, _)) => start.library.clone(),
            None => self.library_of(&script, &folder, &mut |note| written.pass(note, listener))?,
        };
        script.resolve(&library).map_err(|error| error.in_file(&name))?;
        let saves = script.actions.iter().any(|action| matches!(action, Action::Save { .. }));
        let mut inputs = vec![path.clone()];
        inputs.extend(self.library.clone());
        script.complete_picture_paths(&mut files)?;
        inputs.extend(files.found().iter().cloned());
        inputs.extend(script.library.iter().map(|library| folder.join(library)));
        let paints = self.exports.any() || saves;
        let exports = self.exports.clone().open(&inputs)?;
        let timelapse = self.timelapse.open(&inputs, &exports)?;
        if !paints && timelapse.is_none() {
            let hint = "add [picture=painting.png], or [output=painting.exr]";
            return Err(SettingError::whole("nothing would be written", hint).into());
        }
        if let Some(timelapse) = &timelapse {
            timelapse.plan(&script)?;
        }
        check_saves(&script, &folder, &inputs).map_err(|error| error.within(&name))?;
        let (start, table) = start.unzip();
        let (canvas, palette, brushes) =
            script.surfaces_with_table(&library, start, table.flatten())?;
        let exports = paints.then_some(exports);
        let surfaces = Surfaces { canvas, palette };
        let surfaces = match (&timelapse, &exports) {
            (Some(_), Some(_)) => vec![surfaces.clone(), surfaces],
            _ => vec![surfaces],
        };
        let outcome = ScriptOutcome::default();
        Ok(ScriptJob {
            name,
            script,
            folder,
            inputs,
            surfaces,
            brushes,
            undo_bytes,
            timelapse,
            exports,
            outcome,
            written,
        })
    }

    /// Opens the painting that the script continues, if there is one, and the table beside it if the
    /// script asks for the table.
    fn start(
        &self,
        script: &StrokeScript,
        files: &mut NamedFiles,
    ) -> Result<Option<Start>, PictureError> {
        let Some(start) = &script.start else { return Ok(None) };
        if self.library.is_some() {
            let message = format!("the script continues {start}, which has its own library");
            return Err(SettingError::whole(message, "leave [library] out").into());
        }
        let path = files.find("start", start)?;
        let name = path.display().to_string();
        let bytes = file::read(&path)?;
        let document = painting_file::read(&name, &bytes)?;
        let table = if script.table { painting_file::read_table(&name, &bytes)? } else { None };
        Ok(Some((document, table)))
    }

    /// The library that the request names, else the one that the script names, else the default one.
    fn library_of(
        &self,
        script: &StrokeScript,
        folder: &Path,
        listener: &mut Listener<'_>,
    ) -> Result<PigmentLibrary, PictureError> {
        if let Some(path) = &self.library {
            return Ok(PigmentLibrary::open(path)?);
        }
        if let (None, Some(path)) = (&script.library, &self.default_library) {
            let library = PigmentLibrary::open(path).map_err(PictureError::DefaultLibrary)?;
            listener(Note::Library { path: path.clone(), pigments: library.pigments.len() });
            return Ok(library);
        }
        let ScriptLibrary { library, missing } = script.open_library(folder)?;
        if let Some(missing) = missing {
            listener(Note::Remark(Remark::warning(format!(
                "the script names the library `{missing}`, which was not found; using the built-in oils (name another after the script)"
            ))));
        }
        Ok(library)
    }
}

/// The painting that a script continues, and the table beside it.
type Start = (Document, Option<SideTable>);

/// The canvas on which a script begins, and the palette if the script has one.
#[derive(Debug, Clone)]
struct Surfaces {
    canvas: Document,
    palette: Option<Document>,
}

/// A script that can be painted: it was read, and its files can be written. You play it in one or two sessions: the
/// timelapse first, then the painting.
///
/// ```text
/// while let Some(session) = job.session(..)? { job.play(&mut session, ..)? }
/// let outcome = job.finish();
/// ```
#[derive(Debug)]
pub struct ScriptJob {
    /// Path of the script.
    name: String,
    script: StrokeScript,
    /// Folder of the script.
    folder: PathBuf,
    inputs: Vec<PathBuf>,
    /// One for each session that is still to be played.
    surfaces: Vec<Surfaces>,
    brushes: Vec<KeptBrush>,
    undo_bytes: u64,
    timelapse: Option<OpenTimelapse>,
    exports: Option<OpenExports>,
    outcome: ScriptOutcome,
    written: Written,
}

/// A session that was played.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlayedSession {
    /// The timelapse was written.
    Timelapse(TimelapseOutcome),
    /// The script was painted, and its files were written.
    Painting(ReplayReport),
}

impl ScriptJob {
    /// Opens the next session, in the state in which the script begins. `engine` must open an engine over the
    /// heights of the ground that we pass to it, in quanta. Returns `None` after the last session.
    ///
    /// # Errors
    /// The errors of `engine`, and [`PictureError`] if a device was lost.
    pub fn session<E: From<PictureError>>(
        &mut self,
        mut engine: impl FnMut(&Field<i32>) -> Result<PaintEngine, E>,
    ) -> Result<Option<PaintingSession>, E> {
        let Some(Surfaces { canvas, palette }) = self.surfaces.pop() else { return Ok(None) };
        let undo_bytes = self.undo_bytes;
        let backend = engine(&canvas.ground.height)?;
        let canvas = Painting::open(canvas, backend, undo_bytes).map_err(PictureError::from)?;
        let Some(palette) = palette else {
            return Ok(Some(PaintingSession::new(canvas, None).map_err(PictureError::from)?));
        };
        let backend = engine(&palette.ground.height)?;
        let palette = Painting::open_under(palette, canvas.light().clone(), backend, undo_bytes);
        let palette = palette.map_err(PictureError::from)?;
        let session = PaintingSession::new(canvas, Some(palette));
        let mut session = session.map_err(PictureError::from)?;
        session.set_undo_bytes(undo_bytes);
        Ok(Some(session))
    }

    /// Plays the script on the session that [`Self::session`] gave you last, and writes the files of this session.
    ///
    /// # Errors
    /// The errors of [`ScriptRequest::run`].
    pub fn play(
        &mut self,
        session: &mut PaintingSession,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<PlayedSession, PictureError> {
        let mut written = mem::take(&mut self.written);
        let mut collect = |note: Note| written.pass(note, listener);
        let played = match self.timelapse.take() {
            Some(timelapse) => self.write_timelapse(&timelapse, session, task, &mut collect),
            None => self.paint(session, task, &mut collect),
        };
        self.written = written;
        let canvas = session.canvas();
        let bounds = canvas.bounds();
        self.outcome.canvas = (bounds.width, bounds.height);
        self.outcome.backend = canvas.backend();
        self.outcome.dry_layers = canvas.state().dry.len();
        played
    }

    /// The result of the sessions that were played so far.
    #[must_use]
    pub fn outcome(&self) -> &ScriptOutcome {
        &self.outcome
    }

    /// The result with the files and remarks of all sessions.
    #[must_use]
    pub fn finish(self) -> ScriptOutcome {
        let Written { remarks, files, streamed } = self.written;
        ScriptOutcome { remarks, files, streamed, ..self.outcome }
    }

    fn write_timelapse(
        &mut self,
        timelapse: &OpenTimelapse,
        session: &mut PaintingSession,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<PlayedSession, PictureError> {
        session.take_up(&self.brushes)?;
        let written = timelapse.write(&self.script, session, task, listener);
        let written = written.map_err(|error| error.within(&self.name))?;
        self.outcome.timelapse = Some(written);
        Ok(PlayedSession::Timelapse(written))
    }

    fn paint(
        &mut self,
        session: &mut PaintingSession,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<PlayedSession, PictureError> {
        let name = &self.name;
        for brush in session.take_up(&self.brushes)? {
            listener(Note::Remark(Remark::note(format!(
                "the brush `{brush}` has another head now and begins clean"
            ))));
        }
        let loaded = self.brushes.iter().filter(|brush| brush.paint.is_some());
        let loaded = loaded.map(|brush| brush.name.as_str()).collect();
        for (index, brush) in self.script.unloaded_brushes(&loaded) {
            listener(Note::Remark(Remark::note(format!(
                "{name}, action {}: the brush `{brush}` paints before it was loaded, so it only moves paint that lies there",
                index + 1
            ))));
        }
        let replay = self.replay(session, task, listener);
        let replay = replay.map_err(|error| error.within(name))?;
        task.check()?;
        if let Some(exports) = self.exports.take() {
            exports.write(session.canvas_mut(), task, listener)?;
        }
        self.outcome.replay = Some(replay);
        Ok(PlayedSession::Painting(replay))
    }

    /// Plays the actions of the script, and saves its files below its folder.
    fn replay(
        &self,
        session: &mut PaintingSession,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<ReplayReport, PictureError> {
        task.stage("painting");
        let steps = task.steps(self.script.actions.len());
        let mut saved = BTreeSet::new();
        let report = self.script.replay(
            session,
            |path, painting| {
                let (output, replaced) = self.save(path, painting, listener)?;
                // A script may save one file many times.
                if saved.insert(output.path().to_owned()) {
                    if replaced {
                        let path = output.path().display();
                        let note = format!("{path}: the script replaced this file");
                        listener(Note::Remark(Remark::note(note)));
                    }
                    listener(Note::Wrote(output.path().to_owned()));
                }
                Ok(())
            },
            || {
                steps.step();
                if task.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        );
        report.map_err(replay_error)
    }

    /// Carries out a save action of the script: a PNG picture, or the painting itself. Returns also whether a file lay
    /// there before.
    fn save(
        &self,
        path: &str,
        painting: &mut Painting,
        listener: &mut Listener<'_>,
    ) -> Result<(Output, bool), PictureError> {
        let output = Output::below(&self.folder, Path::new(path), &self.inputs)?;
        if let Some(parent) = output.path().parent() {
            create_folder(parent)?;
        }
        let path = output.path();
        let bytes = if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
            let picture = painting.picture()?;
            let file = picture_file(&picture, painting.cell_mm(), PictureFormat::Png8)?;
            if let Some(outside) = file.outside_gamut() {
                listener(Note::Remark(gamut_remark(path, outside)));
            }
            file.bytes
        } else {
            painting_file::write(&painting.document()?)?
        };
        let replaces = output.replaces();
        output.put(bytes)?;
        Ok((output, replaces))
    }
}

/// The error of a replay, with the name of the action that failed.
fn replay_error(error: ReplayError<PictureError>) -> PictureError {
    match error {
        ReplayError::Script(error) => error.into(),
        ReplayError::Action { index, kind, error } => {
            PictureError::from(*error).within(format!("action {} ({kind})", index + 1))
        }
        ReplayError::Save(index, error) => error.within(format!("action {} (save)", index + 1)),
    }
}

/// Checks, before painting, that every file that the script saves can be written.
fn check_saves(
    script: &StrokeScript,
    folder: &Path,
    inputs: &[PathBuf],
) -> Result<(), PictureError> {
    let mut checked = BTreeSet::new();
    for (index, action) in script.actions.iter().enumerate() {
        if let Action::Save { path } = action
            && checked.insert(path)
        {
            let output = Output::below(folder, Path::new(path), inputs);
            output.map_err(|error| {
                PictureError::from(error).within(format!("action {} (save)", index + 1))
            })?;
        }
    }
    Ok(())
}

/// A script that was painted, and its files.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScriptOutcome {
    /// Figures of the timelapse, if one was written.
    pub timelapse: Option<TimelapseOutcome>,
    /// Counts of the replay. `None` if you ask only for a timelapse.
    pub replay: Option<ReplayReport>,
    /// Name of the processor or device.
    pub backend: String,
    /// Width and height in cells.
    pub canvas: (usize, usize),
    /// Number of dry layers at the end.
    pub dry_layers: usize,
    /// Remarks on what was read or chosen, and on colours that a file cannot hold.
    pub remarks: Vec<String>,
    /// Files and folders that were written, in the order in which they were first written.
    pub files: Vec<PathBuf>,
    /// The content of a file with the path `-`.
    pub streamed: Option<Vec<u8>>,
}

impl Serialize for ScriptOutcome {
    /// Writes the keys of the timelapse, then the keys of the replay. The keys `backend` and `canvas` stand after
    /// the first of these groups that is there.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut keys = serializer.serialize_map(None)?;
        if let Some(TimelapseOutcome { frames, found, size }) = &self.timelapse {
            keys.serialize_entry("frames", frames)?;
            keys.serialize_entry("frames_found", found)?;
            keys.serialize_entry("size", size)?;
            keys.serialize_entry("backend", &self.backend)?;
            keys.serialize_entry("canvas", &self.canvas)?;
        }
        if let Some(ReplayReport { actions, strokes, substeps, cells, .. }) = &self.replay {
            keys.serialize_entry("actions", actions)?;
            keys.serialize_entry("strokes", strokes)?;
            keys.serialize_entry("substeps", substeps)?;
            keys.serialize_entry("cells", cells)?;
        }
        if self.timelapse.is_none() {
            keys.serialize_entry("backend", &self.backend)?;
            keys.serialize_entry("canvas", &self.canvas)?;
        }
        keys.end()
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error as _;

    use super::*;
    use documents::hint::Explain;
    use documents::request::request_from_json;

    /// One stroke on a canvas of 16 x 12 cells, which the script saves as `saved/a.png`.
    const SCRIPT: &str = r#"{
        "format": "strokes", "version": 1, "title": "One stroke",
        "canvas": {"width_mm": 8, "height_mm": 6, "cell_mm": 0.5},
        "palette": {"W": "Lead White", "B": "Prussian Blue"},
        "brushes": {"flat": {"shape": "flat", "size_mm": 3}},
        "actions": [
            {"load": {"brush": "flat", "recipe": {"B": 1}, "amount_mm": 0.3}},
            {"stroke": {"brush": "flat", "samples": [[0, 2, 3, 0.5], [0.2, 6, 3, 0.5]]}},
            {"save": {"path": "saved/a.png"}},
            {"save": {"path": "saved/a.png"}}
        ]
    }"#;

    fn request_of(folder: &Path, text: &str) -> ScriptRequest {
        let script = folder.join("one-stroke.json");
        std::fs::write(&script, text).unwrap();
        ScriptRequest { device: Device::Cpu, ..ScriptRequest::new(script) }
    }

    fn keys(outcome: &ScriptOutcome) -> String {
        let json = serde_json::to_value(outcome).unwrap();
        let keys: Vec<&str> = json.as_object().unwrap().keys().map(String::as_str).collect();
        keys.join(" ")
    }

    #[test]
    fn a_script_is_painted_with_its_saves_exports_and_a_timelapse() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        let mut request = request_of(folder.path(), SCRIPT);
        let saved = request.run(&Task::default()).unwrap();
        assert_eq!(saved.files, [file("saved/a.png")]);
        assert_eq!(keys(&saved), "actions strokes substeps cells backend canvas");
        let replaced = |outcome: &ScriptOutcome| {
            let remarks = outcome.remarks.iter();
            remarks.filter(|r| r.ends_with("saved/a.png: the script replaced this file")).count()
        };
        assert_eq!(replaced(&saved), 0, "{:?}", saved.remarks);
        let again = request.run(&Task::default()).unwrap();
        assert_eq!(replaced(&again), 1, "{:?}", again.remarks);

        request.exports.picture = Some(file("b.png"));
        request.timelapse.file = Some(file("film.gif"));
        request.timelapse.every = Some(1);
        let both = request.run(&Task::default()).unwrap();
        let files = ["film.frames", "film.gif", "saved/a.png", "b.png"].map(file);
        assert_eq!(both.files, files);
        assert_eq!(both.canvas, (16, 12));
        let frames = both.timelapse.map(|timelapse| (timelapse.frames, timelapse.found));
        assert_eq!(frames, Some((2, 0)), "{both:?}");
        assert_eq!(
            keys(&both),
            "frames frames_found size backend canvas actions strokes substeps cells"
        );
        let [saved, exported] = ["saved/a.png", "b.png"].map(|name| std::fs::read(file(name)));
        assert!(saved.unwrap() == exported.unwrap(), "two pictures of one painting differ");
    }

    #[test]
    fn refused_requests_name_the_key_and_the_way_out_and_nothing_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let request = request_of(folder.path(), SCRIPT);
        type Change = fn(&mut ScriptRequest);
        let changes: [(Change, &str, &str); 5] = [
            (|r| r.exports.bits = 12, "bits takes 8 or 16, found `12`", "8 is usual"),
            (|r| r.undo_memory = 1 << 30, "undo_memory takes 0 to 1048576", "`undo_memory = 512`"),
            (|r| r.timelapse.rate = 0.0, "timelapse.rate takes another value", ""),
            (
                |r| {
                    r.timelapse.count = Some(9);
                    r.timelapse.every = Some(2);
                },
                "timelapse.count is one of three keys",
                "leave all but one of them out",
            ),
            (|r| r.exports.picture = Some(r.script.clone()), "ends in .png", ""),
        ];
        for (change, message, hint) in changes {
            let mut changed = request.clone();
            changed.timelapse.frames = Some(folder.path().join("frames"));
            change(&mut changed);
            let error = changed.run(&Task::default()).unwrap_err();
            let hinted = error.hint().map(|hint| hint.to_string()).unwrap_or_default();
            assert!(error.to_string().contains(message), "{error} for {message}");
            assert!(hinted.contains(hint), "{hinted} for {hint}");
        }
        // The second of two files cannot be written, so the first is not written either.
        let blocked = SCRIPT.replacen("saved/a.png", "first.png", 1);
        let request = request_of(folder.path(), &blocked);
        std::fs::write(folder.path().join("saved"), "a file").unwrap();
        let error = request.run(&Task::default()).unwrap_err();
        assert!(matches!(error, PictureError::Within(..)), "{error:?}");
        assert!(error.source().unwrap().to_string().contains("action 4 (save)"), "{error:?}");
        let names = std::fs::read_dir(folder.path()).unwrap();
        assert_eq!(names.count(), 2, "only the script and the file are there");

        #[cfg(unix)]
        {
            let apart = tempfile::tempdir().unwrap();
            let victim = apart.path().join("a.png");
            std::fs::write(&victim, "mine").unwrap();
            std::fs::remove_file(folder.path().join("saved")).unwrap();
            std::os::unix::fs::symlink(apart.path(), folder.path().join("saved")).unwrap();
            let error = request_of(folder.path(), SCRIPT).run(&Task::default()).unwrap_err();
            let cause = error.source().unwrap().source().unwrap().to_string();
            assert!(cause.contains("saved/a.png: a link leads out of the folder"), "{error:?}");
            assert_eq!(std::fs::read(&victim).unwrap(), b"mine");
        }

        let picture = folder.path().join("photo.jpg");
        std::fs::write(&picture, b"\xff\xd8\xff\xe0 a picture").unwrap();
        let error = ScriptRequest::new(&picture).run(&Task::default()).unwrap_err();
        assert!(error.to_string().ends_with("photo.jpg is a picture, not a script"), "{error}");

        let script = folder.path().join("strokes.png");
        std::fs::rename(&request.script, &script).unwrap();
        let mut request = ScriptRequest { script: script.clone(), ..request };
        request.exports.picture = Some(script);
        let error = request.run(&Task::default()).unwrap_err().to_string();
        assert!(error.contains("is an input file"), "{error}");
    }

    #[test]
    fn a_script_that_saves_nothing_needs_an_export_and_keys_are_checked() {
        let folder = tempfile::tempdir().unwrap();
        let (head, _) = SCRIPT.split_once(",\n            {\"save\"").unwrap();
        let request = request_of(folder.path(), &format!("{head}]}}"));
        let error = request.run(&Task::default()).unwrap_err();
        assert_eq!(error.to_string(), "nothing would be written");
        assert!(error.hint().unwrap().to_string().contains("`picture = painting.png`"));
        let mut film = request.clone();
        film.timelapse.file = Some(folder.path().join("film.gif"));
        let film = film.run(&Task::default()).unwrap();
        assert_eq!(keys(&film), "frames frames_found size backend canvas");
        let json = r#"{"script": "a.json", "timelaps": {}}"#;
        let error = request_from_json::<ScriptRequest>(json).unwrap_err();
        assert_eq!(error.to_string(), "unknown key `timelaps`");
        let json = serde_json::to_string(&request).unwrap();
        assert_eq!(request_from_json::<ScriptRequest>(&json).unwrap(), request, "{json}");
    }
}
