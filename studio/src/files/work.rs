//! Work on files, each piece a job; what it is for, and how it is begun.

use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError};
use std::time::{Duration, Instant};

use render::light::Light;
use render::paint::document::Document;
use render::paint::strokes::StrokeScript;

use super::exporting::{self, Export};
use super::job::{Job, Progress, Stopped};
use super::opened::{self, Opened};
use super::revisions::{self, Revision};
use super::state::{Files, Then};
use session::FileFailure;
use session::whole;
use session::{Command, Snapshot};
use session::{LostSession, SessionMeta, now};

/// What a snapshot or a recording was asked for.
#[derive(Debug)]
pub(super) enum Purpose {
    Save { path: PathBuf, then: Option<Then>, revision: bool },
    Revision { path: PathBuf },
    Export { export: Export, path: PathBuf },
    Autosave,
    Recording { path: PathBuf },
}

/// What a job came to.
#[derive(Debug)]
pub(super) enum Done {
    Read { path: PathBuf, opened: Opened },
    Revision(Box<Document>, Arc<Vec<u8>>),
    Recovered { canvas: Box<Document>, palette: Box<Document>, lost: LostSession },
    Saved { path: PathBuf, revision: u64, epoch: u64, then: Option<Then>, keep: bool },
    Kept(PathBuf),
    Exported { path: PathBuf, remark: Option<FileFailure> },
    Recorded(PathBuf),
    Listed { epoch: u64, revisions: Vec<Revision> },
    Autosaved { revision: u64, epoch: u64 },
    Cleared,
    Preferences,
}

/// A job under way.
#[derive(Debug)]
pub(super) struct Work {
    pub(super) job: Job<Done>,
    pub(super) began: Instant,
    pub(super) kind: WorkKind,
}

/// Who is to know of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum WorkKind {
    /// The painter waits for it: progress is shown, and it can be given up.
    Shown,
    /// A painting is being saved: the same, and the window stays open for it.
    Saving,
    /// It goes on by itself.
    Quiet,
    /// An autosave.
    Autosave,
}

impl Work {
    /// Waits for its end.
    pub(super) fn finish(self) {
        if self.kind == WorkKind::Shown {
            self.job.cancel();
        }
        let _ = self.job.wait();
    }
}

impl Files {
    pub(super) fn begin_work(
        &mut self,
        kind: WorkKind,
        label: String,
        work: impl FnOnce(&Progress) -> Result<Done, Stopped> + Send + 'static,
    ) {
        let ctx = self.ctx.clone();
        let job = Job::start(label, move || ctx.request_repaint(), work);
        self.works.push(Work { job, began: Instant::now(), kind });
    }

    /// Whether a painting is being saved.
    pub(super) fn saves(&self) -> bool {
        let waits = |(_, purpose): &(u64, Purpose)| matches!(purpose, Purpose::Save { .. });
        self.awaiting.iter().any(waits)
            || self.works.iter().any(|work| work.kind == WorkKind::Saving)
    }

    /// Asks the worker for the documents.
    fn snapshot_for(&mut self, purpose: Purpose) {
        if self.opening.is_some() {
            // What the worker has now is not what the painter sees.
            self.say(FileFailure::new("a painting is being opened", "try again in a moment"));
            return;
        }
        self.number += 1;
        self.awaiting.push((self.number, purpose));
        self.commands.push(Command::Snapshot(self.number));
    }

    pub(super) fn save(&mut self, path: PathBuf, then: Option<Then>) {
        self.snapshot_for(Purpose::Save { path, then, revision: false });
    }

    pub(super) fn save_and_keep(&mut self, path: PathBuf) {
        self.snapshot_for(Purpose::Save { path, then: None, revision: true });
    }

    pub(super) fn keep_revision(&mut self, path: PathBuf) {
        self.snapshot_for(Purpose::Revision { path });
    }

    pub(super) fn export(&mut self, export: Export, path: PathBuf) {
        self.snapshot_for(Purpose::Export { export, path });
    }

    pub(super) fn record(&mut self, path: PathBuf) {
        self.number += 1;
        self.awaiting.push((self.number, Purpose::Recording { path }));
        self.commands.push(Command::Recording(self.number));
    }

    /// Begins what the documents of `snapshot` were asked for.
    pub(super) fn begin_with(&mut self, purpose: Purpose, snapshot: &Snapshot) {
        let canvas = snapshot.canvas.clone();
        let (revision, epoch) = (snapshot.revision, self.epoch);
        match purpose {
            Purpose::Save { path, then, revision: keep } => {
                let label = format!("saving {}", name(&path));
                self.begin_work(WorkKind::Saving, label, move |progress| {
                    write_painting(&path, &canvas, progress)?;
                    Ok(Done::Saved { path, revision, epoch, then, keep })
                });
            }
            Purpose::Revision { path } => {
                let light = self.light_of(&canvas);
                self.begin_work(
                    WorkKind::Shown,
                    "keeping a revision".to_owned(),
                    move |progress| {
                        let light = light()?;
                        revisions::keep(&path, &canvas, &light, progress).map(Done::Kept)
                    },
                );
            }
            Purpose::Export { export, path } => {
                let light = self.light_of(&canvas);
                let label = format!("exporting {}", name(&path));
                self.begin_work(WorkKind::Shown, label, move |progress| {
                    let light = light()?;
                    let remark = exporting::export(export, &canvas, &light, &path, progress)?;
                    Ok(Done::Exported { path, remark })
                });
            }
            Purpose::Autosave => self.begin_autosave(snapshot),
            Purpose::Recording { .. } => {}
        }
    }

    pub(super) fn begin_recording(&mut self, path: PathBuf, script: Arc<StrokeScript>) {
        let label = format!("saving {}", name(&path));
        let start = self.start.clone();
        self.begin_work(WorkKind::Shown, label, move |_| {
            let script = with_its_start(&path, &script, start)?;
            let text = script.to_json();
            let text = text.map_err(|error| FileFailure::explained(&error))?;
            whole::write(&path, text.as_bytes())?;
            Ok(Done::Recorded(path))
        });
    }

    /// The light of a document: the worker's, where it is the same, which a file
    /// may no longer tell.
    fn light_of(
        &self,
        document: &Arc<Document>,
    ) -> impl FnOnce() -> Result<Arc<Light>, FileFailure> + Send + 'static {
        let document = document.clone();
        let known = self.easel.as_ref().filter(|easel| {
            let (own, now) = (&document.lighting, &easel.lighting);
            (&own.illuminant, &own.observer) == (&now.illuminant, &now.observer)
                && *easel.library == document.library
        });
        let known = known.map(|easel| easel.light.clone());
        move || match known {
            Some(light) => Ok(light),
            None => {
                let lighting = &document.lighting;
                Light::named(&document.library, &lighting.illuminant, &lighting.observer)
                    .map(Arc::new)
                    .map_err(|error| FileFailure::told(&error, error.hint()))
            }
        }
    }

    /// Reads a file as whatever it is.
    pub(super) fn read(&mut self, path: PathBuf) {
        // A later folder of the program must not change what is meant.
        let path = std::path::absolute(&path).unwrap_or(path);
        let label = format!("reading {}", name(&path));
        self.begin_work(WorkKind::Shown, label, move |progress| {
            let opened = opened::read(&path, progress)?;
            Ok(Done::Read { path, opened })
        });
    }

    pub(super) fn read_revision(&mut self, path: PathBuf) {
        let label = format!("reading revision {}", name(&path));
        self.begin_work(WorkKind::Shown, label, move |progress| {
            let (document, bytes) = painting(&path, progress)?;
            Ok(Done::Revision(document, bytes))
        });
    }

    /// Takes up what a lost session left.
    pub(super) fn recover(&mut self, folder: &Path) {
        let Some(at) = self.lost.iter().position(|lost| lost.folder() == folder) else { return };
        let lost = self.lost.remove(at);
        self.begin_work(
            WorkKind::Shown,
            format!("recovering {}", lost.meta.title),
            move |progress| {
                let [canvas, palette] = lost.files();
                let (canvas, _) = painting(&canvas, progress)?;
                let (palette, _) = painting(&palette, progress)?;
                Ok(Done::Recovered { canvas, palette, lost })
            },
        );
    }

    pub(super) fn list_revisions(&mut self) {
        let epoch = self.epoch;
        let Some(path) = self.path.clone() else {
            self.revisions.set(&self.ctx, None, Vec::new());
            return;
        };
        self.begin_work(WorkKind::Quiet, "looking for revisions".to_owned(), move |progress| {
            let revisions = revisions::list(&path, progress)?;
            Ok(Done::Listed { epoch, revisions })
        });
    }

    /// Asks for an autosave when it is time, and sees to it that the window wakes
    /// for it.
    pub(super) fn autosave(&mut self) {
        let Some(easel) = self.easel.clone() else { return };
        let busy = self.works.iter().any(|work| work.kind == WorkKind::Autosave)
            || self.awaiting.iter().any(|(_, purpose)| matches!(purpose, Purpose::Autosave));
        let changed = easel.stroke_open || self.autosaved.1 != Some(easel.revision);
        if busy || !changed || !self.unsaved() || self.opening.is_some() {
            return;
        }
        let seconds = Duration::from_secs(self.preferences.autosave_seconds);
        match seconds.checked_sub(self.autosaved.0.elapsed()) {
            Some(left) if !left.is_zero() => self.ctx.request_repaint_after(left),
            _ => {
                self.autosaved.0 = Instant::now();
                self.snapshot_for(Purpose::Autosave);
            }
        }
    }

    fn begin_autosave(&mut self, snapshot: &Snapshot) {
        let (canvas, palette) = (snapshot.canvas.clone(), snapshot.palette.clone());
        let (revision, epoch) = (snapshot.revision, self.epoch);
        let meta = SessionMeta { title: self.title(), path: self.path.clone(), seconds: now() };
        let session = self.session.clone();
        self.begin_work(WorkKind::Autosave, "autosave".to_owned(), move |_| {
            let mut session = session.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(session) = session.as_mut() {
                alone(|| session.keep(&canvas, &palette, &meta))?;
            }
            Ok(Done::Autosaved { revision, epoch })
        });
    }

    /// Drops what autosave kept: it stands in a file now, or is not wanted.
    pub(super) fn clear_session(&mut self) {
        self.autosaved = (Instant::now(), None);
        let session = self.session.clone();
        self.begin_work(WorkKind::Quiet, "clearing autosaves".to_owned(), move |_| {
            let mut session = session.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(session) = session.as_mut() {
                session.clear()?;
            }
            Ok(Done::Cleared)
        });
    }

    /// Writes the preferences some time after they changed.
    pub(super) fn write_preferences(&mut self) {
        let quiet = self.works.iter().all(|work| work.kind != WorkKind::Quiet);
        if self.preferences == self.written || !quiet {
            return;
        }
        self.preferences.bound();
        self.written = self.preferences.clone();
        let (preferences, path) = (self.preferences.clone(), self.home.preferences());
        self.begin_work(WorkKind::Quiet, "writing preferences".to_owned(), move |_| {
            preferences.write(&path)?;
            Ok(Done::Preferences)
        });
    }
}

/// The script, to be saved as `path`. One that goes on with a painting needs that
/// painting as it was at first: it is put beside the script, `NAME.start.exr`.
fn with_its_start(
    path: &Path,
    script: &StrokeScript,
    start: Option<Arc<Vec<u8>>>,
) -> Result<StrokeScript, FileFailure> {
    let mut script = script.clone();
    let Some(named) = &script.start else { return Ok(script) };
    let bytes = match start {
        Some(bytes) => bytes,
        // Of a recording that was played and is recorded anew.
        None => std::fs::read(named)
            .map(Arc::new)
            .map_err(|error| FileFailure::io(Path::new(named), "read", &error))?,
    };
    let beside = path.with_extension("start.exr");
    whole::write(&beside, &bytes)?;
    script.start = Some(name(&beside));
    Ok(script)
}

/// Runs `work` so that of all cores it takes one: the painter has the others.
fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

fn write_painting(path: &Path, canvas: &Document, progress: &Progress) -> Result<(), Stopped> {
    let bytes = render::paint::file::write(canvas)
        .map_err(|error| FileFailure::told(&error, error.hint()))?;
    progress.tell(0.8)?;
    whole::write(path, &bytes)?;
    Ok(())
}

fn painting(path: &Path, progress: &Progress) -> Result<(Box<Document>, Arc<Vec<u8>>), Stopped> {
    match opened::read(path, progress)? {
        Opened::Painting(document, bytes) => Ok((document, bytes)),
        _ => {
            let what = format!("{}: is no painting", path.display());
            Err(FileFailure::new(what, "it was changed by another program").into())
        }
    }
}

/// A file's name, for people.
pub(super) fn name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
