//! What the end of a job means.

use std::path::{Path, PathBuf};

use pigment::library::PigmentLibrary;
use render::paint::strokes::{Action, StrokeScript};

use super::job::Stopped;
use super::notices::Notice;
use super::opened::Opened;
use super::state::{Files, Opening, Reference, Replacement, Then};
use super::work::{Done, WorkKind, name};
use session::FileFailure;
use session::{Command, Origin, Pace, blank_canvas};

impl Files {
    /// Takes up the results of all jobs that ended.
    pub(super) fn finish_works(&mut self) {
        let mut index = 0;
        while index < self.works.len() {
            match self.works[index].job.poll() {
                None => index += 1,
                Some(result) => {
                    let work = self.works.remove(index);
                    match result {
                        Ok(done) => self.finished(done),
                        Err(Stopped::Cancelled) => {
                            let label = work.job.label();
                            self.notices.push(Notice::said(format!("{label}: given up")));
                        }
                        Err(Stopped::Failed(failure)) => self.failed(work.kind, failure),
                    }
                }
            }
        }
    }

    fn failed(&mut self, kind: WorkKind, failure: FileFailure) {
        // The same every few seconds helps nobody.
        if kind == WorkKind::Autosave && std::mem::replace(&mut self.autosave_fails, true) {
            return;
        }
        self.notices.push(Notice::failed(failure));
    }

    fn finished(&mut self, done: Done) {
        match done {
            Done::Read { path, opened } => self.read_as(path, opened),
            Done::Revision(document, start) => {
                let commands = vec![Command::Open(Origin::Painting(document))];
                let opening = Opening { start: Some(start), ..Opening::default() };
                self.go_on(Then::Replace(Replacement { commands, opening }));
            }
            Done::Recovered { canvas, palette, lost } => {
                let commands = vec![Command::Open(Origin::Recovered { canvas, palette })];
                let path = lost.meta.path.clone();
                let opening = Opening { path, lost: Some(lost), start: None };
                self.go_on(Then::Replace(Replacement { commands, opening }));
            }
            Done::Saved { path, revision, epoch, then, keep } => {
                self.preferences.remember(&path);
                self.notices.push(Notice::said(format!("saved {}", path.display())));
                if epoch == self.epoch {
                    self.saved = Some(revision);
                    self.path = Some(path.clone());
                    if let Some(lost) = self.recovered.take() {
                        lost.discard();
                    }
                    if !self.unsaved() {
                        self.clear_session();
                    }
                    self.list_revisions();
                    if keep {
                        self.keep_revision(path);
                    }
                }
                if let Some(then) = then {
                    self.go_on(then);
                }
            }
            Done::Kept(path) => {
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                self.notices.push(Notice::said(format!("kept as revision {stem}")));
                self.list_revisions();
            }
            Done::Exported { path, remark } => {
                self.notices.push(Notice::said(format!("exported {}", path.display())));
                self.notices.extend(remark.map(Notice::failed));
                self.preferences.last_folder = path.parent().map(ToOwned::to_owned);
            }
            Done::Recorded(path) => {
                self.notices.push(Notice::said(format!("saved {}", path.display())));
                self.preferences.remember(&path);
            }
            Done::Listed { epoch, revisions } => {
                if epoch == self.epoch {
                    self.revisions.set(&self.ctx, self.path.clone(), revisions);
                }
            }
            Done::Autosaved { revision, epoch } => {
                self.autosave_fails = false;
                if epoch == self.epoch {
                    self.autosaved.1 = Some(revision);
                }
                if let Some(lost) = self.recovered.take() {
                    // Kept in this session now; the painting is still in no file.
                    self.saved = None;
                    lost.discard();
                }
            }
            Done::Cleared | Done::Preferences => {}
        }
    }

    /// Takes up what a file was read as.
    fn read_as(&mut self, path: PathBuf, opened: Opened) {
        let replacement = match opened {
            Opened::Painting(document, start) => Replacement {
                commands: vec![Command::Open(Origin::Painting(document))],
                opening: Opening { path: Some(path), lost: None, start: Some(start) },
            },
            Opened::Library(library) => {
                self.preferences.remember(&path);
                let opening = Opening::default();
                let origin = blank_canvas(*library, 192.0, 108.0, 0.1);
                Replacement { commands: vec![Command::Open(origin)], opening }
            }
            Opened::Recording { script, library, remarks } => {
                self.preferences.remember(&path);
                self.notices.extend(remarks.into_iter().map(Notice::failed));
                let commands = vec![Command::Replay { script, library, pace: self.pace() }];
                Replacement { commands, opening: Opening::default() }
            }
            Opened::Picture => {
                self.reference = Some(Reference::Open(path));
                return;
            }
            Opened::Lamp => return self.shine(&path),
        };
        self.go_on(Then::Replace(replacement));
    }

    /// How a recording is played.
    fn pace(&self) -> Pace {
        let wanted = if self.preferences.replay_as_painted { Pace::AsPainted } else { Pace::Fast };
        self.pace.unwrap_or(wanted)
    }

    /// Shows the painting under the lamp measured in `path`.
    fn shine(&mut self, path: &Path) {
        let (Some(easel), Some(text)) = (&self.easel, path.to_str()) else {
            let what = format!("{}: the name of a lamp's file must be text", name(path));
            return self.say(FileFailure::new(what, "rename the file"));
        };
        let mut lighting = easel.lighting.clone();
        lighting.illuminant = text.to_owned();
        self.commands.push(Command::Apply(Action::Light(lighting)));
    }

    /// A new painting on the canvas of `script`.
    pub(super) fn begin(&mut self, script: StrokeScript, library: PigmentLibrary) {
        let origin = Origin::Blank { script: Box::new(script), library: Box::new(library) };
        let commands = vec![Command::Open(origin)];
        self.go_on(Then::Replace(Replacement { commands, opening: Opening::default() }));
    }
}
