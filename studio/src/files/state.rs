//! All about files, as the window sees it: what is asked for comes in, commands
//! to the worker come out, and the dialogs are shown.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use eframe::egui::{Context, ViewportCommand};

use super::asking::Dialog;
use super::home::Home;
use super::notices::Notice;
use super::preferences::Preferences;
use super::request::FileRequest;
use super::revision_list::RevisionList;
use super::work::{Purpose, Work};
use session::FileFailure;
use session::{Autosave, LostSession};
use session::{Command, Event, Pace, PaintingState};

/// What happens to the picture beside the canvas.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reference {
    /// This file is pinned there.
    Open(PathBuf),
    /// It is taken away.
    Close,
}

/// A painting that takes the place of the one there is.
#[derive(Debug)]
pub(super) struct Replacement {
    pub(super) commands: Vec<Command>,
    pub(super) opening: Opening,
}

/// What is known of a painting that the worker is taking up.
#[derive(Debug, Default)]
pub(super) struct Opening {
    /// Where it may be saved again.
    pub(super) path: Option<PathBuf>,
    /// The session that it was recovered from.
    pub(super) lost: Option<LostSession>,
    /// The file that it was read from.
    pub(super) start: Option<Arc<Vec<u8>>>,
}

/// What waits for a painting to be safe.
#[derive(Debug)]
pub(super) enum Then {
    /// The window closes.
    Close,
    /// Another painting is taken up.
    Replace(Replacement),
}

/// Everything about files.
#[derive(Debug)]
pub struct Files {
    pub(super) ctx: Context,
    pub(super) home: Home,
    /// What the painter prefers; changes are written by themselves.
    pub preferences: Preferences,
    pub(super) written: Preferences,
    /// How recordings are played, whatever the preferences say.
    pub pace: Option<Pace>,
    pub(super) easel: Option<Arc<PaintingState>>,
    pub(super) path: Option<PathBuf>,
    /// The file that it was read from, as it was then.
    pub(super) start: Option<Arc<Vec<u8>>>,
    /// The revision that stands in the file, or that was there at first.
    pub(super) saved: Option<u64>,
    /// Counts paintings taken up, so that what was begun for one is not taken for
    /// another's.
    pub(super) epoch: u64,
    pub(super) opening: Option<Opening>,
    pub(super) number: u64,
    pub(super) awaiting: Vec<(u64, Purpose)>,
    pub(super) works: Vec<Work>,
    pub(super) dialogs: Vec<Dialog>,
    pub(super) notices: Vec<Notice>,
    pub(super) lost: Vec<LostSession>,
    /// What was recovered, until it is safe again.
    pub(super) recovered: Option<LostSession>,
    pub(super) session: Arc<Mutex<Option<Autosave>>>,
    /// When the last autosave was asked for, and what it kept.
    pub(super) autosaved: (Instant, Option<u64>),
    /// Whether autosave failed, which is said once.
    pub(super) autosave_fails: bool,
    pub(super) replay: Option<(usize, usize)>,
    /// The revisions of the painting.
    pub revisions: RevisionList,
    pub(super) reference: Option<Reference>,
    pub(super) commands: Vec<Command>,
    /// Whether the painter agreed to close.
    pub(super) agreed: bool,
}

impl Files {
    /// Begins a session in `home`, and looks for lost ones. `ctx` is woken when
    /// work ends.
    #[must_use]
    pub fn new(ctx: &Context, home: Home, preferences: Preferences) -> Self {
        let mut notices = Vec::new();
        let lost = LostSession::all(&home.sessions());
        let session = Autosave::begin(&home.sessions());
        let mut failed = |failure: FileFailure| notices.push(Notice::failed(failure));
        let lost = lost.map_err(&mut failed).unwrap_or_default();
        let session = session.map_err(&mut failed).ok();
        Self {
            ctx: ctx.clone(),
            home,
            written: preferences.clone(),
            preferences,
            pace: None,
            easel: None,
            path: None,
            start: None,
            saved: None,
            epoch: 0,
            opening: None,
            number: 0,
            awaiting: Vec::new(),
            works: Vec::new(),
            dialogs: Vec::new(),
            notices,
            lost,
            recovered: None,
            session: Arc::new(Mutex::new(session)),
            autosaved: (Instant::now(), None),
            autosave_fails: false,
            replay: None,
            revisions: RevisionList::default(),
            reference: None,
            commands: Vec::new(),
            agreed: false,
        }
    }

    /// Says something that went wrong elsewhere, such as in the preferences.
    pub fn say(&mut self, failure: FileFailure) {
        self.notices.push(Notice::failed(failure));
    }

    /// The file of the painting, if it has one.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// What the painting is called: its file's name without the ending, else its
    /// title.
    #[must_use]
    pub fn title(&self) -> String {
        let stem = self.path.as_ref().and_then(|path| path.file_stem());
        let title = || self.easel.as_ref().map(|easel| easel.title.clone()).unwrap_or_default();
        let title = stem.map_or_else(title, |stem| stem.to_string_lossy().into_owned());
        if title.is_empty() { "untitled".to_owned() } else { title }
    }

    /// Whether there is something that is in no file.
    #[must_use]
    pub fn unsaved(&self) -> bool {
        let changed = |easel: &Arc<PaintingState>| {
            self.recovered.is_some() || easel.stroke_open || self.saved != Some(easel.revision)
        };
        self.easel.as_ref().is_some_and(changed)
    }

    /// Whether a dialog is open, which takes all keys.
    #[must_use]
    pub fn asks(&self) -> bool {
        !self.dialogs.is_empty()
    }

    /// What happens to the picture beside the canvas, once.
    pub fn take_reference(&mut self) -> Option<Reference> {
        self.reference.take()
    }

    /// Takes up what the worker told.
    pub fn event(&mut self, event: &Event) {
        match event {
            Event::Opened(easel) => self.opened(easel),
            Event::State(easel) => self.easel = Some(easel.clone()),
            Event::Snapshot(snapshot) => {
                if let Some(purpose) = self.awaited(snapshot.number) {
                    self.begin_with(purpose, snapshot);
                }
            }
            Event::Recording { number, script } => {
                if let Some(Purpose::Recording { path }) = self.awaited(*number) {
                    self.begin_recording(path, script.clone());
                }
            }
            Event::Progress { done, of } => self.replay = Some((*done, *of)),
            Event::Replayed => self.replay = None,
            Event::Message { failed: true, .. } => self.opening = None,
            _ => {}
        }
    }

    fn opened(&mut self, easel: &Arc<PaintingState>) {
        let Opening { path, lost, start } = self.opening.take().unwrap_or_default();
        self.epoch += 1;
        self.start = start;
        self.saved = Some(easel.revision);
        self.easel = Some(easel.clone());
        self.autosaved.1 = None;
        if let Some(path) = &path
            && lost.is_none()
        {
            self.preferences.remember(path);
        }
        self.path = path;
        if lost.is_some() {
            // It is in no file yet: kept anew at once, and only then let go.
            self.autosaved.0 = Instant::now() - Duration::from_secs(3600);
            self.recovered = lost;
        } else {
            self.clear_session();
        }
        self.list_revisions();
    }

    /// The purpose of an answer, once.
    fn awaited(&mut self, number: u64) -> Option<Purpose> {
        let at = self.awaiting.iter().position(|(own, _)| *own == number)?;
        Some(self.awaiting.remove(at).1)
    }

    /// To be called every frame, also when the window is hidden: takes up results,
    /// keeps autosaves, holds the window open where something would be lost. Gives
    /// what the worker is to do.
    pub fn update(&mut self, ctx: &Context) -> Vec<Command> {
        self.finish_works();
        self.autosave();
        self.write_preferences();
        if ctx.input(|input| input.viewport().close_requested()) && !self.may_close() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
        }
        std::mem::take(&mut self.commands)
    }

    /// Whether the window may close now; if not, what stands against it is done
    /// or asked first.
    fn may_close(&mut self) -> bool {
        if self.agreed || !self.unsaved() {
            return true;
        }
        let closes = |dialog: &Dialog| matches!(dialog, Dialog::Unsaved(Then::Close));
        if !self.dialogs.iter().any(closes) && !self.saves() {
            self.dialogs.push(Dialog::Unsaved(Then::Close));
        }
        false
    }

    /// Goes on with what waited, if nothing is lost by it now.
    pub(super) fn go_on(&mut self, then: Then) {
        if self.unsaved() {
            self.dialogs.push(Dialog::Unsaved(then));
        } else {
            self.carry_out(then);
        }
    }

    /// Goes on whatever is lost.
    pub(super) fn carry_out(&mut self, then: Then) {
        match then {
            Then::Close => {
                self.agreed = true;
                self.ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            Then::Replace(Replacement { commands, opening }) => {
                if let Some(lost) = self.recovered.take() {
                    lost.discard();
                }
                self.awaiting.clear();
                self.opening = Some(opening);
                self.commands.extend(commands);
            }
        }
    }

    /// Ends the session as the window closes: waits for what is being written.
    /// What is in no file stays for the next start, unless the painter agreed to
    /// lose it.
    pub fn finish(&mut self) {
        for work in std::mem::take(&mut self.works) {
            work.finish();
        }
        if self.preferences != self.written {
            let _ = self.preferences.write(&self.home.preferences());
        }
        let keeps = self.unsaved() && !self.agreed;
        let session = self.session.lock().ok().and_then(|mut session| session.take());
        if !keeps {
            if let Some(session) = session {
                session.end();
            }
            if let Some(lost) = self.recovered.take() {
                lost.discard();
            }
        }
    }

    /// Asks for something.
    pub fn request(&mut self, request: FileRequest, easel: &PaintingState) {
        match request {
            FileRequest::Open(Some(path)) => self.read(path),
            FileRequest::Open(None) => self.ask_for_file(),
            FileRequest::Save => match self.path.clone() {
                Some(path) => self.save(path, None),
                None => self.ask_where_to_save(None, false),
            },
            FileRequest::SaveAs => self.ask_where_to_save(None, false),
            FileRequest::KeepRevision => match self.path.clone() {
                Some(path) => self.keep_revision(path),
                None => self.ask_where_to_save(None, true),
            },
            FileRequest::OpenRevision(path) => self.read_revision(path),
            FileRequest::DeleteRevision(path) => self.dialogs.push(Dialog::Delete(path)),
            FileRequest::Export => self.ask_what_to_export(),
            FileRequest::SaveRecording => self.ask_where_to_record(),
            FileRequest::OpenReference(Some(path)) => self.reference = Some(Reference::Open(path)),
            FileRequest::OpenReference(None) => self.ask_for_reference(),
            FileRequest::CloseReference => self.reference = Some(Reference::Close),
            FileRequest::OpenLamp => self.ask_for_lamp(),
            FileRequest::New => self.ask_for_new(easel),
            FileRequest::Preferences => self.dialogs.push(Dialog::Preferences),
        }
    }
}
