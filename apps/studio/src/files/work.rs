//! Jobs on files: the purpose of each, and its result.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use web_time::Instant;

use graphics::tile::Rect;
use paint::document::Document;

use super::desk::Desk;
use super::drawing::DrawnFile;
use super::exporting::Export;
use super::job::Job;
use super::opened::Opened;
use super::own_brushes::ReadBrushes;
use super::pending::PendingAction;
use super::problem::Problem;
use super::revisions::Revision;
use super::swatch_format::ReadSwatches;
use super::timelapse::TimelapseExport;
use session::brushes::folder::StoredSet;
use session::swatches::SwatchBook;
use session::{LostSession, RecoveredWork};

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
