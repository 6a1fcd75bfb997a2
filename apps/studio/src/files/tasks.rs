//! Starts jobs on files (saving, exporting, reading, preferences, autosaves and their recovery) and
//! applies the results. Shows running jobs and messages over the window.

use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError};

use documents::Task;
use documents::file::{disk, write_whole};
use eframe::egui::{
    Align, Align2, Area, Context, Frame, Id, Layout, Order, ProgressBar, RichText, Spinner, Ui,
    vec2,
};
use paint::document::Document;
use paint::light::Light;
use paint::strokes::{Action, KeptBrush, StrokeScript};
use pigment::library::PigmentLibrary;
use serde_json::{from_value, to_value};
use session::{
    Command, KeptPainting, LostSession, Origin, Pace, RecoveredWork, SessionMeta, Snapshot,
    blank_canvas, now,
};
use web_time::{Duration, Instant, SystemTime};

use super::exporting;
use super::exporting::{Recorded, TimelapseExport};
use super::job::{JobError, on_one_core};
use super::opened::{self, Opened};
use super::problem::{Problem, ago};
use super::request::ReferenceChange;
use super::state::Files;
use super::window_setup::{WindowSetup, digest_of};
use super::work::{
    FileOrigin, Finished, JobKind, Notice, PendingAction, Purpose, Replacement, StatusNote,
    file_name,
};
use crate::language::{tr, tr_format};

impl Files {
    /// Saves the painting in `path`, then carries out `next`.
    pub(super) fn save(&mut self, path: PathBuf, next: Option<PendingAction>) {
        self.request_snapshot(Purpose::Save { path, next, keep_revision: false });
    }

    pub(super) fn start_with_snapshot(&mut self, purpose: Purpose, snapshot: &Snapshot) {
        let canvas = snapshot.canvas.clone();
        let revision = snapshot.revision;
        let epoch = self.epoch;
        match purpose {
            Purpose::Save { path, next, keep_revision } => {
                let label = tr_format!("saving {path}", path = file_name(&path));
                let palette = snapshot.palette.clone();
                let brushes = snapshot.brushes.clone();
                self.start_job(JobKind::Saving, label, move |task| {
                    write_painting(&path, &canvas, (&palette, &brushes), task)?;
                    Ok(Finished::Saved { path, revision, epoch, next, keep_revision })
                });
            }
            Purpose::Revision { path } => {
                let light = self.light_of(&canvas);
                let label = tr("keeping a revision").to_owned();
                self.start_job(JobKind::Shown, label, move |task| {
                    let light = light()?;
                    let kept = opened::keep(&path, &canvas, &light, task)?;
                    Ok(Finished::RevisionKept(kept))
                });
            }
            Purpose::Export { export, path } => {
                let light = self.light_of(&canvas);
                let label = tr_format!("exporting {path}", path = file_name(&path));
                self.start_job(JobKind::Shown, label, move |task| {
                    let light = light()?;
                    let remark = exporting::export(export, &canvas, &light, &path, task)?;
                    Ok(Finished::Exported { path, remark })
                });
            }
            Purpose::Crop(rect) => self.start_crop(rect, snapshot),
            Purpose::Autosave | Purpose::Recording { .. } | Purpose::Timelapse { .. } => {}
        }
    }

    pub(super) fn start_with_recording(&mut self, purpose: Purpose, script: Arc<StrokeScript>) {
        match purpose {
            Purpose::Recording { path } => self.start_recording(path, script),
            Purpose::Timelapse { export, path } => self.start_timelapse(export, path, script),
            _ => {}
        }
    }

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
        self.start_job(JobKind::Shown, label, move |task| {
            on_one_core(|| recorded.write_timelapse(&export, &path, task))?;
            Ok(Finished::Exported { path, remark: None })
        });
    }

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

    /// Returns a function that finds the light of `document`. We use the worker's light if it has
    /// the same name, observer and library, because the file of a lamp may no longer exist.
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

    pub(super) fn read(&mut self, path: PathBuf) {
        // An absolute path stays right if the working folder changes later.
        let path = disk::absolute(&path).unwrap_or(path);
        let label = tr_format!("reading {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |task| {
            let opened = opened::read(&path, task)?;
            Ok(Finished::Read { path, opened })
        });
    }

    pub(super) fn read_revision(&mut self, path: PathBuf) {
        let label = tr_format!("reading revision {path}", path = file_name(&path));
        self.start_job(JobKind::Shown, label, move |task| {
            let (document, bytes) = read_painting(&path, task)?;
            Ok(Finished::RevisionRead(document, bytes))
        });
    }

    pub(super) fn list_revisions(&mut self) {
        let epoch = self.epoch;
        let Some(path) = self.path.clone() else {
            self.revisions.set(&self.ctx, None, Vec::new());
            return;
        };
        let label = tr("looking for revisions").to_owned();
        self.start_job(JobKind::Background, label, move |task| {
            let revisions = opened::list(&path, task)?;
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

    pub(super) fn begin_painting(&mut self, script: StrokeScript, library: PigmentLibrary) {
        let origin = Origin::Blank { script: Box::new(script), library: Box::new(library) };
        let commands = vec![Command::Open(origin)];
        let replacement = Replacement { commands, origin: FileOrigin::default() };
        self.carry_out_safely(PendingAction::Replace(replacement));
    }

    /// Applies the results of all jobs that ended.
    pub(super) fn collect_results(&mut self) {
        let mut index = 0;
        while index < self.jobs.len() {
            match self.jobs[index].job.poll() {
                None => index += 1,
                Some(result) => {
                    let ended = self.jobs.remove(index);
                    match result {
                        Ok(finished) => self.apply(finished),
                        Err(JobError::Cancelled) => {
                            self.closes_when_saved &= ended.kind != JobKind::Saving;
                            let text = tr_format!("{label}: cancelled", label = ended.job.label());
                            self.notices.push(Notice::done(&text));
                        }
                        Err(JobError::Failed(problem)) => self.report_failure(ended.kind, problem),
                    }
                }
            }
        }
    }

    fn report_failure(&mut self, kind: JobKind, problem: Problem) {
        self.closes_when_saved &= kind != JobKind::Saving;
        // Autosaves fail again every few seconds; the first report is enough.
        if kind == JobKind::Autosave {
            // We do not know how much of the recording was kept.
            self.recorded = 0;
            if std::mem::replace(&mut self.autosave_failed, true) {
                return;
            }
        }
        self.report(problem);
    }

    pub(super) fn apply(&mut self, finished: Finished) {
        match finished {
            Finished::Read { path, opened } => self.use_opened(path, opened),
            Finished::RevisionRead(document, start) | Finished::Begun(document, start) => {
                let commands = vec![Command::Open(Origin::Painting(document))];
                let origin = FileOrigin { start: Some(start), ..FileOrigin::default() };
                self.replace(Replacement { commands, origin });
            }
            Finished::Cropped { canvas, palette, start, revision, epoch } => {
                if epoch == self.epoch {
                    self.continue_cropped(canvas, palette, start, revision);
                }
            }
            Finished::Recovered { canvas, palette, work, lost, remarks } => {
                self.notices.extend(remarks.into_iter().map(Notice::problem));
                let RecoveredWork { session, start } = work.map(|work| *work).unwrap_or_default();
                let kept = Some(Box::new(session));
                let commands = vec![Command::Open(Origin::Recovered { canvas, palette, kept })];
                let path = lost.meta.path.clone();
                let start = start.map(Arc::new);
                let origin = FileOrigin { path, lost: Some(lost), start, ..FileOrigin::default() };
                self.replace(Replacement { commands, origin });
            }
            Finished::Saved { path, revision, epoch, next, keep_revision } => {
                self.preferences.remember(&path);
                self.notices.push(Notice::done(&tr_format!("saved {path}", path = path.display())));
                if epoch == self.epoch {
                    self.saved(path, revision, keep_revision);
                }
                if let Some(next) = next {
                    self.carry_out_safely(next);
                }
            }
            Finished::RevisionKept(path) => {
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                self.notices.push(Notice::done(&tr_format!("kept as revision {stem}", stem)));
                self.list_revisions();
            }
            Finished::Exported { path, remark } => {
                self.notices
                    .push(Notice::done(&tr_format!("exported {path}", path = path.display())));
                self.notices.extend(remark.map(Notice::problem));
                self.preferences.last_folder = path.parent().map(ToOwned::to_owned);
            }
            Finished::Recorded { path, actions } => {
                self.notices.push(Notice::done(&tr_format!("saved {path}", path = path.display())));
                let text = tr_format!("the recording holds {actions} actions", actions);
                let hint = Some(tr("open its file to play it again").to_owned());
                self.status = Some(StatusNote { text, hint });
                self.preferences.remember(&path);
            }
            Finished::DrawingSaved { drawn, next } => self.drawing_saved(drawn, next),
            Finished::DrawingRead(drawn) => {
                self.change_reference(ReferenceChange::Draw(drawn));
            }
            Finished::Listed { epoch, revisions } => {
                if epoch == self.epoch {
                    self.revisions.set(&self.ctx, self.path.clone(), revisions);
                }
            }
            Finished::Autosaved { revision, epoch, recorded, setup, digest } => {
                self.autosave_failed = false;
                self.reference_digest = digest;
                if epoch == self.epoch {
                    self.autosaved_revision = Some(revision);
                    (self.recorded, self.autosaved_setup) = (recorded, Some(*setup));
                }
                if let Some(lost) = self.recovered.take() {
                    // The autosaves of this session contain the recovered painting now, so we do
                    // not need the lost session. You have still not saved the painting in a file.
                    self.saved_revision = None;
                    lost.discard();
                }
            }
            Finished::BrushSetsRead(sets, problems) => self.brush_sets_read(sets, problems),
            Finished::BrushesRead { path, brushes } => self.brushes_read(&path, brushes),
            Finished::SwatchesRead { book, problem } => self.swatches_read(book, problem),
            Finished::SwatchesImported(read) => self.swatches_imported(read),
            Finished::SceneSaved { path, revision } => {
                self.notices.push(Notice::done(&tr_format!("saved {path}", path = path.display())));
                self.scene_saved(&path, revision);
            }
            Finished::SceneAutosaved => self.scene_autosaved(),
            Finished::Quietly => {}
        }
    }

    fn saved(&mut self, path: PathBuf, revision: u64, keep_revision: bool) {
        self.saved_revision = Some(revision);
        self.path = Some(path.clone());
        if let Some(lost) = self.recovered.take() {
            lost.discard();
        }
        if !self.has_unsaved_changes() {
            self.clear_autosaves();
        }
        self.list_revisions();
        if keep_revision {
            self.request_snapshot(Purpose::Revision { path });
        }
    }

    fn use_opened(&mut self, path: PathBuf, opened: Opened) {
        match opened {
            Opened::Painting { document: canvas, table, bytes } => {
                let opened = match table {
                    Ok(Some(table)) => Origin::WithTable { canvas, table },
                    Ok(None) => Origin::Painting(canvas),
                    Err(problem) => {
                        self.notices.push(Notice::problem(problem));
                        Origin::Painting(canvas)
                    }
                };
                self.replace(Replacement {
                    commands: vec![Command::Open(opened)],
                    origin: FileOrigin {
                        path: Some(path),
                        start: Some(bytes),
                        ..FileOrigin::default()
                    },
                });
            }
            Opened::Library(library) => {
                self.preferences.remember(&path);
                let commands = vec![Command::Open(blank_canvas(*library, 192.0, 108.0, 0.1))];
                self.replace(Replacement { commands, origin: FileOrigin::default() });
            }
            Opened::Recording { script, library, remarks } => {
                self.preferences.remember(&path);
                self.notices.extend(remarks.into_iter().map(Notice::problem));
                let commands = vec![Command::Replay { script, library, pace: self.replay_pace() }];
                self.replace(Replacement { commands, origin: FileOrigin::default() });
            }
            Opened::Picture => self.change_reference(ReferenceChange::Open(path)),
            Opened::Lamp => self.light_with_lamp(&path),
        }
    }

    fn replace(&mut self, replacement: Replacement) {
        self.carry_out_safely(PendingAction::Replace(replacement));
    }

    fn replay_pace(&self) -> Pace {
        let preferred =
            if self.preferences.replay_as_painted { Pace::AsPainted } else { Pace::Fast };
        self.pace.unwrap_or(preferred)
    }

    /// Lights the painting with the lamp measured in `path`.
    fn light_with_lamp(&mut self, path: &Path) {
        let (Some(state), Some(text)) = (&self.painting, path.to_str()) else {
            let text = tr_format!(
                "{path}: the name of a lamp's file must be text",
                path = file_name(path)
            );
            return self.report(Problem::new(text, tr("rename the file")));
        };
        let mut lighting = state.lighting.clone();
        lighting.illuminant = text.to_owned();
        self.commands.push(Command::Apply(Action::Light(lighting)));
    }

    /// Starts reading the lost session in `folder`, to recover it.
    pub(super) fn recover(&mut self, folder: &Path) {
        let mut sessions = self.lost_sessions.iter();
        let Some(at) = sessions.position(|lost| lost.folder() == folder) else { return };
        let lost = self.lost_sessions.remove(at);
        let label = tr_format!("recovering {title}", title = lost.meta.title);
        self.start_job(JobKind::Shown, label, move |task| {
            let [canvas, palette] = lost.files();
            let title = &lost.meta.title;
            let canvas = read_autosaved(&canvas, title, task)?;
            let palette = read_autosaved(&palette, title, task)?;
            // The painting is worth more than what lies beside it.
            let mut remarks = Vec::new();
            let work = lost.work().unwrap_or_else(|failure| {
                remarks.push(failure.into());
                None
            });
            let setup: Option<WindowSetup> =
                lost.meta.desk.clone().and_then(|setup| from_value(setup).ok());
            let reference = setup.and_then(|setup| setup.reference);
            remarks.extend(reference.and_then(|reference| reference.remark()));
            Ok(Finished::Recovered { canvas, palette, work: work.map(Box::new), lost, remarks })
        });
    }

    /// Requests an autosave if it is due. Otherwise asks for a repaint at the time when it will be.
    pub(super) fn autosave_when_due(&mut self) {
        let Some(state) = self.painting.clone() else { return };
        let busy = self.jobs.iter().any(|job| job.kind == JobKind::Autosave)
            || self.awaited.iter().any(|(_, purpose)| matches!(purpose, Purpose::Autosave));
        let changed = state.stroke_open
            || self.autosaved_revision != Some(state.revision)
            || self
                .autosaved_setup
                .as_ref()
                .is_some_and(|setup| setup.reference != self.setup.reference);
        if busy || !changed || !self.has_unsaved_changes() || self.opening.is_some() {
            return;
        }
        let interval = Duration::from_secs(self.preferences.autosave_seconds);
        match self.last_autosave.and_then(|last| interval.checked_sub(last.elapsed())) {
            Some(left) if !left.is_zero() => self.ctx.request_repaint_after(left),
            _ => {
                self.last_autosave = Some(Instant::now());
                self.request_autosave();
            }
        }
    }

    pub(super) fn start_autosave(&mut self, kept: &Arc<KeptPainting>) {
        let kept = kept.clone();
        let start = self.start.clone();
        let setup = self.setup.clone();
        let revision = kept.snapshot.revision;
        let epoch = self.epoch;
        let title = self.title();
        let path = self.path.clone();
        let seconds = now();
        let autosave = self.autosave.clone();
        let known = self.reference_digest.clone();
        self.start_job(JobKind::Autosave, "autosave".to_owned(), move |_| {
            let picture = setup.reference.as_ref().map(|reference| &reference.picture);
            let digest = known.filter(|(path, _)| Some(path) == picture);
            let digest = digest.or_else(|| picture.map(|path| (path.clone(), digest_of(path))));
            let mut with_digest = setup.clone();
            if let (Some(reference), Some((_, sha256))) = (&mut with_digest.reference, &digest) {
                reference.sha256.clone_from(sha256);
            }
            let meta = SessionMeta { title, path, seconds, desk: to_value(&with_digest).ok() };
            let mut autosave = autosave.lock().unwrap_or_else(PoisonError::into_inner);
            let recorded = match autosave.as_mut() {
                Some(autosave) => {
                    let start = start.as_ref().map(|bytes| bytes.as_slice());
                    let kept = on_one_core(|| autosave.keep(&kept, start, &meta));
                    kept.map_err(Problem::from)?
                }
                None => 0,
            };
            Ok(Finished::Autosaved { revision, epoch, recorded, setup: Box::new(setup), digest })
        });
    }

    /// Starts deleting the autosaves, e.g. because the painting is saved in a file or discarded.
    pub(super) fn clear_autosaves(&mut self) {
        (self.last_autosave, self.autosaved_revision) = (Some(Instant::now()), None);
        (self.recorded, self.autosaved_setup) = (0, None);
        let autosave = self.autosave.clone();
        self.start_job(JobKind::Background, tr("clearing autosaves").to_owned(), move |_| {
            let mut autosave = autosave.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(autosave) = autosave.as_mut() {
                autosave.clear().map_err(Problem::from)?;
            }
            Ok(Finished::Quietly)
        });
    }

    /// Shows all messages at the top of the window, above everything else.
    pub(super) fn show_notices(&mut self, ctx: &Context) {
        let now = Instant::now();
        self.notices.retain(|notice| notice.until.is_none_or(|until| until > now));
        if let Some(next) = self.notices.iter().filter_map(|notice| notice.until).min() {
            ctx.request_repaint_after(next - now);
        }
        let excess = self.notices.len().saturating_sub(MAX_NOTICES);
        self.notices.drain(..excess);
        let mut clicked = None;
        Area::new(area_id())
            .order(Order::Foreground)
            .anchor(Align2::CENTER_TOP, vec2(0.0, 44.0))
            .show(ctx, |ui| {
                self.show_lost(ui, &mut clicked);
                self.show_jobs(ui, &mut clicked);
                for (index, notice) in self.notices.iter().enumerate() {
                    card(
                        ui,
                        |ui| {
                            ui.label(&notice.text);
                            if let Some(hint) = &notice.hint {
                                ui.label(RichText::new(hint).weak());
                            }
                        },
                        |ui| {
                            if notice.until.is_some() {
                                return;
                            }
                            if ui.button("OK").on_hover_text(tr("Close this message")).clicked() {
                                clicked = Some(Clicked::CloseNotice(index));
                            }
                        },
                    );
                }
            });
        match clicked {
            Some(Clicked::Recover(index)) => {
                let folder = self.lost_sessions[index].folder().to_owned();
                self.recover(&folder);
            }
            Some(Clicked::Discard(index)) => self.lost_sessions.remove(index).discard(),
            Some(Clicked::RecoverScene(index)) => self.recover_scene(index),
            Some(Clicked::DiscardScene(index)) => self.scenes.lost.remove(index).discard(),
            Some(Clicked::CloseNotice(index)) => {
                self.notices.remove(index);
            }
            Some(Clicked::CancelJob(index)) => self.jobs[index].job.cancel(),
            Some(Clicked::CancelReplay) => self.commands.push(Command::Cancel),
            None => {}
        }
    }

    /// Shows the sessions of programs that ended without saving.
    fn show_lost(&self, ui: &mut Ui, clicked: &mut Option<Clicked>) {
        for (index, lost) in self.lost_sessions.iter().enumerate() {
            let answer = lost_card(ui, lost, tr("painting"));
            *clicked = match answer {
                Some(true) => Some(Clicked::Recover(index)),
                Some(false) => Some(Clicked::Discard(index)),
                None => continue,
            };
        }
        for (index, lost) in self.scenes.lost.iter().enumerate() {
            let answer = lost_card(ui, lost, tr("scene"));
            *clicked = match answer {
                Some(true) => Some(Clicked::RecoverScene(index)),
                Some(false) => Some(Clicked::DiscardScene(index)),
                None => continue,
            };
        }
    }

    /// Shows the jobs that the painter waits for.
    fn show_jobs(&self, ui: &mut Ui, clicked: &mut Option<Clicked>) {
        for (index, job) in self.jobs.iter().enumerate() {
            if !matches!(job.kind, JobKind::Shown | JobKind::Saving) {
                continue;
            }
            ui.ctx().request_repaint_after(Duration::from_millis(100));
            if job.began.elapsed() < JOB_SHOWN_AFTER {
                continue;
            }
            card(
                ui,
                |ui| bar(ui, job.job.label(), job.job.fraction()),
                |ui| {
                    let cancel = ui.button(tr("Cancel"));
                    if cancel
                        .on_hover_text(tr("Cancels it; no file is left half written"))
                        .clicked()
                    {
                        *clicked = Some(Clicked::CancelJob(index));
                    }
                },
            );
        }
        if let Some((done, of)) = self.replay {
            let fraction = done as f32 / of.max(1) as f32;
            let label = tr_format!("playing, action {done} of {of}", done, of);
            card(
                ui,
                |ui| bar(ui, &label, Some(fraction)),
                |ui| {
                    if ui.button(tr("Stop")).on_hover_text(tr("Ends the recording here")).clicked()
                    {
                        *clicked = Some(Clicked::CancelReplay);
                    }
                },
            );
        }
    }
}

/// Returns the script as it will be saved in `path`. If the recording continues a painting, this
/// also writes that painting (`start`) beside it, as `NAME.start.exr`.
fn with_start_file(
    path: &Path,
    script: &StrokeScript,
    start: Option<Arc<Vec<u8>>>,
) -> Result<StrokeScript, Problem> {
    let mut script = script.clone();
    let Some(named) = &script.start else { return Ok(script) };
    let bytes = match start {
        Some(bytes) => bytes,
        // The painting comes from a recording. Its script names the file that it started from.
        None => Arc::new(documents::file::read(Path::new(named))?),
    };
    let beside = path.with_extension("start.exr");
    write_whole(&beside, &bytes)?;
    script.start = Some(file_name(&beside));
    Ok(script)
}

fn write_painting(
    path: &Path,
    canvas: &Document,
    (palette, brushes): (&Document, &[KeptBrush]),
    task: &Task,
) -> Result<(), JobError> {
    let bytes = paint::file::write_with_table(canvas, palette, brushes)
        .map_err(|error| Problem::from_error(&error))?;
    task.reach(0.8)?;
    write_whole(path, &bytes).map_err(Problem::from)?;
    Ok(())
}

/// Reads a painting and returns the content of its file too.
pub(super) fn read_painting(
    path: &Path,
    task: &Task,
) -> Result<(Box<Document>, Arc<Vec<u8>>), JobError> {
    match opened::read(path, task)? {
        Opened::Painting { document, bytes, .. } => Ok((document, bytes)),
        _ => {
            let text = tr_format!("{path}: is not a painting", path = path.display());
            Err(Problem::new(text, tr("another program has changed it")).into())
        }
    }
}

/// Reads a file of the autosave of `title`. The painter never chose the file's name, so that a
/// problem names the autosave instead.
fn read_autosaved(path: &Path, title: &str, task: &Task) -> Result<Box<Document>, JobError> {
    match read_painting(path, task) {
        Ok((document, _)) => Ok(document),
        Err(JobError::Failed(problem)) => {
            let autosave = tr_format!("the autosave of {title}", title);
            let text = problem.text.replace(&path.display().to_string(), &autosave);
            Err(Problem { text, ..problem }.into())
        }
        Err(cancelled) => Err(cancelled),
    }
}

/// We show a job only after this time. A shorter one would just flicker.
const JOB_SHOWN_AFTER: Duration = Duration::from_millis(300);

const WIDTH: f32 = 480.0;

const BUTTONS_WIDTH: f32 = 140.0;

/// Maximum number of messages shown at a time.
const MAX_NOTICES: usize = 4;

/// Bottom of the messages in the last frame, in points; `None` without messages.
pub(crate) fn bottom_of_notices(ctx: &Context) -> Option<f32> {
    let shown = ctx.memory(|memory| memory.area_rect(area_id()))?;
    (shown.height() > 1.0).then_some(shown.bottom())
}

fn area_id() -> Id {
    Id::unique("file notices")
}

/// A button that was clicked, with the index of the session, notice or job.
enum Clicked {
    Recover(usize),
    Discard(usize),
    RecoverScene(usize),
    DiscardScene(usize),
    CloseNotice(usize),
    CancelJob(usize),
    CancelReplay,
}

/// Offers to recover lost work of this `kind`. Returns whether you want it recovered or discarded.
fn lost_card(ui: &mut Ui, lost: &LostSession, kind: &str) -> Option<bool> {
    let then = SystemTime::UNIX_EPOCH + Duration::from_secs(lost.meta.seconds);
    let when = ago(then, SystemTime::now());
    let mut answer = None;
    card(
        ui,
        |ui| {
            ui.label(tr_format!("A {kind} was not saved", kind));
            let details = tr_format!("{title}, autosaved {when}", title = lost.meta.title, when);
            ui.label(RichText::new(details).weak());
        },
        |ui| {
            if ui.button(tr("Discard")).on_hover_text(tr("Deletes the autosaved copy")).clicked() {
                answer = Some(false);
            }
            let tip = tr_format!("Opens the {kind} as it was autosaved", kind);
            if ui.button(tr("Recover")).on_hover_text(tip).clicked() {
                answer = Some(true);
            }
        },
    );
    answer
}

/// A label over a progress bar, or over a spinner if we do not know the progress.
fn bar(ui: &mut Ui, label: &str, fraction: Option<f32>) {
    ui.label(label);
    match fraction {
        Some(fraction) => ui.add(ProgressBar::new(fraction).desired_height(6.0)),
        None => ui.add(Spinner::new()),
    };
}

/// A framed message with buttons at its right.
fn card(ui: &mut Ui, words: impl FnOnce(&mut Ui), buttons: impl FnOnce(&mut Ui)) {
    Frame::popup(ui.style()).show(ui, |ui| {
        ui.set_width(WIDTH);
        ui.horizontal(|ui| {
            ui.vertical(|ui| {
                ui.set_width(WIDTH - BUTTONS_WIDTH);
                words(ui);
            });
            ui.with_layout(Layout::right_to_left(Align::Center), buttons);
        });
    });
}
