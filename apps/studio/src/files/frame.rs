//! Entry points for the window: worker events, the update and drawing of each frame,
//! requests of menus and panels, and the end of the session.

use std::sync::Arc;

use eframe::egui::{Context, Ui, ViewportCommand};

use super::notice::StatusNote;
use super::open_dialog::OpenDialog;
use super::pending::{FileOrigin, PendingAction};
use super::reference_change::ReferenceChange;
use super::request::FileRequest;
use super::state::Files;
use super::work::{JobKind, Purpose};
use crate::language::tr;
use session::{Command, Event, PaintingState};

impl Files {
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

    /// The worker has opened a painting.
    fn opened(&mut self, state: &Arc<PaintingState>) {
        let FileOrigin { path, lost, start, sample, changed } =
            self.opening.take().unwrap_or_default();
        (self.sample, self.sample_settles) = (sample, false);
        self.epoch += 1;
        self.start = start;
        self.saved_revision = (!changed).then_some(state.revision);
        self.painting = Some(state.clone());
        self.autosaved_revision = None;
        (self.recorded, self.autosaved_desk) = (0, None);
        if let Some(path) = &path
            && lost.is_none()
        {
            self.preferences.remember(path);
        }
        self.path = path;
        if let Some(lost) = &lost {
            let desk = lost.meta.desk.clone();
            self.recovered_desk = desk.and_then(|desk| serde_json::from_value(desk).ok());
        }
        if lost.is_some() {
            // The painting is not saved yet. This makes an autosave due now; the lost
            // session is deleted once that is written.
            self.last_autosave = None;
            self.recovered = lost;
        } else if changed {
            // The autosaves of before stay until one holds the change.
            self.last_autosave = None;
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

    /// Whether the window may close now. If changes would be lost, the painter is asked,
    /// unless they are already being saved.
    fn may_close(&mut self) -> bool {
        if self.closing {
            return true;
        }
        let writes = self.jobs.iter().any(|job| job.kind == JobKind::Saving);
        // Asked for again while the worker has not even answered, the painter is asked instead.
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

    /// Closes the window if that was asked for while the painting was being saved.
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

    /// Ends the session when the window closes: waits for running jobs and writes the
    /// preferences. Autosaves of unsaved changes stay for the next start, unless the
    /// painter discarded them.
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
