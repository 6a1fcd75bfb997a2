//! The studio as an application of eframe.

use std::path::PathBuf;

use documents::file::disk;
use eframe::egui::{Context, RawInput, Ui, Visuals};
use eframe::{App, CreationContext, Frame, WebOptions};
use js_sys::Function;
use session::{WorkerOptions, initial_commands};
use studio::app::{Between, Parts, StartedWorker, Studio};
use studio::files::{Files, Home, Preferences, Problem};
use studio::pen::{Pen, PenSettings};
use studio::theme::ThemeChoice;
use studio::view::Drawing;
use wasm_bindgen::JsValue;
use web_time::{Duration, Instant};

use crate::page_fonts::page_fonts;

/// Most memory for undo, in bytes: 192 MiB. A page has 4 GiB in all and cannot give any back.
const MOST_UNDO_BYTES: u64 = 192 << 20;

/// After a stroke of this length, other work no longer waits for its end. Together with the time
/// between two autosaves, you lose at most 20 s of painting.
const LONG_STROKE: Duration = Duration::from_secs(7);

/// The studio, and what the page reports to it between frames.
pub(crate) struct Framed {
    pub(crate) studio: Studio,
    context: Context,
    /// When the pen was set down. It is `None` while the pen is lifted.
    down_since: Option<Instant>,
    frame_done: Function,
    /// Number of pictures that were shown: frames, and parts of the canvas between frames.
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
        // The browser gets the keys that the studio does not use.
        should_stop_propagation: Box::new(|_| true),
        #[cfg(not(feature = "webgpu"))]
        webgl_context_option: eframe::WebGlContextOption::WebGl2,
        ..WebOptions::default()
    }
}

/// Sets how the window is drawn, and returns the name of the graphics interface.
#[cfg(feature = "webgpu")]
fn graphics(creation: &CreationContext<'_>) -> String {
    let Some(drawn) = &creation.wgpu_render_state else { return "none".to_owned() };
    let context = &creation.egui_ctx;
    studio::view::set_drawing(context, Drawing::OwnShader(drawn.target_format));
    let info = drawn.adapter.get_info();
    if studio::view::is_processor(&drawn.adapter) {
        studio::view::draw_meshes(context);
    }
    format!("{:?}: {}", info.backend, info.name)
}

/// Sets how the window is drawn, and returns the name of the graphics interface.
#[cfg(not(feature = "webgpu"))]
fn graphics(creation: &CreationContext<'_>) -> String {
    studio::view::set_drawing(&creation.egui_ctx, Drawing::Egui);
    "WebGL 2".to_owned()
}

impl Framed {
    pub(crate) fn new(creation: &CreationContext<'_>, frame_done: Function, fingers: bool) -> Self {
        let context = creation.egui_ctx.clone();
        context.set_fonts(page_fonts());
        let graphics = graphics(creation);
        let home = Home::for_platform();
        let home = home.unwrap_or_else(|| Home::in_folder(std::path::Path::new("/data")));
        let (mut preferences, problems) = Preferences::read(&home.preferences());
        if !disk::exists(&home.preferences()) {
            preferences.theme = ThemeChoice::System;
            preferences.touch_targets = fingers;
            // You close a page more easily than a window, and without a question.
            preferences.autosave_seconds = 12;
        }
        let undo_bytes = (preferences.undo_mib << 20).min(MOST_UNDO_BYTES);
        let options = WorkerOptions { undo_bytes, ..WorkerOptions::default() };
        let worker = StartedWorker::new(options, initial_commands());
        let mut files = Files::new(&context, home, preferences);
        problems.into_iter().for_each(|problem| files.report(problem));
        let pen = Pen::new(PenSettings::default());
        let studio = Studio::new(&context, Parts { worker, pen, files, open: None, log: None });
        Self {
            studio,
            context,
            down_since: None,
            frame_done,
            frames: 0,
            opened: Vec::new(),
            graphics,
        }
    }

    /// Points of the interface per CSS pixel.
    pub(crate) fn zoom(&self) -> f32 {
        self.context.zoom_factor()
    }

    /// Asks for a frame.
    pub(crate) fn wake(&self) {
        self.context.request_repaint();
    }

    /// Passes on the reports of the stylus if its stroke can be shown between frames. Returns whether it
    /// can.
    pub(crate) fn take_stylus(&mut self) -> bool {
        self.studio.take_stylus(&self.context)
    }

    /// Pixels that a stroke changed since the last frame, and the physical pixels per point. Returns
    /// `None` if you see the stroke only in frames.
    pub(crate) fn between(&mut self) -> Option<(Between, f32)> {
        let between = self.studio.between(&self.context)?;
        if between.patch.width > 0 {
            self.frames += 1;
        }
        Some((between, self.context.pixels_per_point()))
    }

    /// Whether the pen is down, but not for long. Other work would delay the stroke, so it waits
    /// meanwhile, e.g. writing an autosave.
    pub(crate) fn is_in_stroke(&mut self, now: Instant) -> bool {
        let since = self.studio.pen.is_down().then(|| self.down_since.unwrap_or(now));
        self.down_since = since;
        since.is_some_and(|since| now < since + LONG_STROKE)
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
        let busy = frame.info().cpu_usage.map(Duration::from_secs_f32);
        self.studio.ui(ui, busy);
        self.frames += 1;
        // The page gives the worker a turn, and the worker has the commands of this frame now.
        let _ = self.frame_done.call0(&JsValue::NULL);
    }

    fn raw_input_hook(&mut self, context: &Context, input: &mut RawInput) {
        // The page reads dropped files and opens them with `Page::open`.
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
