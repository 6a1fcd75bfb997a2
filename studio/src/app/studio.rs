//! The program's window.

use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{
    Align2, CentralPanel, Color32, Context, FontId, Frame, Id, LayerId, Margin, Order, Panel, Rect,
    Ui, ViewportCommand,
};

use render::paint::strokes::Surface;

use super::cursor::Hovering;
use super::frames::Frames;
use super::keys::Keys;
use super::parts::{Begun, Parts};
use super::side::{Panels, Tab};
use super::status::Message;
use super::surfaces::Hover;
use super::{help, menus, status, toolbar};
use crate::files::{FiguresLog, Files, FrameFigures, Reference as Pinned};
use crate::panels::eyedropper::Eyedropper;
use crate::panels::figures::FrameRate;
use crate::panels::{Desk, FileRequest, Request, Tools};
use crate::pen::Pen;
use crate::theme;
use crate::view::{Outline, SurfaceView};
use crate::worker::{Command, EaselState, Figures, HeadOnCanvas, Worker};

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
    pub(super) easel: Option<Arc<EaselState>>,
    pub(super) keys: Keys,
    pub(super) frames: Frames,
    pub(super) figures: Figures,
    pub(super) head: Option<Arc<HeadOnCanvas>>,
    pub(super) hover: Option<Hover>,
    pub(super) hovering: Option<Hovering>,
    pub(super) message: Option<Message>,
    pub(super) asked: Vec<Request>,
    pub(super) heard: u64,
    pub(super) answered: Option<u64>,
    /// Where the eyedropper last asked, so that it asks once.
    pub(super) asked_at: Option<(Surface, u64, u64)>,
    log: Option<FiguresLog>,
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
            canvas: SurfaceView::new("Canvas", Outline::Sheet, 22.0),
            palette: SurfaceView::new("Palette", Outline::Palette, 10.0),
            shown: Shown { panels: true, palette: true, keys: false },
            pen,
            panels: Panels::default(),
            files,
            worker,
            easel: None,
            keys: Keys::default(),
            frames: Frames::default(),
            figures: Figures::default(),
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

    /// What goes on also while the window is hidden: to be called before each frame.
    pub fn logic(&mut self, context: &Context) {
        self.listen();
        for command in self.files.update(context) {
            self.worker.ask(command);
        }
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
        if !self.files.asks() {
            for intent in self.keys.read(&context, self.tools.mode) {
                self.act(intent, &context);
            }
        }
        let wanted = self.tools.wanted;
        self.layout(ui);
        if self.tools.wanted != wanted {
            self.panels.bring(Tab::Colour);
        }
        help::show(&context, &mut self.shown.keys);
        self.dropped(&context);
        self.files.show(ui);
        match self.files.take_reference() {
            Some(Pinned::Open(path)) => self.panels.reference.open(&context, &path),
            Some(Pinned::Close) => self.panels.reference.close(),
            None => {}
        }
        self.carry_out();
        self.name_window(&context);
        self.measure(&context, now);
        if self.message.as_ref().is_some_and(|message| !message.failed) {
            context.request_repaint_after(Duration::from_secs(1));
        }
    }

    /// The window closes: what is being written is waited for, and what the painter
    /// had in hand is kept.
    pub fn finish(&mut self) {
        let kept = &mut self.files.preferences.tools;
        kept.brush.clone_from(&self.tools.brush);
        kept.vehicle = self.tools.vehicle;
        kept.load_mm = self.tools.load_mm;
        kept.squeeze_mm3 = self.tools.squeeze_mm3;
        kept.dry_share = self.tools.dry_share;
        self.files.finish();
        self.worker.ask(Command::Quit);
    }

    /// The window from its edges inwards.
    fn layout(&mut self, ui: &mut Ui) {
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
            let side = Frame::new().fill(theme::PANEL).inner_margin(Margin::symmetric(8, 6));
            Panel::right("side")
                .frame(side)
                .resizable(false)
                .exact_size(theme::PANEL_WIDTH)
                .show_separator_line(false)
                .show(ui, |ui| {
                    let Some(easel) = &easel else { return };
                    let asked = &mut self.asked;
                    let mut desk = Desk { easel, tools: &mut self.tools, asked };
                    self.panels.show(ui, &mut desk, &self.files);
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
            view: format!("{:.0} %{turn}{mirrored}", view.zoom * 100.0),
            size: format!("{width} x {height}, {:.0} x {:.0} mm", mm(width), mm(height)),
            light: format!("{}{}", light.illuminant, second.unwrap_or_default()),
            backend: &easel.backend,
        };
        if status::show(ui, &state) {
            self.message = None;
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

    /// Files dropped on the window are opened.
    fn dropped(&mut self, context: &Context) {
        let (dropped, hovering) = context.input(|input| {
            let paths = input.raw.dropped_files.iter().map(|file| file.path().to_owned());
            (paths.collect::<Vec<_>>(), !input.raw.hovered_files.is_empty())
        });
        for path in dropped {
            if Eyedropper::takes(&path) {
                self.panels.eyedropper.open_swatches(&path);
                self.panels.bring(Tab::Colour);
                continue;
            }
            self.asked.push(Request::File(FileRequest::Open(Some(path))));
        }
        if hovering {
            let layer = LayerId::new(Order::Foreground, Id::unique("dropping"));
            let (painter, whole) = (context.layer_painter(layer), context.content_rect());
            painter.rect_filled(whole, 0.0, Color32::from_black_alpha(150));
            let (font, text) = (FontId::proportional(18.0), "Drop to open");
            painter.text(whole.center(), Align2::CENTER_CENTER, text, font, theme::STRONG);
        }
    }

    fn name_window(&mut self, context: &Context) {
        let mark = if self.files.unsaved() { "*" } else { "" };
        let title = format!("{}{mark}", self.files.title());
        if self.title != title {
            context.send_viewport_cmd(ViewportCommand::Title(format!("{title} - impasto")));
            self.title = title;
        }
    }

    /// Tells the log how window and worker keep up.
    fn measure(&mut self, context: &Context, now: Instant) {
        let Some(log) = &mut self.log else { return };
        let rate = self.frames.rate();
        let (width, height) = self.canvas.cells();
        let placement = self.canvas.placement();
        let corners = [[0, 0], [width, 0], [0, height], [width, height]];
        let sheet = corners.map(|corner| placement.point(corner.map(|cells| cells as f64)));
        let sheet = Rect::from_points(&sheet) * context.pixels_per_point();
        let frames = FrameFigures {
            frames_a_second: rate.frames_a_second,
            latency_ms: rate.latency_ms,
            worst_latency_ms: rate.worst_ms,
            canvas_px: [sheet.left(), sheet.top(), sheet.right(), sheet.bottom()],
        };
        log.tell(now, &frames, &self.figures);
        context.request_repaint_after(Duration::from_secs(1));
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.worker.ask(Command::Quit);
    }
}
