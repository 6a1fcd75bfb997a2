//! State of the painting's files, and the entry points for the window: worker events, the update
//! and drawing of each frame, requests of menus and panels, and the end of the session.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use documents::Task;
use eframe::egui::{Context, Ui, ViewportCommand};
use session::brushes::BrushSet;
use session::swatches::SwatchBook;
use session::{Autosave, Command, Event, LostSession, Pace, PaintingState};
use spectra::swatch_file::SwatchFile;
use web_time::Instant;

use super::browser::{Browser, Thumbnails};
use super::exporting::{Export, SceneFiles, ScenePurpose, TimelapseExport};
use super::job::{Job, JobError};
use super::new_dialog::{CanvasPicture, NewDialog};
use super::opened::RevisionList;
use super::preferences::{Home, Preferences};
use super::problem::Problem;
use super::request::{Drawing, DrawingKind, DrawnFile, FileRequest, ReferenceChange, SwatchFormat};
use super::window_setup::WindowSetup;
use super::work::{
    BrushSets, FileOrigin, Finished, JobKind, Notice, PendingAction, Purpose, Replacement,
    RunningJob, StatusNote,
};
use crate::language::tr;

/// The files of the painting: opening, saving, exports, autosave, preferences and their
/// dialogs.
#[derive(Debug)]
pub struct Files {
    pub(super) ctx: Context,
    pub(super) home: Home,
    /// The painter's preferences. We write changes to their file automatically.
    pub preferences: Preferences,
    pub(super) written_preferences: Preferences,
    /// Speed at which recordings are played; overrides the preferences.
    pub pace: Option<Pace>,
    pub(super) painting: Option<Arc<PaintingState>>,
    pub(super) path: Option<PathBuf>,
    /// Content of the painting's file when you opened it.
    pub(super) start: Option<Arc<Vec<u8>>>,
    /// The worker's counter of changes when the painting was last saved or opened. `None` before
    /// this, and after a recovered painting was autosaved.
    pub(super) saved_revision: Option<u64>,
    /// Counts opened paintings, so that we do not apply the result of a job to another painting.
    pub(super) epoch: u64,
    /// Files of the painting that the worker is opening.
    pub(super) opening: Option<FileOrigin>,
    pub(super) last_request: u64,
    /// Requests that the worker has not answered yet.
    pub(super) awaited: Vec<(u64, Purpose)>,
    pub(super) jobs: Vec<RunningJob>,
    pub(super) dialogs: Vec<OpenDialog>,
    /// Thumbnails for the file browser.
    pub(super) thumbnails: Thumbnails,
    pub(super) notices: Vec<Notice>,
    pub(super) lost_sessions: Vec<LostSession>,
    pub(super) recovered: Option<LostSession>,
    pub(super) autosave: Arc<Mutex<Option<Autosave>>>,
    pub(super) last_autosave: Option<Instant>,
    /// Extensions of the files that an open dialog asks for, until the page takes them.
    pub(super) wanted: Option<Vec<&'static str>>,
    pub(super) autosaved_revision: Option<u64>,
    /// Number of recorded actions that the autosaves hold.
    pub(super) recorded: usize,
    /// How the window is set up now, and how it was at the last autosave.
    pub(super) setup: WindowSetup,
    pub(super) autosaved_setup: Option<WindowSetup>,
    /// The set-up of a recovered painting, until the window takes it.
    pub(super) recovered_setup: Option<WindowSetup>,
    /// File of a reference picture, and its digest.
    pub(super) reference_digest: Option<(PathBuf, Option<String>)>,
    /// Whether the last autosave failed. We report only the first of several failures.
    pub(super) autosave_failed: bool,
    pub(super) replay: Option<(usize, usize)>,
    /// Whether the sample painting is being played.
    pub(super) sample: bool,
    /// Whether the replay of the sample painting has ended, but its last state has not arrived yet.
    pub(super) sample_settles: bool,
    /// Own brushes of the painter.
    pub brush_sets: BrushSets,
    /// The revisions of the painting.
    pub revisions: RevisionList,
    /// Changes of the picture beside the canvas, the oldest first.
    pub(super) reference: VecDeque<ReferenceChange>,
    /// Drawings on that picture that are in no file.
    pub(super) unsaved_drawings: Vec<DrawnFile>,
    /// Kept mixtures of the painter.
    pub(super) swatches: SwatchList,
    pub(super) scenes: SceneFiles,
    pub(super) commands: Vec<Command>,
    /// Whether the window closes, even if changes are lost.
    pub(super) closing: bool,
    /// Whether the window closes as soon as the painting is saved.
    pub(super) closes_when_saved: bool,
    /// Sentence for the status line that we have not shown yet.
    pub(super) status: Option<StatusNote>,
}

impl Files {
    /// Begins a session in `home` and looks for lost ones. When a job ends, it repaints `ctx`.
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
            setup: WindowSetup::default(),
            autosaved_setup: None,
            recovered_setup: None,
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

    /// Hints of these messages.
    pub fn hints(&self) -> impl Iterator<Item = &str> {
        let staying = self.notices.iter().filter(|notice| notice.until.is_none());
        staying.filter_map(|notice| notice.hint.as_deref())
    }

    /// Content of the file that you opened the painting from; `None` if it began bare.
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
        let title = match stem {
            Some(stem) => stem.to_string_lossy().into_owned(),
            None => self.painting.as_ref().map(|state| state.title.clone()).unwrap_or_default(),
        };
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

    /// Number of autosaves that we offer, because their programs were killed.
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

    pub(super) fn start_job(
        &mut self,
        kind: JobKind,
        label: String,
        work: impl FnOnce(&Task) -> Result<Finished, JobError> + Send + 'static,
    ) {
        let ctx = self.ctx.clone();
        let job = Job::start(label, move || ctx.request_repaint(), work);
        self.jobs.push(RunningJob { job, began: Instant::now(), kind });
    }

    /// Asks the worker for a snapshot of the painting.
    pub(super) fn request_snapshot(&mut self, purpose: Purpose) {
        if self.opening.is_some() {
            // You see the next painting already, but the worker still has the one before.
            self.report(Problem::new(
                tr("a painting is being opened"),
                tr("try again in a moment"),
            ));
            return;
        }
        let number = self.next_request(purpose);
        self.commands.push(Command::Snapshot(number));
    }

    /// Asks the worker for everything that an autosave holds.
    pub(super) fn request_autosave(&mut self) {
        let number = self.next_request(Purpose::Autosave);
        self.commands.push(Command::Keep { number, recorded: self.recorded });
    }

    /// Notes the set-up of the window. Call this every frame before [`Files::update`].
    pub fn note_window_setup(&mut self, setup: WindowSetup) {
        self.setup = setup;
    }

    /// Removes and returns the set-up of a recovered painting.
    pub fn take_window_setup(&mut self) -> Option<WindowSetup> {
        self.recovered_setup.take()
    }

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

    /// Carries out an action. If there are unsaved changes, it asks first.
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

    /// Carries out an action, although this may lose unsaved changes.
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

    /// Handles an event of the worker.
    pub fn handle_event(&mut self, event: &Event) {
        match event {
            Event::Opened(state) => self.opened(state),
            Event::State(state) => {
                self.painting = Some(state.clone());
                self.settle_sample();
            }
            Event::Snapshot(snapshot) => {
                if let Some(purpose) = self.take_purpose(snapshot.number) {
                    self.start_with_snapshot(purpose, snapshot);
                }
            }
            Event::Kept(kept) => {
                if let Some(Purpose::Autosave) = self.take_purpose(kept.snapshot.number) {
                    self.start_autosave(kept);
                }
            }
            Event::Recording { number, script } => {
                if let Some(purpose) = self.take_purpose(*number) {
                    self.start_with_recording(purpose, script.clone());
                }
            }
            Event::Progress { done, of } => self.replay = Some((*done, *of)),
            Event::Replayed => {
                self.replay = None;
                self.sample_played();
            }
            Event::Message { failed: true, .. } => self.opening = None,
            _ => {}
        }
    }

    /// Call this when the worker has opened a painting.
    fn opened(&mut self, state: &Arc<PaintingState>) {
        let FileOrigin { path, lost, start, sample, changed } =
            self.opening.take().unwrap_or_default();
        (self.sample, self.sample_settles) = (sample, false);
        self.epoch += 1;
        self.start = start;
        self.saved_revision = (!changed).then_some(state.revision);
        self.painting = Some(state.clone());
        self.autosaved_revision = None;
        (self.recorded, self.autosaved_setup) = (0, None);
        if let Some(path) = &path
            && lost.is_none()
        {
            self.preferences.remember(path);
        }
        self.path = path;
        if let Some(lost) = &lost {
            let setup = lost.meta.desk.clone();
            self.recovered_setup = setup.and_then(|setup| serde_json::from_value(setup).ok());
        }
        if lost.is_some() {
            // The painting is not saved yet. This makes an autosave due now. We delete the lost
            // session after it.
            self.last_autosave = None;
            self.recovered = lost;
        } else if changed {
            // The earlier autosaves stay until one holds the change.
            self.last_autosave = None;
        } else {
            self.clear_autosaves();
        }
        self.list_revisions();
    }

    /// Applies results of jobs, starts autosaves, and keeps the window open while you would lose
    /// changes. Returns commands for the worker. Call this every frame, also while the window is
    /// hidden.
    pub fn update(&mut self, ctx: &Context) -> Vec<Command> {
        self.collect_results();
        self.close_when_saved();
        self.read_brush_sets_once();
        self.autosave_when_due();
        self.write_changed_preferences();
        self.write_changed_brush_sets();
        self.keep_swatches();
        if ctx.input(|input| input.viewport().close_requested()) && !self.may_close() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
        }
        std::mem::take(&mut self.commands)
    }

    /// Whether the window may close now. If changes would be lost, we ask, unless they are already
    /// being saved.
    fn may_close(&mut self) -> bool {
        if self.closing {
            return true;
        }
        let writes = self.jobs.iter().any(|job| job.kind == JobKind::Saving);
        // You ask again, and the worker has not even answered. We ask you instead of waiting.
        let asked_again = std::mem::take(&mut self.closes_when_saved) && !writes;
        if self.is_saving() && !asked_again {
            self.closes_when_saved = true;
            let text =
                tr("what is being saved is finished first, then the program closes").to_owned();
            self.status = Some(StatusNote { text, hint: None });
            return false;
        }
        if !self.has_unsaved_changes() && self.unsaved_drawings.is_empty() {
            return true;
        }
        if !self.dialogs.iter().any(|dialog: &OpenDialog| match dialog {
            OpenDialog::Unsaved(action) | OpenDialog::UnsavedDrawings(action) => {
                matches!(action, PendingAction::Close { .. })
            }
            _ => false,
        }) {
            self.carry_out_safely(PendingAction::Close { drawings_given_up: false });
        }
        false
    }

    fn close_when_saved(&mut self) {
        if self.closes_when_saved && !self.is_saving() && !self.closing {
            self.closes_when_saved = false;
            self.carry_out_safely(PendingAction::Close { drawings_given_up: false });
        }
    }

    /// Shows messages and the topmost dialog.
    pub fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.show_notices(&ctx);
        self.show_dialog(ui);
    }

    /// Handles a request of a menu or panel.
    pub fn request(&mut self, request: FileRequest, state: &PaintingState) {
        match request {
            FileRequest::Open(Some(path)) => self.read(path),
            FileRequest::Open(None) => self.ask_for_file(),
            FileRequest::Save => match self.path.clone() {
                Some(path) => self.save(path, None),
                None => self.ask_where_to_save(None, false),
            },
            FileRequest::SaveAs => self.ask_where_to_save(None, false),
            FileRequest::KeepRevision => match self.path.clone() {
                Some(path) => self.request_snapshot(Purpose::Revision { path }),
                None => self.ask_where_to_save(None, true),
            },
            FileRequest::OpenRevision(path) => self.read_revision(path),
            FileRequest::DeleteRevision(path) => {
                self.dialogs.push(OpenDialog::DeleteRevision(path));
            }
            FileRequest::Export => self.ask_what_to_export(),
            FileRequest::ExportTimelapse => self.ask_for_timelapse(),
            FileRequest::SaveRecording => self.ask_where_to_record(),
            FileRequest::OpenReference(Some(path)) => {
                self.change_reference(ReferenceChange::Open(path));
            }
            FileRequest::OpenReference(None) => self.ask_for_reference(),
            FileRequest::CloseReference => self.change_reference(ReferenceChange::Close),
            FileRequest::SaveDrawing(drawn) => self.ask_where_to_draw(drawn, None),
            FileRequest::OpenDrawing(kind, picture) => self.ask_for_drawing(kind, &picture),
            FileRequest::OpenLamp => self.ask_for_lamp(),
            FileRequest::Swatches(change) => self.change_swatches(change),
            FileRequest::ImportSwatches => self.ask_for_swatches(),
            FileRequest::ExportSwatches(format) => self.ask_where_to_keep_swatches(format),
            FileRequest::Crop(rect) => self.request_snapshot(Purpose::Crop(rect)),
            FileRequest::New => self.ask_for_new(state),
            FileRequest::Sample => self.open_sample(),
            FileRequest::ImportBrushes => self.ask_for_brushes(),
            FileRequest::ExportBrushes => self.ask_where_to_export_brushes(),
            FileRequest::Preferences => self.dialogs.push(OpenDialog::Preferences),
        }
    }

    /// Ends the session when the window closes: waits for running jobs and writes the preferences.
    /// Autosaves of unsaved changes stay for the next start, unless you discarded them.
    pub fn finish(&mut self) {
        for job in std::mem::take(&mut self.jobs) {
            let saves = job.kind == JobKind::Saving;
            if let Some(finished) = job.finish().filter(|_| saves) {
                self.apply(finished);
            }
        }
        if self.preferences != self.written_preferences {
            let _ = self.preferences.write(&self.home.preferences());
        }
        self.finish_brush_sets();
        self.finish_swatches();
        self.scenes.end();
        let keeps = self.has_unsaved_changes() && !self.closing;
        let autosave = self.autosave.lock().ok().and_then(|mut autosave| autosave.take());
        if !keeps {
            if let Some(autosave) = autosave {
                autosave.end();
            }
            if let Some(lost) = self.recovered.take() {
                lost.discard();
            }
        }
    }
}

/// The kept mixtures: as you see them, and as they are in their file.
#[derive(Debug, Default)]
pub(super) struct SwatchList {
    /// Mixtures as you see them.
    pub(super) book: SwatchBook,
    /// Mixtures in the file; `None` until we have read it.
    pub(super) written: Option<SwatchBook>,
    /// Whether we have begun to read the file.
    pub(super) asked: bool,
    /// Imported colours that the panel has not taken yet.
    pub(super) colors: Option<SwatchFile>,
}

#[derive(Debug)]
pub(super) enum OpenDialog {
    /// Asks for a file.
    Browser(Box<Browser>, FilePurpose),
    /// Asks whether to save changes before the action.
    Unsaved(PendingAction),
    /// Asks whether to save drawings before the action.
    UnsavedDrawings(PendingAction),
    /// Asks whether to delete the revision in this file.
    DeleteRevision(PathBuf),
    /// Asks what to export.
    Export(Export),
    /// Asks what to export of the painting made from a scene.
    ExportOfScene(Export),
    /// Asks for the settings of a timelapse.
    Timelapse(TimelapseExport),
    New(Box<NewDialog>),
    Preferences,
}

#[derive(Debug)]
pub(super) enum FilePurpose {
    /// Opens the file that you choose.
    Open,
    /// Saves the painting, keeps a revision if `keep_revision` is set, then carries out `next`.
    Save { next: Option<PendingAction>, keep_revision: bool },
    /// Exports the painting to the file.
    Export(Export),
    /// Writes a timelapse to the file.
    Timelapse(TimelapseExport),
    /// Saves the recording in the file.
    Recording,
    /// Pins the picture of the file beside the canvas.
    Reference,
    /// Uses the picture of the file for the canvas of a new painting.
    Canvas(CanvasPicture),
    /// Lights the painting with the lamp of the file.
    Lamp,
    /// Saves the drawing in the file, then carries out `next`.
    SaveDrawing { drawing: Box<Drawing>, next: Option<PendingAction> },
    /// Reads a drawing from the file.
    OpenDrawing(DrawingKind),
    /// Imports the brushes of the file.
    ImportBrushes,
    /// Writes a set of brushes to the file.
    ExportBrushes(Box<BrushSet>),
    /// Adds the mixtures or colours of the file to the kept ones.
    ImportSwatches,
    /// Writes the kept mixtures to the file.
    ExportSwatches(SwatchFormat),
    /// Opens the file as a scene, or writes a file of a scene.
    Scene(ScenePurpose),
}
