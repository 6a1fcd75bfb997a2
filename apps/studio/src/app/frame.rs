//! One frame of the window: events, input, drawing and requests.

use web_time::{Duration, Instant};

use eframe::egui::{Context, Ui};

use super::help;
use super::key_rows::key_rows;
use super::side::Tab;
use super::studio::Studio;
use super::volumes::{WindowIntent, scene_key_rows};
use crate::files::{Problem, StatusNote};
use crate::floating;
use crate::keymap::{Keymap, Scope, install};
use crate::language::{speak, spoken, tr, tr_format};
use crate::panels::{FileRequest, Request};
use crate::pen::Device;
use crate::{pace, theme, view};
use session::Wait;

impl Studio {
    /// Lets the workers of a page, which have no threads, work until `deadline`. Returns how long they may
    /// wait for the next turn.
    pub fn turn(&self, deadline: Instant) -> Wait {
        let wait = self.worker.turn(deadline);
        match self.volumes.as_ref().map(|volumes| volumes.turn(deadline)) {
            None => wait,
            Some(other) => wait.min(other),
        }
    }

    /// Handles worker events and file tasks. Call before each frame, also while the
    /// window is hidden.
    pub fn logic(&mut self, context: &Context) {
        if self.pen.stylus_on().is_none() {
            pace::set_rare(context, None);
        }
        pace::begin_frame(context, Instant::now());
        speak(self.files.preferences.language);
        self.handle_events();
        if let Some(desk) = self.files.take_desk() {
            self.set_up(&desk, context);
        }
        self.files.note_desk(self.desk());
        self.files.note_drawings(self.panels.reference.unsaved_drawings());
        for command in self.files.update(context) {
            self.note_command(&command);
            self.worker.ask(command);
        }
        if let Some(StatusNote { text, hint }) = self.files.take_status() {
            match self.volumes.as_mut().filter(|_| self.shows_volumes) {
                Some(volumes) => volumes.say(text),
                None => self.show_message(text, hint, false),
            }
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
        if let Some(colors) = self.files.take_colors() {
            self.panels.eyedropper.set_swatches(&colors);
            self.panels.select(Tab::Color);
        }
        if let Some(volumes) = &mut self.volumes {
            volumes.handle_events(&mut self.files);
            volumes.autosave(&mut self.files);
        }
        self.pen.settings.clone_from(&self.files.preferences.pen);
        self.pen.options = self.files.preferences.options_of(&self.tools.brush);
        let eraser = self.brush_for(Device::Eraser);
        self.pen.eraser_options = self.files.preferences.options_of(&eraser);
        self.update_keys(context);
        self.apply_look(context);
        // Once it is settled, not at every step of a drag.
        if !context.input(|input| input.pointer.any_down()) {
            self.files.preferences.arrangement = self.panels.arrangement();
        }
    }

    /// Applies theme, touch targets and scale when they were changed, or the window's size.
    fn apply_look(&mut self, context: &Context) {
        let look = self.files.preferences.look();
        if self.look != look {
            self.look = look;
            theme::apply_look(context, look);
        }
        let now = context.zoom_factor();
        let size = context.content_rect().size() * now;
        let scale = theme::scale_in_window(self.files.preferences.interface_scale, size);
        if (now - scale).abs() > 1e-3 {
            context.set_zoom_factor(scale);
        }
    }

    /// Draws one frame. `busy` is the processing time of the previous frame including
    /// drawing, if known.
    pub fn ui(&mut self, ui: &mut Ui, busy: Option<Duration>) {
        let context = ui.ctx().clone();
        let now = Instant::now();
        speak(self.files.preferences.language);
        self.frames.begin(now, busy);
        floating::begin_frame(&context);
        self.handle_events();
        self.key_editor.read(&context, &self.keymap, &mut self.files.preferences.keys);
        if self.shows_volumes {
            self.draw_volumes(ui);
        } else {
            if !self.files.has_dialog() {
                for intent in self.keys.read(&context, self.tools.mode) {
                    self.perform(intent, &context);
                }
            }
            self.draw(ui);
            self.draw_pen_windows(&context);
            self.draw_aids_window(&context);
            self.show_quick_palette(&context);
            self.show_tour(&context);
        }
        let keymap = &self.keymap;
        let changes = &mut self.files.preferences.keys;
        help::show(&context, &mut self.visible.keys, &mut self.key_editor, keymap, changes);
        self.open_dropped(&context);
        self.files.show(ui);
        self.send_requests();
        self.update_title(&context);
        self.log_figures(&context, now);
        if let Some(rest) = self.message.as_ref().and_then(|message| message.rest(now)) {
            context.request_repaint_after(rest);
        }
        view::quicken(&context);
    }

    /// Uses the keys of the preferences if they or the language changed. New faults in them are told.
    fn update_keys(&mut self, context: &Context) {
        let changes = &self.files.preferences.keys;
        let made = (spoken(), changes);
        if self.keymap_changes.as_ref().is_some_and(|(spoken, used)| (*spoken, used) == made) {
            return;
        }
        let (keymap, faults) = Keymap::new(key_rows(), scene_key_rows(), changes);
        install(context, keymap.clone());
        (self.keymap, self.keymap_changes) = (keymap, Some((spoken(), changes.clone())));
        if faults != self.key_faults && !faults.is_empty() {
            let text = tr_format!("preferences, `keys`: {faults}", faults = faults.join("; "));
            self.files.report(Problem::new(text, tr("Help, Keys shows and changes all keys")));
        }
        self.key_faults = faults;
    }

    /// Shows or hides the table of keys of a workspace.
    pub(super) fn show_keys(&mut self, scope: Scope) {
        self.visible.keys ^= true;
        self.key_editor.scope = scope;
    }

    /// Draws the workspace of scenes.
    fn draw_volumes(&mut self, ui: &mut Ui) {
        let Some(volumes) = &mut self.volumes else { return };
        match volumes.show(ui, self.visible.panels, &mut self.pen, &mut self.files) {
            Some(WindowIntent::Easel) => self.shows_volumes = false,
            Some(WindowIntent::Panels) => self.visible.panels ^= true,
            Some(WindowIntent::Keys) => self.show_keys(Scope::Scenes),
            Some(WindowIntent::Preferences) => {
                self.requests.push(Request::File(FileRequest::Preferences));
            }
            None => {}
        }
    }

    /// Passes the queued requests on in order. File requests wait until a painting is
    /// open.
    pub(super) fn send_requests(&mut self) {
        for request in std::mem::take(&mut self.requests) {
            match (request, &self.painting) {
                (Request::Worker(command), _) => {
                    self.note_command(&command);
                    self.worker.ask(command);
                }
                (Request::File(request), Some(painting)) => self.files.request(request, painting),
                // No painting is open yet.
                (request, None) => self.requests.push(request),
            }
        }
    }
}
