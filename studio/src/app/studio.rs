//! The program's window.

use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{Context, Ui};
use render::paint::strokes::SurfaceId;

use super::cursor::Hovering;
use super::frames::Frames;
use super::help;
use super::keys::Keys;
use super::parts::{Begun, Parts};
use super::side::Panels;
use super::status::Message;
use super::surfaces::Hover;
use crate::files::{FiguresLog, Files, ReferenceChange};
use crate::panels::figures::FrameRate;
use crate::panels::{FileRequest, Request, Tools};
use crate::pen::Pen;
use crate::theme;
use crate::view::{Outline, SurfaceView};
use session::{Command, HeadOnCanvas, PaintingState, Performance, Worker};

/// The program's window: everything but the window system.
#[derive(Debug)]
pub struct Studio {
    /// What the painter has in hand.
    pub tools: Tools,
    /// The canvas in the window.
    pub canvas: SurfaceView,
    /// The palette in the window.
    pub palette: SurfaceView,
    /// What is shown.
    pub shown: Shown,
    /// What leads the brush.
    pub pen: Pen,
    /// The panels at the right, and the tubes.
    pub panels: Panels,
    /// All about files.
    pub files: Files,
    pub(super) worker: Worker,
    pub(super) easel: Option<Arc<PaintingState>>,
    pub(super) keys: Keys,
    pub(super) frames: Frames,
    pub(super) figures: Performance,
    pub(super) head: Option<Arc<HeadOnCanvas>>,
    pub(super) hover: Option<Hover>,
    pub(super) hovering: Option<Hovering>,
    pub(super) message: Option<Message>,
    pub(super) asked: Vec<Request>,
    pub(super) heard: u64,
    pub(super) answered: Option<u64>,
    /// Where the eyedropper last asked, so that it asks once.
    pub(super) asked_at: Option<(SurfaceId, u64, u64)>,
    pub(super) log: Option<FiguresLog>,
    pub(super) title: String,
}

/// What of the window is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shown {
    /// All panels.
    pub panels: bool,
    /// The palette and the tubes.
    pub palette: bool,
    /// The table of keys.
    pub keys: bool,
}

impl Studio {
    /// A window of these parts.
    #[must_use]
    pub fn new(context: &Context, parts: Parts) -> Self {
        let Parts { begun, pen, files, open, log } = parts;
        theme::apply(context);
        context.options_mut(|options| {
            // Ctrl and plus zoom the canvas, not the controls.
            options.zoom_with_keyboard = false;
        });
        context.set_zoom_factor(files.preferences.interface_scale);
        let Begun { worker, window } = begun;
        // One worker, one window: it was empty.
        let _ = window.set(context.clone());
        let kept = &files.preferences.tools;
        let tools = Tools {
            brush: kept.brush.clone(),
            vehicle: kept.vehicle,
            load_mm: kept.load_mm,
            squeeze_mm3: kept.squeeze_mm3,
            dry_share: kept.dry_share,
            ..Tools::default()
        };
        let open = open.map(|path| Request::File(FileRequest::Open(Some(path))));
        Self {
            tools,
            canvas: SurfaceView::new("Canvas", Outline::Rectangle, 22.0),
            palette: SurfaceView::new("Palette", Outline::Palette, 10.0),
            shown: Shown { panels: true, palette: true, keys: false },
            pen,
            panels: Panels::default(),
            files,
            worker,
            easel: None,
            keys: Keys::default(),
            frames: Frames::default(),
            figures: Performance::default(),
            head: None,
            hover: None,
            hovering: None,
            message: None,
            asked: open.into_iter().collect(),
            heard: 0,
            answered: None,
            asked_at: None,
            log,
            title: String::new(),
        }
    }

    /// What the worker last told of the painting.
    #[must_use]
    pub fn easel(&self) -> Option<&PaintingState> {
        self.easel.as_deref()
    }

    /// How the worker keeps up.
    #[must_use]
    pub fn figures(&self) -> Performance {
        self.figures
    }

    /// How the window keeps up.
    #[must_use]
    pub fn frame_rate(&self) -> FrameRate {
        self.frames.rate()
    }

    /// What was said to the painter last.
    #[must_use]
    pub fn message(&self) -> Option<&Message> {
        self.message.as_ref()
    }

    /// Events of the worker taken in so far.
    #[must_use]
    pub fn heard(&self) -> u64 {
        self.heard
    }

    /// The number of the recording that was answered last.
    #[must_use]
    pub fn answered(&self) -> Option<u64> {
        self.answered
    }

    /// Asks the worker for something, after all that panels have asked for.
    pub fn ask(&mut self, command: Command) {
        self.asked.push(Request::Worker(command));
    }

    /// What goes on also while the window is hidden: to be called before each frame.
    pub fn logic(&mut self, context: &Context) {
        self.listen();
        for command in self.files.update(context) {
            self.worker.ask(command);
        }
        match self.files.take_reference() {
            Some(ReferenceChange::Open(path)) => self.panels.reference.open(context, &path),
            Some(ReferenceChange::Close) => self.panels.reference.close(),
            None => {}
        }
        self.pen.settings = self.files.preferences.pen;
        let scale = self.files.preferences.interface_scale;
        if context.zoom_factor() != scale {
            context.set_zoom_factor(scale);
        }
    }

    /// One frame. `busy` is how long the one before took, drawing included, if that
    /// is known.
    pub fn ui(&mut self, ui: &mut Ui, busy: Option<Duration>) {
        let context = ui.ctx().clone();
        let now = Instant::now();
        self.frames.begin(now, busy);
        self.listen();
        if !self.files.has_dialog() {
            for intent in self.keys.read(&context, self.tools.mode) {
                self.act(intent, &context);
            }
        }
        self.layout(ui);
        help::show(&context, &mut self.shown.keys);
        self.dropped(&context);
        self.files.show(ui);
        self.carry_out();
        self.name_window(&context);
        self.measure(&context, now);
        if self.message.as_ref().is_some_and(|message| !message.failed) {
            context.request_repaint_after(Duration::from_secs(1));
        }
    }

    /// Hands on what was asked for, in order.
    fn carry_out(&mut self) {
        for request in std::mem::take(&mut self.asked) {
            match (request, &self.easel) {
                (Request::Worker(command), _) => self.worker.ask(command),
                (Request::File(request), Some(easel)) => self.files.request(request, easel),
                // Until there is a painting.
                (request, None) => self.asked.push(request),
            }
        }
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.worker.ask(Command::Quit);
    }
}
