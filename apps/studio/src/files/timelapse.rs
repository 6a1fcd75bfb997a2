//! Timelapse of the session's recording: its settings in a dialog, and its files.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::hint::Explain;
use eframe::egui::{DragValue, Grid, Ui};
use graphics::export::{AnimationFormat, FrameRate};
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::painting::Painting;
use paint::session::PaintingSession;
use paint::strokes::StrokeScript;
use paint::timelapse::{Interval, Timelapse, TimelapseFiles, TimelapseSettings};
use pigment::library::PigmentLibrary;

use super::job::{JobError, Progress};
use super::problem::Problem;
use crate::language::tr;

/// Form in which a timelapse is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TimelapseForm {
    /// One file that plays.
    Animation(AnimationFormat),
    /// A folder of PNG files.
    Frames,
}

/// Choice between the ways to take frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Every {
    Frames,
    Seconds,
    Actions,
}

/// Settings of a timelapse, as the dialog holds them.
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
    /// Extension of the file's or folder's name.
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
            let mut row = |name: &str, tip: &str, drag: DragValue<'_>| {
                ui.label(name);
                ui.add(drag).on_hover_text(tip);
                ui.end_row();
            };
            let size = DragValue::new(&mut self.longest_px).range(16..=16_384).suffix(" px");
            row(tr("Longest side"), tr("A canvas with fewer cells keeps them"), size);
            if self.form != TimelapseForm::Frames {
                let rate =
                    DragValue::new(&mut self.rate).range(0.1..=100.0).suffix(tr(" a second"));
                row(tr("Frames"), tr("Frames that are shown in a second"), rate);
                let hold = DragValue::new(&mut self.hold_seconds).range(0.0..=60.0).suffix(" s");
                row(tr("Hold the end"), tr("How long the last frame is shown"), hold.speed(0.1));
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

/// Folder for frames that are needed only until `path` is written, hidden beside it.
fn hidden_beside(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.frames"))
}

/// A recording that a timelapse is made of.
#[derive(Debug)]
pub(super) struct Recorded {
    pub(super) script: Arc<StrokeScript>,
    pub(super) library: Arc<PigmentLibrary>,
    /// Content of the painting's file that it continues; `None` if the script names the file.
    pub(super) start: Option<Arc<Vec<u8>>>,
    /// Memory for undo in bytes, which the recording had.
    pub(super) undo_bytes: u64,
}

impl Recorded {
    /// Plays the recording on the processor and writes the timelapse to `path`.
    ///
    /// # Errors
    /// [`JobError`] if it cannot be played or written, or was cancelled; no incomplete animation
    /// is left then.
    pub(super) fn write_timelapse(
        &self,
        export: &TimelapseExport,
        path: &Path,
        progress: &Progress,
    ) -> Result<(), JobError> {
        progress.report(0.0)?;
        let problem = |error: &dyn Explain| Problem::from_error(error);
        let files = export.files(path)?;
        let timelapse =
            Timelapse::new(&self.script, export.settings()).map_err(|error| problem(&error))?;
        let mut session = self.session()?;
        let written = timelapse
            .write(&mut session, &files, |done| match progress.report(done) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            })
            .map_err(|error| problem(&error))?;
        written.map(drop).ok_or(JobError::Cancelled)
    }

    /// A session on the surfaces that the recording begins on.
    fn session(&self) -> Result<PaintingSession, Problem> {
        let problem = |error: &dyn Explain| Problem::from_error(error);
        let start = self.start_document()?;
        let (canvas, palette) =
            self.script.surfaces(&self.library, start).map_err(|error| problem(&error))?;
        let open = |document: Document| {
            let engine = PaintEngine::on_cpu(document.ground.height.clone());
            Painting::open(document, engine, self.undo_bytes).map_err(|error| problem(&error))
        };
        let canvas = open(canvas)?;
        let light = Arc::clone(canvas.light());
        let palette = palette.map(|palette| {
            let engine = PaintEngine::on_cpu(palette.ground.height.clone());
            Painting::open_under(palette, light, engine, self.undo_bytes)
                .map_err(|error| problem(&error))
        });
        let mut session =
            PaintingSession::new(canvas, palette.transpose()?).map_err(|error| problem(&error))?;
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
