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

use super::exporting::{Export, TimelapseExport};
use super::job::Job;
use super::opened::{Opened, Revision};
use super::problem::Problem;
use super::request::{DrawnFile, ReadSwatches, ReferenceChange};
use super::window_setup::WindowSetup;

/// Why we asked the worker for a snapshot or a recording.
#[derive(Debug)]
pub(super) enum Purpose {
    /// Saves the painting in `path`, keeps a revision if `keep_revision` is set, then carries out
    /// `next`.
    Save { path: PathBuf, next: Option<PendingAction>, keep_revision: bool },
    /// Keeps a revision of this painting.
    Revision { path: PathBuf },
    /// Exports to `path`.
    Export { export: Export, path: PathBuf },
    /// Crops to these cells.
    Crop(Rect),
    /// Writes an autosave.
    Autosave,
    /// Saves the recording.
    Recording { path: PathBuf },
    /// Writes a timelapse of the recording.
    Timelapse { export: TimelapseExport, path: PathBuf },
}

#[derive(Debug)]
pub(super) enum Finished {
    /// A file was read.
    Read { path: PathBuf, opened: Opened },
    /// A revision was read: the painting, and the content of its file.
    RevisionRead(Box<Document>, Arc<Vec<u8>>),
    /// A painting that begins with a picture was made: the painting, and the content of its file.
    Begun(Box<Document>, Arc<Vec<u8>>),
    /// The painting was cropped. `start` is the content of its file. `revision` is the number of
    /// changes of the painting before.
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
        /// Brushes and recording. Older autosaves do not have these.
        work: Option<Box<RecoveredWork>>,
        lost: LostSession,
        remarks: Vec<Problem>,
    },
    /// The painting was saved. The fields `path`, `next` and `keep_revision` come from
    /// [`Purpose::Save`].
    Saved {
        path: PathBuf,
        revision: u64,
        epoch: u64,
        next: Option<PendingAction>,
        keep_revision: bool,
    },
    /// A revision was written.
    RevisionKept(PathBuf),
    /// An export was written. `remark` is a message for the painter, if any.
    Exported { path: PathBuf, remark: Option<Problem> },
    /// A recording of this many actions was written.
    Recorded { path: PathBuf, actions: usize },
    /// A drawing was saved. Then carry out `next`.
    DrawingSaved { drawn: DrawnFile, next: Option<PendingAction> },
    /// A drawing was read.
    DrawingRead(DrawnFile),
    /// The revisions were listed.
    Listed { epoch: u64, revisions: Vec<Revision> },
    /// An autosave was written. `revision` is the number of changes of the painting at this time,
    /// `recorded` the number of actions in the saved recording.
    Autosaved {
        revision: u64,
        epoch: u64,
        recorded: usize,
        setup: Box<WindowSetup>,
        digest: Option<(PathBuf, Option<String>)>,
    },
    /// The painter's sets of brushes were read. The problems are about files that we could not use.
    BrushSetsRead(Vec<StoredSet>, Vec<Problem>),
    /// A file of brushes was read.
    BrushesRead { path: PathBuf, brushes: ReadBrushes },
    /// The list of kept mixtures was read. `problem` describes a fault in it.
    SwatchesRead { book: SwatchBook, problem: Option<Problem> },
    /// Mixtures or colours were read.
    SwatchesImported(ReadSwatches),
    /// The script of a scene was saved.
    SceneSaved { path: PathBuf, revision: u64 },
    /// An autosave of the scene was written.
    SceneAutosaved,
    /// The job was done, and its result changes nothing in the window.
    Quietly,
}

#[derive(Debug)]
pub(super) struct RunningJob {
    pub(super) job: Job<Finished>,
    pub(super) began: Instant,
    pub(super) kind: JobKind,
}

/// How visible a job is, and whether the window waits for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JobKind {
    /// You wait for this job. You see its progress and can cancel it.
    Shown,
    /// The job saves a painting. You see its progress, and the window does not close before its
    /// end.
    Saving,
    /// It runs in the background, and you do not see it.
    Background,
    /// An autosave, in the background.
    Autosave,
}

impl RunningJob {
    /// Waits for the job and returns its result, unless it failed. A job of the kind
    /// [`JobKind::Shown`] is cancelled first.
    pub(super) fn finish(self) -> Option<Finished> {
        if self.kind == JobKind::Shown {
            self.job.cancel();
        }
        self.job.wait().ok()
    }
}

pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// An action that would lose unsaved changes. We keep it until you save or discard them.
#[derive(Debug)]
pub(super) enum PendingAction {
    /// Closes the window.
    Close {
        /// Whether you discarded drawings that are in no file.
        drawings_given_up: bool,
    },
    /// Opens another painting in place of the current one.
    Replace(Replacement),
    Reference(ReferenceChange),
}

/// Another painting, to open in place of the current one.
#[derive(Debug)]
pub(super) struct Replacement {
    pub(super) commands: Vec<Command>,
    /// The files of this painting.
    pub(super) origin: FileOrigin,
}

/// The files of a painting that the worker is opening.
#[derive(Debug, Default)]
pub(super) struct FileOrigin {
    /// The file that you can save it in again, if it was read from one.
    pub(super) path: Option<PathBuf>,
    /// The lost session that it was recovered from, if any.
    pub(super) lost: Option<LostSession>,
    /// Content of the file that it was read from. If you paint on, the recording needs this as its
    /// start.
    pub(super) start: Option<Arc<Vec<u8>>>,
    /// Whether it is the sample painting.
    pub(super) sample: bool,
    /// Whether it has changes that are in no file.
    pub(super) changed: bool,
}

/// Messages that need no answer disappear after this time.
const SHOWN: Duration = Duration::from_secs(5);

/// A sentence for the status line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatusNote {
    /// One sentence, beginning with a small letter.
    pub text: String,
    /// Suggests what to do.
    pub hint: Option<String>,
}

#[derive(Debug, Clone)]
pub(super) struct Notice {
    /// The message, beginning with a capital letter.
    pub(super) text: String,
    /// Suggests what to do.
    pub(super) hint: Option<String>,
    /// When the message disappears; `None` if it stays until you close it.
    pub(super) until: Option<Instant>,
}

impl Notice {
    /// A message about something done. It disappears after [`SHOWN`].
    pub(super) fn done(text: &str) -> Self {
        Self { text: capitalized(text), hint: None, until: Some(Instant::now() + SHOWN) }
    }

    /// A message about a failure. It stays until you close it.
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

/// Own brushes, in sets. We write changed sets to the home folder.
#[derive(Debug, Default)]
pub struct BrushSets {
    /// The sets, each with its file.
    pub sets: Vec<StoredSet>,
    /// Number of the shown set.
    pub shown: usize,
    /// The brush that we imported last, with a note on each of its settings.
    pub imported: Option<ImportedBrush>,
    /// The sets as they are in their files.
    pub(super) written: Vec<StoredSet>,
    pub(super) is_read: bool,
    /// Whether we have begun to read them.
    pub(super) is_asked: bool,
}

#[derive(Debug)]
pub(super) enum ReadBrushes {
    /// A set of this program.
    Set(BrushSet),
    /// A brush of MyPaint.
    Myb(Box<ImportedBrush>),
}

impl BrushSets {
    /// Whether the sets were read from the home folder. You can change them only then.
    #[must_use]
    pub fn is_read(&self) -> bool {
        self.is_read
    }

    /// The shown set, if there is one.
    #[must_use]
    pub fn set(&self) -> Option<&BrushSet> {
        self.sets.get(self.shown).map(|stored| &stored.set)
    }

    /// The shown set, so that you can change it.
    pub fn set_mut(&mut self) -> Option<&mut BrushSet> {
        self.sets.get_mut(self.shown).map(|stored| &mut stored.set)
    }

    /// Removes the shown set, with its file.
    pub fn remove_set(&mut self) {
        if self.shown < self.sets.len() {
            self.sets.remove(self.shown);
            self.shown = self.shown.min(self.sets.len().saturating_sub(1));
        }
    }
}
