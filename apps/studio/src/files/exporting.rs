//! Exports: pictures, layers, spectra and pigment maps of a painting, timelapses of the recording,
//! and the files of a scene.

use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use documents::Task;
use documents::file::{disk, write_whole};
use eframe::egui::{DragValue, Grid, Ui};
use graphics::export::{AnimationFormat, FrameRate, OutsideGamut, PictureFormat, picture_file};
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::export::{SpectralBands, layers_file, painting_maps, pigment_maps, spectral_file};
use paint::light::Light;
use paint::painting::Painting;
use paint::scene::{PixelsPerCell, fine_picture, picture, scene};
use paint::session::PaintingSession;
use paint::strokes::StrokeScript;
use paint::timelapse::{Interval, Timelapse, TimelapseFiles, TimelapseSettings};
use pigment::library::PigmentLibrary;
use session::{Autosave, LostSession};
use web_time::Instant;

use super::job::JobError;
use super::problem::Problem;
use crate::language::tr;

/// An export of a painting, as you chose it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Export {
    /// Kind of file.
    pub kind: ExportKind,
    /// Resolution of a picture. Layers, spectra and maps have one value a cell.
    pub pixels: PixelsPerCell,
}

/// The kind of an export.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportKind {
    /// The picture under its light.
    Picture(PictureFormat),
    /// The ground and all layers of paint, as OpenRaster.
    Layers,
    /// A spectral OpenEXR with the reflectance of every cell.
    Spectral(SpectralBands),
    /// A folder with one map for each pigment.
    PigmentMaps,
}

impl ExportKind {
    #[must_use]
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::Picture(PictureFormat::Png8 | PictureFormat::Png16) => "png",
            Self::Picture(PictureFormat::Tiff16) => "tif",
            Self::Picture(PictureFormat::LinearExr) => "exr",
            Self::Layers => "ora",
            Self::Spectral(_) => "spectral.exr",
            Self::PigmentMaps => "maps",
        }
    }
}

/// Writes `export` of `document` under `light` to `path`. Returns a remark if colours were outside
/// the gamut.
///
/// # Errors
/// [`JobError`] if the export failed or was cancelled. This leaves no incomplete file, but pigment
/// maps written before stay.
pub(crate) fn export(
    Export { kind, pixels }: Export,
    document: &Document,
    light: &Light,
    path: &Path,
    task: &Task,
) -> Result<Option<Problem>, JobError> {
    let problem = |error: graphics::export::ExportError| Problem::without_hint(&error);
    task.reach(0.0)?;
    match kind {
        ExportKind::Picture(format) => {
            let scene = scene(document, light);
            let picture = match pixels.count() {
                1 => picture(document, &scene),
                _ => fine_picture(document, &scene, pixels),
            };
            task.reach(0.5)?;
            let pixel_mm = document.cell_mm / pixels.count() as f64;
            let file = picture_file(&picture, pixel_mm, format).map_err(problem)?;
            task.reach(0.9)?;
            write_whole(path, &file.bytes).map_err(Problem::from)?;
            Ok(file.outside_gamut().map(|outside| gamut_remark(path, outside)))
        }
        ExportKind::Layers => {
            let count = (document.dry.len() + 2) as f64;
            let file =
                layers_file(document, light, |done| task.reach(0.9 * done as f64 / count).is_ok())
                    .map_err(problem)?;
            let Some(file) = file else { return Err(JobError::Cancelled) };
            write_whole(path, &file.bytes).map_err(Problem::from)?;
            Ok(file.outside_gamut().map(|outside| gamut_remark(path, outside)))
        }
        ExportKind::Spectral(bands) => {
            let picture = picture(document, &scene(document, light));
            let rows = document.wet.height().max(1) as f64;
            let file = spectral_file(document, light, &picture, bands, |row| {
                task.reach(0.1 + 0.7 * row as f64 / rows).is_ok()
            })
            .map_err(problem)?;
            let Some(bytes) = file else { return Err(JobError::Cancelled) };
            task.reach(0.9)?;
            write_whole(path, &bytes).map_err(Problem::from)?;
            Ok(None)
        }
        ExportKind::PigmentMaps => {
            let maps = painting_maps(document);
            task.reach(0.3)?;
            let files = pigment_maps("painting", &maps, document.cell_mm).map_err(problem)?;
            disk::create_dir_all(path).map_err(|error| Problem::io(path, "created", &error))?;
            let count = files.len() as f64;
            for (index, file) in files.into_iter().enumerate() {
                task.reach(0.6 + 0.4 * index as f64 / count)?;
                write_whole(&path.join(file.name), &file.bytes).map_err(Problem::from)?;
            }
            Ok(None)
        }
    }
}

fn gamut_remark(path: &Path, outside: OutsideGamut) -> Problem {
    let text = format!("{}: {outside}", path.display());
    Problem::new(text, tr("export linear OpenEXR to keep them"))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TimelapseForm {
    /// One file that plays.
    Animation(AnimationFormat),
    /// A folder of PNG files.
    Frames,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Every {
    Frames,
    Seconds,
    Actions,
}

/// Settings of a timelapse, as you make them in the dialog.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TimelapseExport {
    pub(crate) form: TimelapseForm,
    every: Every,
    frames: usize,
    seconds: f64,
    actions: usize,
    longest_px: usize,
    rate: f64,
    hold_seconds: f64,
    with_undone: bool,
}

impl Default for TimelapseExport {
    fn default() -> Self {
        Self {
            form: TimelapseForm::Animation(AnimationFormat::Gif),
            every: Every::Frames,
            frames: 250,
            seconds: 2.0,
            actions: 1,
            longest_px: 960,
            rate: 25.0,
            hold_seconds: 2.0,
            with_undone: false,
        }
    }
}

impl TimelapseExport {
    pub(crate) fn ending(self) -> &'static str {
        match self.form {
            TimelapseForm::Animation(AnimationFormat::Gif) => "gif",
            TimelapseForm::Animation(AnimationFormat::Apng) => "png",
            TimelapseForm::Frames => "frames",
        }
    }

    fn settings(&self) -> TimelapseSettings {
        let interval = match self.every {
            Every::Frames => Interval::Frames(self.frames),
            Every::Seconds => Interval::Seconds(self.seconds),
            Every::Actions => Interval::Actions(self.actions),
        };
        let Self { longest_px, with_undone, .. } = *self;
        TimelapseSettings { interval, longest_px, with_undone }
    }

    fn files(&self, path: &Path) -> Result<TimelapseFiles, Problem> {
        let animation = match self.form {
            TimelapseForm::Animation(format) => {
                Some((path.to_owned(), AnimationFormat::from_path(path).unwrap_or(format)))
            }
            TimelapseForm::Frames => None,
        };
        let keep_frames = animation.is_none();
        Ok(TimelapseFiles {
            frames: if keep_frames { path.to_owned() } else { hidden_beside(path) },
            animation,
            keep_frames,
            rate: FrameRate::new(self.rate).map_err(|error| Problem::from_error(&error))?,
            hold_seconds: self.hold_seconds,
        })
    }

    /// Shows the settings.
    pub(super) fn controls(&mut self, ui: &mut Ui) {
        for (form, words, tip) in [
            (
                TimelapseForm::Animation(AnimationFormat::Gif),
                "GIF",
                tr("255 colours for all frames; every program shows it"),
            ),
            (
                TimelapseForm::Animation(AnimationFormat::Apng),
                tr("Animated PNG"),
                tr("All colours; larger, and shown by browsers"),
            ),
            (
                TimelapseForm::Frames,
                tr("Folder of PNG frames"),
                tr("For a film; frames of the same recording that are there already are kept"),
            ),
        ] {
            ui.radio_value(&mut self.form, form, words).on_hover_text(tip);
        }
        ui.add_space(4.0);
        Grid::new("timelapse").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| {
            self.interval_rows(ui);
            let size = DragValue::new(&mut self.longest_px).range(16..=16_384).suffix(" px");
            number_row(ui, tr("Longest side"), tr("A canvas with fewer cells keeps them"), size);
            if self.form != TimelapseForm::Frames {
                let rate =
                    DragValue::new(&mut self.rate).range(0.1..=100.0).suffix(tr(" a second"));
                number_row(ui, tr("Frames"), tr("Frames that are shown in a second"), rate);
                let hold = DragValue::new(&mut self.hold_seconds).range(0.0..=60.0).suffix(" s");
                number_row(
                    ui,
                    tr("Hold the end"),
                    tr("How long the last frame is shown"),
                    hold.speed(0.1),
                );
            }
        });
        ui.checkbox(&mut self.with_undone, tr("Show what was undone"))
            .on_hover_text(tr("Passages that were undone later are shown too, with their undoing"));
    }

    fn interval_rows(&mut self, ui: &mut Ui) {
        let every = &mut self.every;
        ui.radio_value(every, Every::Frames, tr("In all"))
            .on_hover_text(tr("Frames are spread evenly over the time that strokes took"));
        let drag = DragValue::new(&mut self.frames).range(2..=100_000).suffix(tr(" frames"));
        ui.add_enabled(*every == Every::Frames, drag).on_hover_text(tr("Number of frames"));
        ui.end_row();
        ui.radio_value(every, Every::Seconds, tr("One every"))
            .on_hover_text(tr("Seconds of strokes on the canvas, without pauses and mixing"));
        let drag = DragValue::new(&mut self.seconds).range(0.01..=86_400.0).suffix(" s");
        ui.add_enabled(*every == Every::Seconds, drag.speed(0.1))
            .on_hover_text(tr("Seconds of painting between two frames"));
        ui.end_row();
        ui.radio_value(every, Every::Actions, tr("One after"))
            .on_hover_text(tr("Actions that change the canvas: strokes, drying, light and so on"));
        let unit = if self.actions == 1 { tr(" action") } else { tr(" actions") };
        let drag = DragValue::new(&mut self.actions).range(1..=1_000_000).suffix(unit);
        ui.add_enabled(*every == Every::Actions, drag)
            .on_hover_text(tr("Actions between two frames"));
        ui.end_row();
    }
}

fn number_row(ui: &mut Ui, name: &str, tip: &str, drag: DragValue<'_>) {
    ui.label(name);
    ui.add(drag).on_hover_text(tip);
    ui.end_row();
}

/// Hidden folder beside `path` for frames. We need it only until `path` is written.
fn hidden_beside(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.frames"))
}

#[derive(Debug)]
pub(super) struct Recorded {
    pub(super) script: Arc<StrokeScript>,
    pub(super) library: Arc<PigmentLibrary>,
    /// If the recording continues a painting, the content of the painting's file. `None` if there
    /// is none, or if the script names the file.
    pub(super) start: Option<Arc<Vec<u8>>>,
    /// Memory for undo in bytes, as in the recorded session.
    pub(super) undo_bytes: u64,
}

impl Recorded {
    /// Plays the recording on the processor and writes the timelapse to `path`.
    ///
    /// # Errors
    /// [`JobError`] if it cannot be played or written, or was cancelled. This leaves no incomplete
    /// animation.
    pub(super) fn write_timelapse(
        &self,
        export: &TimelapseExport,
        path: &Path,
        task: &Task,
    ) -> Result<(), JobError> {
        task.reach(0.0)?;
        let files = export.files(path)?;
        let timelapse = Timelapse::new(&self.script, export.settings())
            .map_err(|error| Problem::from_error(&error))?;
        let mut session = self.session()?;
        let written = timelapse
            .write(&mut session, &files, |done| match task.reach(done) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            })
            .map_err(|error| Problem::from_error(&error))?;
        written.map(drop).ok_or(JobError::Cancelled)
    }

    fn session(&self) -> Result<PaintingSession, Problem> {
        let start = self.start_document()?;
        let (canvas, palette) = self
            .script
            .surfaces(&self.library, start)
            .map_err(|error| Problem::from_error(&error))?;
        let engine = PaintEngine::on_cpu(canvas.ground.height.clone());
        let canvas = Painting::open(canvas, engine, self.undo_bytes)
            .map_err(|error| Problem::from_error(&error))?;
        let light = Arc::clone(canvas.light());
        let palette = palette.map(|palette| {
            let engine = PaintEngine::on_cpu(palette.ground.height.clone());
            Painting::open_under(palette, light, engine, self.undo_bytes)
                .map_err(|error| Problem::from_error(&error))
        });
        let mut session = PaintingSession::new(canvas, palette.transpose()?)
            .map_err(|error| Problem::from_error(&error))?;
        session.set_undo_bytes(self.undo_bytes);
        Ok(session)
    }

    fn start_document(&self) -> Result<Option<Document>, Problem> {
        let Some(named) = &self.script.start else { return Ok(None) };
        let read = |bytes: &[u8]| {
            paint::file::read(named, bytes).map_err(|error| Problem::from_error(&error))
        };
        match &self.start {
            Some(bytes) => read(bytes).map(Some),
            None => read(&documents::file::read(Path::new(named))?).map(Some),
        }
    }
}

/// A file made from a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneExport {
    /// The picture as you see it.
    Picture,
    /// The painting as an OpenEXR file with its pigments.
    Painting,
    /// An export of the painting, e.g. layers, spectra or maps of its pigments.
    OfPainting(Export),
    /// The script of all events.
    Script,
    /// Pictures from the start to the end.
    Animation,
}

/// Your choice for a scene.
#[derive(Debug)]
pub enum SceneAnswer {
    /// Opens this file.
    Open(PathBuf),
    /// Fills the tubes from this library.
    Library(PathBuf),
    /// Writes this file.
    Export(SceneExport, PathBuf),
    /// Opens the scene kept by a killed program.
    Recover(LostSession),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ScenePurpose {
    Open,
    Library,
    Export(SceneExport),
}

#[derive(Debug)]
pub(super) struct SceneFiles {
    /// Scenes of programs that ended without saving.
    pub(super) lost: Vec<LostSession>,
    pub(super) answers: VecDeque<SceneAnswer>,
    pub(super) autosave: Arc<Mutex<Option<Autosave>>>,
    /// Title of the open scene, and the number of its changes.
    pub(super) open: Option<(String, u64)>,
    /// Number of changes when the scene was last saved in a file.
    pub(super) saved: u64,
    /// Number of changes in the autosave, or in the one that is being written.
    pub(super) autosaved: u64,
    pub(super) last_autosave: Instant,
    /// Whether we have asked for a recording and wait for it.
    pub(super) awaited: bool,
    /// The lost scene that we recovered the open one from, until that is autosaved again.
    pub(super) recovered: Option<LostSession>,
    /// The lost scene that the worker is opening.
    pub(super) opening: Option<LostSession>,
}

impl SceneFiles {
    /// Files without an open scene. `lost` are the scenes of programs that ended without saving.
    pub(super) fn new(lost: Vec<LostSession>) -> Self {
        Self {
            lost,
            answers: VecDeque::new(),
            autosave: Arc::default(),
            open: None,
            saved: 0,
            autosaved: 0,
            last_autosave: Instant::now(),
            awaited: false,
            recovered: None,
            opening: None,
        }
    }

    /// Whether changes of the open scene are in no file.
    pub(super) fn is_changed(&self) -> bool {
        self.open.as_ref().is_some_and(|(_, revision)| *revision != self.saved)
    }

    /// Ends the autosave. It stays on the disk if changes of the scene are in no file.
    pub(super) fn end(&mut self) {
        let changed = self.is_changed();
        let mut autosave = self.autosave.lock().unwrap_or_else(PoisonError::into_inner);
        match autosave.take() {
            Some(autosave) if !changed => autosave.end(),
            _ => {}
        }
        drop(autosave);
        if let Some(lost) = self.recovered.take().filter(|_| !changed) {
            lost.discard();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use paint::amount::QUANTA_PER_CELL;
    use paint::ground::GroundSpec;
    use paint::strokes::{Canvas, PaletteSpec, StrokeScript};
    use pigment::library::PigmentLibrary;

    /// A canvas under a thick layer of a green that sRGB cannot show.
    fn green() -> Document {
        let cell_mm = 0.5;
        let ground = GroundSpec::default();
        let canvas = Canvas { width_mm: 12.0, height_mm: 8.0, cell_mm, ground };
        let palette = PaletteSpec::from_names(["Zinc White", "Emerald Green"]);
        let script = StrokeScript::new("Green", "CC0-1.0", canvas, palette);
        let library = PigmentLibrary::van_gogh_oils();
        let resolved = script.resolve(&library).unwrap();
        let (width, height) = script.canvas.cells();
        let ground = script.canvas.ground.build(width, height, cell_mm, &library).unwrap();
        let mut document = script.bare(&library, &resolved, ground);
        for amounts in document.wet.pigments.values_mut() {
            amounts[1] = QUANTA_PER_CELL;
        }
        document
    }

    #[test]
    fn colors_that_a_picture_loses_are_told_with_its_path() {
        let folder = tempfile::tempdir().unwrap();
        let document = green();
        let light = Light::named(&document.library, "D65", "1931-2").unwrap();
        let pixels = PixelsPerCell::new(1).unwrap();
        for (format, has_remark) in [
            (PictureFormat::Png8, true),
            (PictureFormat::Png16, true),
            (PictureFormat::Tiff16, true),
            (PictureFormat::LinearExr, false),
        ] {
            let kind = ExportKind::Picture(format);
            let path = folder.path().join(format!("green.{}", kind.ending()));
            let task = Task::default();
            let chosen = Export { kind, pixels };
            let remark = export(chosen, &document, &light, &path, &task).unwrap();
            assert_eq!(remark.is_some(), has_remark, "{format:?}: {remark:?}");
            let name = path.display().to_string();
            assert!(remark.is_none_or(|remark| remark.text.starts_with(&name)), "{format:?}");
        }
    }
}
