//! Applies the results of jobs that ended.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use paint::strokes::Action;

use super::job::JobError;
use super::notice::{Notice, StatusNote};
use super::opened::Opened;
use super::pending::{FileOrigin, PendingAction, Replacement};
use super::problem::Problem;
use super::reference_change::ReferenceChange;
use super::state::Files;
use super::work::{Finished, JobKind, Purpose, file_name};
use crate::language::{tr, tr_format};
use session::{Command, Origin, Pace, RecoveredWork, blank_canvas};

impl Files {
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
            // What was kept of the recording is not known.
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
            Finished::Autosaved { revision, epoch, recorded, desk, digest } => {
                self.autosave_failed = false;
                self.reference_digest = digest;
                if epoch == self.epoch {
                    self.autosaved_revision = Some(revision);
                    (self.recorded, self.autosaved_desk) = (recorded, Some(*desk));
                }
                if let Some(lost) = self.recovered.take() {
                    // The autosaves of this session contain the recovered painting now, so
                    // the lost session is not needed. The painting is still not saved in a
                    // file.
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

    /// The current painting was saved in `path`.
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

    /// Uses the content of a file, according to its kind.
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
}
