//! The studio as an application of eframe.

use std::path::PathBuf;

use eframe::egui::{Context, RawInput, Ui, Visuals};
use eframe::{App, CreationContext, Frame, WebOptions};
use js_sys::Function;
use session::{WorkerOptions, initial_commands};
use spectra::file::disk;
use studio::app::{Parts, StartedWorker, Studio};
use studio::files::{Files, Home, Preferences, Problem};
use studio::pen::{Pen, PenSettings};
use studio::theme::ThemeChoice;
use wasm_bindgen::JsValue;

use crate::page_fonts::page_fonts;

/// Most memory for undo, in bytes: 192 MiB. A page has 4 GiB in all and cannot give any back.
const MOST_UNDO_BYTES: u64 = 192 << 20;

/// The studio, and what the page tells it between frames.
pub(crate) struct Framed {
    pub(crate) studio: Studio,
    context: Context,
    frame_done: Function,
    /// Frames that were drawn.
    pub(crate) frames: u64,
    /// Files to open in the next frame.
    opened: Vec<PathBuf>,
    /// Graphics interface that draws.
    pub(crate) graphics: String,
}

/// Settings of eframe for the page.
pub(crate) fn options() -> WebOptions {
    WebOptions {
        // Dithering would change the colour of cells.
        dithering: false,
        // Keys of the browser that the studio does not use stay the browser's.
        should_stop_propagation: Box::new(|_| true),
        ..WebOptions::default()
    }
}

impl Framed {
    pub(crate) fn new(creation: &CreationContext<'_>, frame_done: Function) -> Self {
        let context = creation.egui_ctx.clone();
        context.set_fonts(page_fonts());
        let mut graphics = "none".to_owned();
        if let Some(drawn) = &creation.wgpu_render_state {
            studio::view::set_format(&context, drawn.target_format);
            let info = drawn.adapter.get_info();
            graphics = format!("{:?}: {}", info.backend, info.name);
        }
        let home = Home::for_platform();
        let home = home.unwrap_or_else(|| Home::in_folder(std::path::Path::new("/data")));
        let (mut preferences, problems) = Preferences::read(&home.preferences());
        if !disk::exists(&home.preferences()) {
            preferences.theme = ThemeChoice::System;
            // A page is closed without a question more easily than a window.
            preferences.autosave_seconds = 12;
        }
        let undo_bytes = (preferences.undo_mib << 20).min(MOST_UNDO_BYTES);
        let options = WorkerOptions { undo_bytes, ..WorkerOptions::default() };
        let worker = StartedWorker::new(options, initial_commands());
        let mut files = Files::new(&context, home, preferences);
        problems.into_iter().for_each(|problem| files.report(problem));
        let pen = Pen::new(PenSettings::default());
        let studio = Studio::new(&context, Parts { worker, pen, files, open: None, log: None });
        Self { studio, context, frame_done, frames: 0, opened: Vec::new(), graphics }
    }

    /// Points of the interface per CSS pixel.
    pub(crate) fn zoom(&self) -> f32 {
        self.context.zoom_factor()
    }

    /// Asks for a frame.
    pub(crate) fn wake(&self) {
        self.context.request_repaint();
    }

    /// Opens a file in the next frame.
    pub(crate) fn open(&mut self, path: PathBuf) {
        self.opened.push(path);
        self.wake();
    }

    /// Shows a problem.
    pub(crate) fn report(&mut self, problem: Problem) {
        self.studio.files.report(problem);
        self.wake();
    }
}

impl App for Framed {
    fn logic(&mut self, context: &Context, _: &mut Frame) {
        for path in std::mem::take(&mut self.opened) {
            if !self.studio.files.choose(&path) {
                self.studio.open_path(context, path);
            }
        }
        self.studio.logic(context);
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut Frame) {
        let busy = frame.info().cpu_usage.map(std::time::Duration::from_secs_f32);
        self.studio.ui(ui, busy);
        self.frames += 1;
        // The page asks for a turn of the worker, which has the commands of this frame now.
        let _ = self.frame_done.call0(&JsValue::NULL);
    }

    fn raw_input_hook(&mut self, context: &Context, input: &mut RawInput) {
        // The page reads dropped files and opens them by `Page::open`.
        input.dropped_files.clear();
        self.studio.raw_input(context, input);
    }

    fn clear_color(&self, _: &Visuals) -> [f32; 4] {
        studio::theme::SURROUND.to_normalized_gamma_f32()
    }

    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }
}
