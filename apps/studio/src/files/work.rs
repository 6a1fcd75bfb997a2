//! Jobs on files: the purpose of each and its result, the actions that wait for one, and the
//! messages that report it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use graphics::tile::Rect;
use paint::document::Document;
use session::brushes::folder::StoredSet;
use session::brushes::{BrushSet, ImportedBrush};
use session::swatches::SwatchBook;
use session::{Command, LostSession, RecoveredWork};
use web_time::{Duration, Instant};

use super::desk::Desk;
use super::exporting::{Export, TimelapseExport};
use super::job::Job;
use super::opened::{Opened, Revision};
use super::problem::Problem;
use super::request::{DrawnFile, ReadSwatches, ReferenceChange};

/// The reason for which the worker was asked for a snapshot or a recording.
#[derive(Debug)]
pub(super) enum Purpose {
    /// Saves the painting in `path`, keeps a revision if `keep_revision` is set, then
    /// carries out `next`.
    Save { path: PathBuf, next: Option<PendingAction>, keep_revision: bool },
    /// Keeps a revision of the painting in `path`.
    Revision { path: PathBuf },
    /// Exports to `path`.
    Export { export: Export, path: PathBuf },
    /// Crops the painting to these cells.
    Crop(Rect),
    /// Writes an autosave.
    Autosave,
    /// Saves the recording in `path`.
    Recording { path: PathBuf },
    /// Writes a timelapse of the recording to `path`.
    Timelapse { export: TimelapseExport, path: PathBuf },
}

/// The result of a job.
#[derive(Debug)]
pub(super) enum Finished {
    /// A file was read.
    Read { path: PathBuf, opened: Opened },
    /// A revision was read: the painting, and the content of its file.
    RevisionRead(Box<Document>, Arc<Vec<u8>>),
    /// A painting on a picture was begun: the painting, and the content of its file.
    Begun(Box<Document>, Arc<Vec<u8>>),
    /// The painting was cropped; `start` is the content of its file. `revision` is the painting's
    /// counter of changes before.
    Cropped {
        canvas: Box<Document>,
        palette: Arc<Document>,
        start: Arc<Vec<u8>>,
        revision: u64,
        epoch: u64,
    },
    /// A lost session was read.
    Recovered {
        canvas: Box<Document>,
        palette: Box<Document>,
        /// Brushes and recording, which older autosaves do not have.
        work: Option<Box<RecoveredWork>>,
        lost: LostSession,
        remarks: Vec<Problem>,
    },
    /// The painting was saved. `path`, `next` and `keep_revision` are those of
    /// [`Purpose::Save`].
    Saved {
        path: PathBuf,
        revision: u64,
        epoch: u64,
        next: Option<PendingAction>,
        keep_revision: bool,
    },
    /// A revision was written to this file.
    RevisionKept(PathBuf),
    /// An export was written. `remark` tells what the painter should know of it.
    Exported { path: PathBuf, remark: Option<Problem> },
    /// A recording of this many actions was written.
    Recorded { path: PathBuf, actions: usize },
    /// A drawing was saved; `next` is to be carried out.
    DrawingSaved { drawn: DrawnFile, next: Option<PendingAction> },
    /// A drawing was read.
    DrawingRead(DrawnFile),
    /// The revisions of the painting were listed.
    Listed { epoch: u64, revisions: Vec<Revision> },
    /// An autosave was written. `revision` is the painting's counter of changes at that
    /// time, `recorded` the number of actions of its recording that are kept.
    Autosaved {
        revision: u64,
        epoch: u64,
        recorded: usize,
        desk: Box<Desk>,
        digest: Option<(PathBuf, Option<String>)>,
    },
    /// The sets of own brushes were read, except files with these problems.
    BrushSetsRead(Vec<StoredSet>, Vec<Problem>),
    /// A file of brushes was read.
    BrushesRead { path: PathBuf, brushes: ReadBrushes },
    /// The list of kept mixtures was read; `problem` tells what was wrong with it.
    SwatchesRead { book: SwatchBook, problem: Option<Problem> },
    /// A file of mixtures or colours was read.
    SwatchesImported(ReadSwatches),
    /// The script of the scene was saved in a file.
    SceneSaved { path: PathBuf, revision: u64 },
    /// An autosave of the scene was written.
    SceneAutosaved,
    /// The job was done, and its result changes nothing in the window.
    Quietly,
}

/// A job that is running.
#[derive(Debug)]
pub(super) struct RunningJob {
    pub(super) job: Job<Finished>,
    pub(super) began: Instant,
    pub(super) kind: JobKind,
}

/// How visible a job is, and what waits for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JobKind {
    /// The painter waits for the job: its progress is shown, and it can be cancelled.
    Shown,
    /// The job saves a painting: its progress is shown, and the window does not close
    /// before it ends.
    Saving,
    /// It runs in the background without being shown.
    Background,
    /// An autosave, in the background.
    Autosave,
}

impl RunningJob {
    /// Waits for the job, and returns its result unless it failed. A job of the kind
    /// [`JobKind::Shown`] is cancelled first.
    pub(super) fn finish(self) -> Option<Finished> {
        if self.kind == JobKind::Shown {
            self.job.cancel();
        }
        self.job.wait().ok()
    }
}

/// The name of a file without its folder.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// An action that would lose unsaved changes, kept until they are saved or given up.
#[derive(Debug)]
pub(super) enum PendingAction {
    /// Closes the window.
    Close {
        /// Whether the painter gave up drawings that are in no file.
        drawings_given_up: bool,
    },
    /// Opens another painting in place of the current one.
    Replace(Replacement),
    /// Changes the picture beside the canvas or the lines on it.
    Reference(ReferenceChange),
}

/// Another painting, to be opened in place of the current one.
#[derive(Debug)]
pub(super) struct Replacement {
    /// Commands that make the worker open it.
    pub(super) commands: Vec<Command>,
    /// The files that belong to it.
    pub(super) origin: FileOrigin,
}

/// The files that belong to a painting that the worker is opening.
#[derive(Debug, Default)]
pub(super) struct FileOrigin {
    /// The file in which it can be saved again, if it was read from one.
    pub(super) path: Option<PathBuf>,
    /// The lost session that it was recovered from, if it was.
    pub(super) lost: Option<LostSession>,
    /// Content of the file that it was read from. A recording of what is painted on it
    /// needs this as its start.
    pub(super) start: Option<Arc<Vec<u8>>>,
    /// Whether it is the sample painting.
    pub(super) sample: bool,
    /// Whether it has changes that are in no file.
    pub(super) changed: bool,
}

/// Time for which a message that needs no answer is shown.
const SHOWN: Duration = Duration::from_secs(5);

/// A sentence for the status line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatusNote {
    /// One sentence, beginning with a small letter.
    pub text: String,
    /// Suggests what to do.
    pub hint: Option<String>,
}

/// A message over the window.
#[derive(Debug, Clone)]
pub(super) struct Notice {
    /// The message, beginning with a capital letter.
    pub(super) text: String,
    /// Suggests what to do.
    pub(super) hint: Option<String>,
    /// When the message disappears; `None` if it stays until it is closed.
    pub(super) until: Option<Instant>,
}

impl Notice {
    /// A message about something that was done. It disappears after [`SHOWN`].
    pub(super) fn done(text: &str) -> Self {
        Self { text: capitalized(text), hint: None, until: Some(Instant::now() + SHOWN) }
    }

    /// A message about something that failed. It stays until the painter closes it.
    pub(super) fn problem(problem: Problem) -> Self {
        Self { text: capitalized(&problem.text), hint: problem.hint, until: None }
    }
}

/// `text` with a capital first letter.
fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// Own brushes, in sets that are written to the home folder when they change.
#[derive(Debug, Default)]
pub struct BrushSets {
    /// The sets, each with its file.
    pub sets: Vec<StoredSet>,
    /// Number of the set that is shown.
    pub shown: usize,
    /// The brush that was taken over last, with what became of its settings.
    pub imported: Option<ImportedBrush>,
    /// The sets as their files have them.
    pub(super) written: Vec<StoredSet>,
    pub(super) is_read: bool,
    /// Whether reading them has begun.
    pub(super) is_asked: bool,
}

/// Brushes that a file held.
#[derive(Debug)]
pub(super) enum ReadBrushes {
    /// A set of this program.
    Set(BrushSet),
    /// A brush of MyPaint.
    Myb(Box<ImportedBrush>),
}

impl BrushSets {
    /// Whether the sets were read from the home folder, so that they can be changed.
    #[must_use]
    pub fn is_read(&self) -> bool {
        self.is_read
    }

    /// The set that is shown, if there is one.
    #[must_use]
    pub fn set(&self) -> Option<&BrushSet> {
        self.sets.get(self.shown).map(|stored| &stored.set)
    }

    /// The set that is shown, to change it.
    pub fn set_mut(&mut self) -> Option<&mut BrushSet> {
        self.sets.get_mut(self.shown).map(|stored| &mut stored.set)
    }

    /// Removes the set that is shown, with its file.
    pub fn remove_set(&mut self) {
        if self.shown < self.sets.len() {
            self.sets.remove(self.shown);
            self.shown = self.shown.min(self.sets.len().saturating_sub(1));
        }
    }
}
