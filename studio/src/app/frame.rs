//! One frame of the window: events, input, drawing and requests.

use std::time::{Duration, Instant};

use eframe::egui::{Context, Ui};

use super::help;
use super::studio::Studio;
use super::volumes::WindowIntent;
use crate::panels::Request;

impl Studio {
    /// Handles worker events and file tasks. Call before each frame, also while the
    /// window is hidden.
    pub fn logic(&mut self, context: &Context) {
        self.handle_events();
        self.files.note_drawings(self.panels.reference.unsaved_drawings());
        for command in self.files.update(context) {
            self.worker.ask(command);
        }
        while let Some(change) = self.files.take_reference() {
            if let Some(problem) = self.panels.reference.apply(change, context) {
                self.files.report(problem);
            }
        }
        while let Some(answer) = self.files.take_scene_answer() {
            // Exports are answered where they were asked for.
            self.show_volumes(context);
            if let Some(volumes) = &mut self.volumes {
                volumes.answer(answer, &mut self.files);
            }
        }
        if let Some(volumes) = &mut self.volumes {
            volumes.handle_events(&mut self.files);
            volumes.autosave(&mut self.files);
        }
        self.pen.settings = self.files.preferences.pen;
        let scale = self.files.preferences.interface_scale;
        if context.zoom_factor() != scale {
            context.set_zoom_factor(scale);
        }
    }

    /// Draws one frame. `busy` is the processing time of the previous frame including
    /// drawing, if known.
    pub fn ui(&mut self, ui: &mut Ui, busy: Option<Duration>) {
        let context = ui.ctx().clone();
        let now = Instant::now();
        self.frames.begin(now, busy);
        self.handle_events();
        if self.shows_volumes {
            self.draw_volumes(ui);
        } else {
            if !self.files.has_dialog() {
                for intent in self.keys.read(&context, self.tools.mode) {
                    self.perform(intent, &context);
                }
            }
            self.draw(ui);
            help::show(&context, &mut self.visible.keys);
        }
        self.open_dropped(&context);
        self.files.show(ui);
        self.send_requests();
        self.update_title(&context);
        self.log_figures(&context, now);
        if self.message.as_ref().is_some_and(|message| !message.failed) {
            context.request_repaint_after(Duration::from_secs(1));
        }
    }

    /// Draws the workspace of scenes.
    fn draw_volumes(&mut self, ui: &mut Ui) {
        let Some(volumes) = &mut self.volumes else { return };
        match volumes.show(ui, self.visible.panels, &mut self.pen, &mut self.files) {
            Some(WindowIntent::Easel) => self.shows_volumes = false,
            Some(WindowIntent::Panels) => self.visible.panels ^= true,
            None => {}
        }
    }

    /// Passes the queued requests on in order. File requests wait until a painting is
    /// open.
    fn send_requests(&mut self) {
        for request in std::mem::take(&mut self.requests) {
            match (request, &self.painting) {
                (Request::Worker(command), _) => self.worker.ask(command),
                (Request::File(request), Some(painting)) => self.files.request(request, painting),
                // No painting is open yet.
                (request, None) => self.requests.push(request),
            }
        }
    }
}
