//! Entry points for the window: worker events, the update and drawing of each frame,
//! requests of menus and panels, and the end of the session.

use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{Context, Ui, ViewportCommand};

use super::open_dialog::OpenDialog;
use super::pending::{FileOrigin, PendingAction};
use super::reference_change::ReferenceChange;
use super::request::FileRequest;
use super::state::Files;
use super::work::Purpose;
use session::{Command, Event, PaintingState};

impl Files {
    /// Handles an event of the worker.
    pub fn handle_event(&mut self, event: &Event) {
        match event {
            Event::Opened(state) => self.opened(state),
            Event::State(state) => self.painting = Some(state.clone()),
            Event::Snapshot(snapshot) => {
                if let Some(purpose) = self.take_purpose(snapshot.number) {
                    self.start_with_snapshot(purpose, snapshot);
                }
            }
            Event::Recording { number, script } => {
                if let Some(Purpose::Recording { path }) = self.take_purpose(*number) {
                    self.start_recording(path, script.clone());
                }
            }
            Event::Progress { done, of } => self.replay = Some((*done, *of)),
            Event::Replayed => self.replay = None,
            Event::Message { failed: true, .. } => self.opening = None,
            _ => {}
        }
    }

    /// The worker has opened a painting.
    fn opened(&mut self, state: &Arc<PaintingState>) {
        let FileOrigin { path, lost, start } = self.opening.take().unwrap_or_default();
        self.epoch += 1;
        self.start = start;
        self.saved_revision = Some(state.revision);
        self.painting = Some(state.clone());
        self.autosaved_revision = None;
        if let Some(path) = &path
            && lost.is_none()
        {
            self.preferences.remember(path);
        }
        self.path = path;
        if lost.is_some() {
            // The painting is not saved yet. This makes an autosave due now; the lost
            // session is deleted once that is written.
            self.last_autosave = Instant::now() - Duration::from_secs(3600);
            self.recovered = lost;
        } else {
            self.clear_autosaves();
        }
        self.list_revisions();
    }

    /// Applies results of jobs, starts autosaves, and keeps the window open while changes
    /// would be lost. Returns commands for the worker. To be called every frame, also
    /// while the window is hidden.
    pub fn update(&mut self, ctx: &Context) -> Vec<Command> {
        self.collect_results();
        self.autosave_when_due();
        self.write_changed_preferences();
        if ctx.input(|input| input.viewport().close_requested()) && !self.may_close() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
        }
        std::mem::take(&mut self.commands)
    }

    /// Whether the window may close now. If changes would be lost, the painter is asked,
    /// unless they are already being saved.
    fn may_close(&mut self) -> bool {
        let nothing_lost = !self.has_unsaved_changes() && self.unsaved_drawings.is_empty();
        if self.closing || nothing_lost {
            return true;
        }
        let asks = |dialog: &OpenDialog| match dialog {
            OpenDialog::Unsaved(action) | OpenDialog::UnsavedDrawings(action) => {
                matches!(action, PendingAction::Close { .. })
            }
            _ => false,
        };
        if !self.dialogs.iter().any(asks) && !self.is_saving() {
            self.carry_out_safely(PendingAction::Close { drawings_given_up: false });
        }
        false
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
            FileRequest::SaveRecording => self.ask_where_to_record(),
            FileRequest::OpenReference(Some(path)) => {
                self.change_reference(ReferenceChange::Open(path));
            }
            FileRequest::OpenReference(None) => self.ask_for_reference(),
            FileRequest::CloseReference => self.change_reference(ReferenceChange::Close),
            FileRequest::SaveDrawing(drawn) => self.ask_where_to_draw(drawn, None),
            FileRequest::OpenDrawing(kind, picture) => self.ask_for_drawing(kind, &picture),
            FileRequest::OpenLamp => self.ask_for_lamp(),
            FileRequest::New => self.ask_for_new(state),
            FileRequest::Preferences => self.dialogs.push(OpenDialog::Preferences),
        }
    }

    /// Ends the session when the window closes: waits for running jobs and writes the
    /// preferences. Autosaves of unsaved changes stay for the next start, unless the
    /// painter discarded them.
    pub fn finish(&mut self) {
        for job in std::mem::take(&mut self.jobs) {
            job.finish();
        }
        if self.preferences != self.written_preferences {
            let _ = self.preferences.write(&self.home.preferences());
        }
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
