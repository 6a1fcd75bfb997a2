//! Starts each job on files: saving, exporting, reading, preferences.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::file::disk;
use documents::file::write_whole;
use paint::document::Document;
use paint::light::Light;
use paint::strokes::{KeptBrush, StrokeScript};
use pigment::library::PigmentLibrary;

use super::exporting;
use super::job::{JobError, Progress, on_one_core};
use super::opened::{self, Opened};
use super::pending::{FileOrigin, PendingAction, Replacement};
use super::problem::Problem;
use super::revisions;
use super::state::Files;
use super::timelapse::{Recorded, TimelapseExport};
use super::work::{Finished, JobKind, Purpose, file_name};
use crate::language::{tr, tr_format};
use session::{Command, Origin, Snapshot};

impl Files {
    /// Saves the painting in `path`, then carries out `next`.
    pub(super) fn save(&mut self, path: PathBuf, next: Option<PendingAction>) {
        self.request_snapshot(Purpose::Save { path, next, keep_revision: false });
    }

    /// Starts the job that a snapshot was requested for.
    pub(super) fn start_with_snapshot(&mut self, purpose: Purpose, snapshot: &Snapshot) {
        let canvas = snapshot.canvas.clone();
        let revision = snapshot.revision;
        let epoch = self.epoch;
        match purpose {
            Purpose::Save { path, next, keep_revision } => {
                let label = tr_format!("saving {path}", path = file_name(&path));
                let palette = snapshot.palette.clone();
                let brushes = snapshot.brushes.clone();
                self.start_job(JobKind::Saving, label, move |progress| {
                    write_painting(&path, &canvas, (&palette, &brushes), progress)?;
                    Ok(Finished::Saved { path, revision, epoch, next, keep_revision })
                });
            }
            Purpose::Revision { path } => {
                let light = self.light_of(&canvas);
                let label = tr("keeping a revision").to_owned();
                self.start_job(JobKind::Shown, label, move |progress| {
                    let light = light()?;
                    let kept = revisions::keep(&path, &canvas, &light, progress)?;
                    Ok(Finished::RevisionKept(kept))
                });
            }
            Purpose::Export { export, path } => {
                let light = self.light_of(&canvas);
                let label = tr_format!("exporting {path}", path = file_name(&path));
                self.start_job(JobKind::Shown, label, move |progress| {
                    let light = light()?;
                    let remark = exporting::export(export, &canvas, &light, &path, progress)?;
                    Ok(Finished::Exported { path, remark })
                });
            }
            Purpose::Crop(rect) => self.start_crop(rect, snapshot),
            Purpose::Autosave | Purpose::Recording { .. } | Purpose::Timelapse { .. } => {}
        }
    }

    /// Starts the job that the recording was requested for.
    pub(super) fn start_with_recording(&mut self, purpose: Purpose, script: Arc<StrokeScript>) {
        match purpose {
            Purpose::Recording { path } => self.start_recording(path, script),
            Purpose::Timelapse { export, path } => self.start_timelapse(export, path, script),
            _ => {}
        }
    }

    /// Starts playing a recording for its timelapse.
    fn start_timelapse(
        &mut self,
        export: TimelapseExport,
        path: PathBuf,
        script: Arc<StrokeScript>,
    ) {
        let Some(state) = &self.painting else { return };
        let library = state.library.clone();
        let start = self.start.clone();
        let undo_bytes = self.preferences.undo_mib << 20;
        let recorded = Recorded { script, library, start, undo_bytes };
        let label = tr_format!("timelapse {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |progress| {
            on_one_core(|| recorded.write_timelapse(&export, &path, progress))?;
            Ok(Finished::Exported { path, remark: None })
        });
    }

    /// Starts writing a recording.
    fn start_recording(&mut self, path: PathBuf, script: Arc<StrokeScript>) {
        let label = tr_format!("saving {path}", path = file_name(&path));
        let start = self.start.clone();
        self.start_job(JobKind::Shown, label, move |_| {
            let script = with_start_file(&path, &script, start)?;
            let text = script.to_json().map_err(|error| Problem::from_error(&error))?;
            write_whole(&path, text.as_bytes()).map_err(Problem::from)?;
            Ok(Finished::Recorded { path, actions: script.actions.len() })
        });
    }

    /// Returns a function that finds the light of `document`. If the worker's light has the
    /// same name, observer and library, it is used, because a lamp's file may no longer
    /// exist.
    fn light_of(
        &self,
        document: &Arc<Document>,
    ) -> impl FnOnce() -> Result<Arc<Light>, Problem> + Send + 'static {
        let document = document.clone();
        let known = self.painting.as_ref().filter(|state| {
            let own = &document.lighting;
            let current = &state.lighting;
            (&own.illuminant, &own.observer) == (&current.illuminant, &current.observer)
                && *state.library == document.library
        });
        let known = known.map(|state| state.light.clone());
        move || match known {
            Some(light) => Ok(light),
            None => {
                let lighting = &document.lighting;
                Light::named(&document.library, &lighting.illuminant, &lighting.observer)
                    .map(Arc::new)
                    .map_err(|error| Problem::from_error(&error))
            }
        }
    }

    /// Starts reading a file of any kind.
    pub(super) fn read(&mut self, path: PathBuf) {
        // Absolute, so that a later change of the working folder has no effect.
        let path = disk::absolute(&path).unwrap_or(path);
        let label = tr_format!("reading {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |progress| {
            let opened = opened::read(&path, progress)?;
            Ok(Finished::Read { path, opened })
        });
    }

    /// Starts reading a revision.
    pub(super) fn read_revision(&mut self, path: PathBuf) {
        let label = tr_format!("reading revision {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |progress| {
            let (document, bytes) = read_painting(&path, progress)?;
            Ok(Finished::RevisionRead(document, bytes))
        });
    }

    /// Starts listing the revisions of the painting.
    pub(super) fn list_revisions(&mut self) {
        let epoch = self.epoch;
        let Some(path) = self.path.clone() else {
            self.revisions.set(&self.ctx, None, Vec::new());
            return;
        };
        let label = tr("looking for revisions").to_owned();
        self.start_job(JobKind::Background, label, move |progress| {
            let revisions = revisions::list(&path, progress)?;
            Ok(Finished::Listed { epoch, revisions })
        });
    }

    /// Starts writing the preferences if they changed and no background job runs.
    pub(super) fn write_changed_preferences(&mut self) {
        let idle = self.jobs.iter().all(|job| job.kind != JobKind::Background);
        if self.preferences == self.written_preferences || !idle {
            return;
        }
        self.preferences.bound();
        self.written_preferences = self.preferences.clone();
        let (preferences, path) = (self.preferences.clone(), self.home.preferences());
        self.start_job(JobKind::Background, tr("writing preferences").to_owned(), move |_| {
            preferences.write(&path)?;
            Ok(Finished::Quietly)
        });
    }

    /// Opens a new painting on the canvas of `script`.
    pub(super) fn begin_painting(&mut self, script: StrokeScript, library: PigmentLibrary) {
        let origin = Origin::Blank { script: Box::new(script), library: Box::new(library) };
        let commands = vec![Command::Open(origin)];
        let replacement = Replacement { commands, origin: FileOrigin::default() };
        self.carry_out_safely(PendingAction::Replace(replacement));
    }
}

/// Returns the script as it will be saved in `path`. If it continues a painting, the file
/// of that painting as it was at the start (`start`) is written beside it as
/// `NAME.start.exr`.
fn with_start_file(
    path: &Path,
    script: &StrokeScript,
    start: Option<Arc<Vec<u8>>>,
) -> Result<StrokeScript, Problem> {
    let mut script = script.clone();
    let Some(named) = &script.start else { return Ok(script) };
    let bytes = match start {
        Some(bytes) => bytes,
        // The painting comes from a recording, whose script names the file that it started
        // from.
        None => Arc::new(documents::file::read(Path::new(named))?),
    };
    let beside = path.with_extension("start.exr");
    write_whole(&beside, &bytes)?;
    script.start = Some(file_name(&beside));
    Ok(script)
}

/// Writes a painting, with the palette and the brushes beside it.
fn write_painting(
    path: &Path,
    canvas: &Document,
    (palette, brushes): (&Document, &[KeptBrush]),
    progress: &Progress,
) -> Result<(), JobError> {
    let bytes = paint::file::write_with_table(canvas, palette, brushes)
        .map_err(|error| Problem::from_error(&error))?;
    progress.report(0.8)?;
    write_whole(path, &bytes).map_err(Problem::from)?;
    Ok(())
}

/// Reads a painting, and returns the content of its file too.
pub(super) fn read_painting(
    path: &Path,
    progress: &Progress,
) -> Result<(Box<Document>, Arc<Vec<u8>>), JobError> {
    match opened::read(path, progress)? {
        Opened::Painting { document, bytes, .. } => Ok((document, bytes)),
        _ => {
            let text = tr_format!("{path}: is not a painting", path = path.display());
            Err(Problem::new(text, tr("another program has changed it")).into())
        }
    }
}
