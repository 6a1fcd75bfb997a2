//! State of the files of the painting, and the basic steps on it.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use web_time::Instant;

use eframe::egui::{Context, ViewportCommand};

use super::browser::Thumbnails;
use super::desk::Desk;
use super::drawing::DrawnFile;
use super::home::Home;
use super::job::{Job, JobError, Progress};
use super::notice::{Notice, StatusNote};
use super::open_dialog::OpenDialog;
use super::own_brushes::BrushSets;
use super::pending::{FileOrigin, PendingAction, Replacement};
use super::preferences::Preferences;
use super::problem::Problem;
use super::reference_change::ReferenceChange;
use super::revision_list::RevisionList;
use super::scene_files::SceneFiles;
use super::swatch_list::SwatchList;
use super::work::{Finished, JobKind, Purpose, RunningJob};
use crate::language::tr;
use session::{Autosave, Command, LostSession, Pace, PaintingState};

/// The files of the painting: opening, saving, exports, autosave, preferences and their
/// dialogs.
#[derive(Debug)]
pub struct Files {
    pub(super) ctx: Context,
    pub(super) home: Home,
    /// The painter's preferences. Changes are written to their file automatically.
    pub preferences: Preferences,
    pub(super) written_preferences: Preferences,
    /// Speed at which recordings are played; overrides the preferences.
    pub pace: Option<Pace>,
    pub(super) painting: Option<Arc<PaintingState>>,
    pub(super) path: Option<PathBuf>,
    /// Content of the painting's file when it was opened.
    pub(super) start: Option<Arc<Vec<u8>>>,
    /// The worker's counter of changes when the painting was last saved or opened; `None`
    /// before that, and once a recovered painting was autosaved.
    pub(super) saved_revision: Option<u64>,
    /// Counts opened paintings, so that the result of a job is not applied to another
    /// painting.
    pub(super) epoch: u64,
    /// Files of the painting that the worker is opening; `None` while it opens none.
    pub(super) opening: Option<FileOrigin>,
    pub(super) last_request: u64,
    /// Requests to the worker that it has not answered yet.
    pub(super) awaited: Vec<(u64, Purpose)>,
    pub(super) jobs: Vec<RunningJob>,
    /// Open dialogs, the topmost last.
    pub(super) dialogs: Vec<OpenDialog>,
    /// Small pictures of files, for the file browser.
    pub(super) thumbnails: Thumbnails,
    pub(super) notices: Vec<Notice>,
    pub(super) lost_sessions: Vec<LostSession>,
    /// The session that the painting was recovered from, until it is saved again.
    pub(super) recovered: Option<LostSession>,
    pub(super) autosave: Arc<Mutex<Option<Autosave>>>,
    pub(super) last_autosave: Option<Instant>,
    /// Endings of the files that an open dialog asked for, until they are taken.
    pub(super) wanted: Option<Vec<&'static str>>,
    pub(super) autosaved_revision: Option<u64>,
    /// Number of actions of the recording that the autosaves hold.
    pub(super) recorded: usize,
    /// How the window is set up, and how it was at the last autosave.
    pub(super) desk: Desk,
    pub(super) autosaved_desk: Option<Desk>,
    /// The set-up of a recovered painting, until the window takes it.
    pub(super) recovered_desk: Option<Desk>,
    /// A reference picture and the digest of its file.
    pub(super) reference_digest: Option<(PathBuf, Option<String>)>,
    /// Whether the last autosave failed, which is reported only once.
    pub(super) autosave_failed: bool,
    /// Actions played and total number of actions of a recording that is playing.
    pub(super) replay: Option<(usize, usize)>,
    /// Whether the sample painting is being played.
    pub(super) sample: bool,
    /// Whether the next state is that of the sample painting as it was played.
    pub(super) sample_settles: bool,
    /// Own brushes of the painter.
    pub brush_sets: BrushSets,
    /// The revisions of the painting.
    pub revisions: RevisionList,
    /// Changes of the picture beside the canvas, the oldest first.
    pub(super) reference: VecDeque<ReferenceChange>,
    /// Drawings on that picture that are in no file.
    pub(super) unsaved_drawings: Vec<DrawnFile>,
    /// Mixtures that the painter keeps.
    pub(super) swatches: SwatchList,
    /// Files of scenes.
    pub(super) scenes: SceneFiles,
    /// Commands for the worker.
    pub(super) commands: Vec<Command>,
    /// Whether the window closes although changes may be lost.
    pub(super) closing: bool,
    /// Whether the window closes once the painting is saved.
    pub(super) closes_when_saved: bool,
    /// Sentence for the status line that the window has not shown yet.
    pub(super) status: Option<StatusNote>,
}

impl Files {
    /// Begins a session in `home` and looks for lost ones. `ctx` is repainted when a job
    /// ends.
    #[must_use]
    pub fn new(ctx: &Context, home: Home, preferences: Preferences) -> Self {
        let mut notices = Vec::new();
        let lost = LostSession::all(&home.sessions());
        let autosave = Autosave::begin(&home.sessions());
        let lost_sessions = lost.unwrap_or_else(|failure| {
            notices.push(Notice::problem(failure.into()));
            Vec::new()
        });
        let lost_scenes = LostSession::all(&home.scenes()).unwrap_or_else(|failure| {
            notices.push(Notice::problem(failure.into()));
            Vec::new()
        });
        let autosave =
            autosave.map_err(|failure| notices.push(Notice::problem(failure.into()))).ok();
        Self {
            ctx: ctx.clone(),
            home,
            written_preferences: preferences.clone(),
            preferences,
            pace: None,
            painting: None,
            path: None,
            start: None,
            saved_revision: None,
            epoch: 0,
            opening: None,
            last_request: 0,
            awaited: Vec::new(),
            jobs: Vec::new(),
            dialogs: Vec::new(),
            thumbnails: Thumbnails::default(),
            notices,
            lost_sessions,
            recovered: None,
            autosave: Arc::new(Mutex::new(autosave)),
            last_autosave: Some(Instant::now()),
            wanted: None,
            autosaved_revision: None,
            recorded: 0,
            desk: Desk::default(),
            autosaved_desk: None,
            recovered_desk: None,
            reference_digest: None,
            autosave_failed: false,
            replay: None,
            sample: false,
            sample_settles: false,
            brush_sets: BrushSets::default(),
            revisions: RevisionList::default(),
            reference: VecDeque::new(),
            unsaved_drawings: Vec::new(),
            swatches: SwatchList::default(),
            scenes: SceneFiles::new(lost_scenes),
            commands: Vec::new(),
            closing: false,
            closes_when_saved: false,
            status: None,
        }
    }

    /// Shows a problem over the window until it is closed.
    pub fn report(&mut self, problem: Problem) {
        self.notices.push(Notice::problem(problem));
    }

    /// The messages over the window that stay until they are closed.
    pub fn notices(&self) -> impl Iterator<Item = &str> {
        self.notices.iter().filter(|notice| notice.until.is_none()).map(|it| it.text.as_str())
    }

    /// Hints of these messages, for those that have one.
    pub fn hints(&self) -> impl Iterator<Item = &str> {
        let staying = self.notices.iter().filter(|notice| notice.until.is_none());
        staying.filter_map(|notice| notice.hint.as_deref())
    }

    /// Content of the file that the painting was opened from; `None` for one begun bare.
    #[must_use]
    pub fn opened_content(&self) -> Option<&[u8]> {
        self.start.as_deref().map(Vec::as_slice)
    }

    /// Whether a recording is being played.
    #[must_use]
    pub fn is_playing(&self) -> bool {
        self.replay.is_some()
    }

    /// Removes and returns the sentence for the status line, if there is a new one.
    pub fn take_status(&mut self) -> Option<StatusNote> {
        self.status.take()
    }

    /// The file of the painting, if it has one.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Name of the painting: its file's name without extension, or its title.
    #[must_use]
    pub fn title(&self) -> String {
        let stem = self.path.as_ref().and_then(|path| path.file_stem());
        let title = || self.painting.as_ref().map(|state| state.title.clone()).unwrap_or_default();
        let title = stem.map_or_else(title, |stem| stem.to_string_lossy().into_owned());
        if title.is_empty() { "untitled".to_owned() } else { title }
    }

    /// Whether the painting has changes that are in no file.
    #[must_use]
    pub fn has_unsaved_changes(&self) -> bool {
        self.painting.as_ref().is_some_and(|state: &Arc<PaintingState>| {
            self.recovered.is_some()
                || state.stroke_open
                || self.saved_revision != Some(state.revision)
        })
    }

    /// Number of autosaves of programs that were killed, which are offered.
    #[must_use]
    pub fn lost(&self) -> usize {
        self.lost_sessions.len()
    }

    /// Whether a dialog is open, which takes all key presses.
    #[must_use]
    pub fn has_dialog(&self) -> bool {
        !self.dialogs.is_empty()
    }

    /// Removes and returns the oldest change of the picture beside the canvas, if there is one.
    pub fn take_reference(&mut self) -> Option<ReferenceChange> {
        self.reference.pop_front()
    }

    /// Whether a painting is being saved.
    pub(super) fn is_saving(&self) -> bool {
        self.awaited
            .iter()
            .any(|(_, purpose): &(u64, Purpose)| matches!(purpose, Purpose::Save { .. }))
            || self.jobs.iter().any(|job| job.kind == JobKind::Saving)
    }

    /// Starts a job on a thread of its own.
    pub(super) fn start_job(
        &mut self,
        kind: JobKind,
        label: String,
        work: impl FnOnce(&Progress) -> Result<Finished, JobError> + Send + 'static,
    ) {
        let ctx = self.ctx.clone();
        let job = Job::start(label, move || ctx.request_repaint(), work);
        self.jobs.push(RunningJob { job, began: Instant::now(), kind });
    }

    /// Asks the worker for a snapshot of the painting.
    pub(super) fn request_snapshot(&mut self, purpose: Purpose) {
        if self.opening.is_some() {
            // The worker still has the painting before the one that the painter sees.
            self.report(Problem::new(
                tr("a painting is being opened"),
                tr("try again in a moment"),
            ));
            return;
        }
        let number = self.next_request(purpose);
        self.commands.push(Command::Snapshot(number));
    }

    /// Asks the worker for all that an autosave holds.
    pub(super) fn request_autosave(&mut self) {
        let number = self.next_request(Purpose::Autosave);
        self.commands.push(Command::Keep { number, recorded: self.recorded });
    }

    /// Takes note of how the window is set up. To be called every frame before [`Files::update`].
    pub fn note_desk(&mut self, desk: Desk) {
        self.desk = desk;
    }

    /// Removes and returns the set-up of a painting that was recovered, once.
    pub fn take_desk(&mut self) -> Option<Desk> {
        self.recovered_desk.take()
    }

    /// Asks the worker for the recording.
    pub(super) fn request_recording(&mut self, purpose: Purpose) {
        let number = self.next_request(purpose);
        self.commands.push(Command::Recording(number));
    }

    fn next_request(&mut self, purpose: Purpose) -> u64 {
        self.last_request += 1;
        self.awaited.push((self.last_request, purpose));
        self.last_request
    }

    /// Removes and returns the purpose of the request with this number.
    pub(super) fn take_purpose(&mut self, number: u64) -> Option<Purpose> {
        let at = self.awaited.iter().position(|(own, _)| *own == number)?;
        Some(self.awaited.remove(at).1)
    }

    /// Carries out an action, after asking about unsaved changes if there are any.
    pub(super) fn carry_out_safely(&mut self, action: PendingAction) {
        let loses_painting = !matches!(action, PendingAction::Reference(_));
        if !self.drawings_lost_by(&action).is_empty() {
            self.dialogs.push(OpenDialog::UnsavedDrawings(action));
        } else if loses_painting && self.has_unsaved_changes() {
            self.dialogs.push(OpenDialog::Unsaved(action));
        } else {
            self.carry_out(action);
        }
    }

    /// Carries out an action, even if unsaved changes are lost by it.
    pub(super) fn carry_out(&mut self, action: PendingAction) {
        match action {
            PendingAction::Close { .. } => {
                self.closing = true;
                self.ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            PendingAction::Replace(Replacement { commands, origin }) => {
                if let Some(lost) = self.recovered.take() {
                    lost.discard();
                }
                self.awaited.clear();
                self.opening = Some(origin);
                self.commands.extend(commands);
            }
            PendingAction::Reference(change) => self.reference.push_back(change),
        }
    }
}
