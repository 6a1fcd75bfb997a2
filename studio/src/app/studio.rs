//! The program's window.

use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{CentralPanel, Context, Frame, Margin, Panel, Ui, ViewportCommand};

use super::frames::{FrameRate, Frames};
use super::keys::Keys;
use super::status::Message;
use super::surfaces::Hover;
use super::{help, menus, status, toolbar};
use crate::panels::{Request, Tools};
use crate::pen::Pen;
use crate::theme;
use crate::view::{Outline, SurfaceView};
use crate::worker::{Command, EaselState, Figures, HeadOnCanvas, Worker, WorkerOptions};

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
    pub(super) worker: Worker,
    pub(super) easel: Option<Arc<EaselState>>,
    pub(super) keys: Keys,
    pub(super) frames: Frames,
    pub(super) figures: Figures,
    pub(super) head: Option<Arc<HeadOnCanvas>>,
    pub(super) hover: Option<Hover>,
    pub(super) message: Option<Message>,
    pub(super) progress: Option<(usize, usize)>,
    pub(super) asked: Vec<Request>,
    pub(super) heard: u64,
    pub(super) answered: Option<u64>,
    title: String,
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
    /// A window on a worker of its own, which is asked for `begin` first, and on a
    /// pen.
    #[must_use]
    pub fn new(context: &Context, options: WorkerOptions, begin: Vec<Command>, pen: Pen) -> Self {
        theme::apply(context);
        context.options_mut(|options| {
            // Ctrl and plus zoom the canvas, not the controls.
            options.zoom_with_keyboard = false;
        });
        let wake = context.clone();
        let worker = Worker::start(options, move || wake.request_repaint());
        begin.into_iter().for_each(|command| worker.ask(command));
        Self {
            tools: Tools::default(),
            canvas: SurfaceView::new("Canvas", Outline::Sheet, 22.0),
            palette: SurfaceView::new("Palette", Outline::Palette, 10.0),
            shown: Shown { panels: true, palette: true, keys: false },
            pen,
            worker,
            easel: None,
            keys: Keys::default(),
            frames: Frames::default(),
            figures: Figures::default(),
            head: None,
            hover: None,
            message: None,
            progress: None,
            asked: Vec::new(),
            heard: 0,
            answered: None,
            title: String::new(),
        }
    }

    /// What the worker last told of the painting.
    #[must_use]
    pub fn easel(&self) -> Option<&EaselState> {
        self.easel.as_deref()
    }

    /// How the worker keeps up.
    #[must_use]
    pub fn figures(&self) -> Figures {
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

    /// One frame. `busy` is how long the one before took, drawing included, if that
    /// is known.
    pub fn ui(&mut self, ui: &mut Ui, busy: Option<Duration>) {
        let context = ui.ctx().clone();
        self.frames.begin(Instant::now(), busy);
        self.listen();
        for intent in self.keys.read(&context, self.tools.mode) {
            self.act(intent, &context);
        }
        self.panels(ui);
        help::show(&context, &mut self.shown.keys);
        self.carry_out();
        self.name_window(&context);
        if self.message.as_ref().is_some_and(|message| !message.failed) {
            context.request_repaint_after(Duration::from_secs(1));
        }
    }

    /// The window from its edges inwards.
    fn panels(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        let bar = Frame::new().fill(theme::BAR).inner_margin(Margin::symmetric(6, 2));
        let easel = self.easel.clone();
        let history = easel
            .as_ref()
            .map_or((false, false), |easel| (easel.done > 0, easel.done < easel.history.len()));
        let mirror = self.canvas.view.mirror;
        let mut asked = None;
        if self.shown.panels {
            let shown = (self.shown.panels, self.shown.palette, self.tools.figures);
            let state = menus::State { open: easel.is_some(), history, shown, mirror };
            let title = self.title.clone();
            Panel::top("menus").frame(bar).show_separator_line(false).show(ui, |ui| {
                asked = menus::show(ui, state, &title);
            });
            Panel::bottom("line")
                .frame(bar)
                .exact_size(24.0)
                .show_separator_line(false)
                .show(ui, |ui| self.line(ui));
            let column = bar.inner_margin(Margin::symmetric(4, 6));
            Panel::left("tools")
                .frame(column)
                .resizable(false)
                .exact_size(42.0)
                .show_separator_line(false)
                .show(ui, |ui| {
                    let mode = self.keys.mode(self.tools.mode);
                    let state = toolbar::State { mode, mirror, history };
                    asked = asked.or(toolbar::show(ui, state));
                });
        }
        if let Some(intent) = asked {
            self.act(intent, &context);
        }
        CentralPanel::no_frame().show(ui, |ui| self.surfaces(ui));
    }

    /// The line below.
    fn line(&mut self, ui: &mut Ui) {
        let now = Instant::now();
        let Some(easel) = self.easel.clone() else {
            ui.weak("taking up the canvas");
            return;
        };
        let (width, height) = easel.canvas_cells;
        let mm = |cells: usize| cells as f64 * easel.cell_mm;
        let view = self.canvas.view;
        let turn = (view.caught_turn().to_degrees().round() as i64).rem_euclid(360);
        let turn = if turn == 0 { String::new() } else { format!(", {turn} degrees") };
        let mirrored = if view.mirror { ", mirrored" } else { "" };
        let second = easel.second.as_ref().map(|second| format!(" | {}", second.illuminant));
        let light = &easel.lighting;
        let state = status::State {
            message: self.message.as_ref().filter(|message| message.stays(now)),
            progress: self.progress,
            view: format!("{:.0} %{turn}{mirrored}", view.zoom * 100.0),
            size: format!("{width} x {height}, {:.0} x {:.0} mm", mm(width), mm(height)),
            light: format!("{}{}", light.illuminant, second.unwrap_or_default()),
            backend: &easel.backend,
        };
        match status::show(ui, &state) {
            Some(status::Clicked::PutAway) => self.message = None,
            Some(status::Clicked::Cancel) => self.ask(Command::Cancel),
            None => {}
        }
    }

    /// Hands on what was asked for, in order.
    fn carry_out(&mut self) {
        for request in std::mem::take(&mut self.asked) {
            match request {
                Request::Worker(command) => self.worker.ask(command),
                Request::File(request) => {
                    self.say(format!("asked for {request:?}"), None, true);
                }
            }
        }
    }

    fn name_window(&mut self, context: &Context) {
        let title = self.easel.as_ref().map_or("", |easel| easel.title.as_str());
        if self.title != title {
            self.title = title.to_owned();
            context.send_viewport_cmd(ViewportCommand::Title(format!("{title} - impasto")));
        }
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.worker.ask(Command::Quit);
    }
}
