//! State of the studio window, and one frame of it: input, events of the worker, layout, drawing
//! and requests.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use eframe::egui::{CentralPanel, Context, Frame, Margin, Panel, Rect, Ui};
use paint::strokes::{StrokeScript, SurfaceId};
use session::volumes::Subject;
use session::{
    Command, Event, HeadOnCanvas, PaintingState, Performance, Wait, Worker, WorkerOptions,
};
use web_time::{Duration, Instant};

use super::bars::Message;
use super::crop::CropTool;
use super::dock::Drawn;
use super::entries::key_rows;
use super::frames::Frames;
use super::guide::Tour;
use super::hover::{Dashes, Hover, HoveringHead, TwinStrokes};
use super::keys::{KeyEditor, Keys};
use super::quick::QuickPalette;
use super::side::{Panels, Tab};
use super::volumes::{Volumes, WindowIntent, scene_key_rows};
use super::{bars, keys};
use crate::arrangement::Side;
use crate::files::{
    CanvasView, FiguresLog, Files, PinnedReference, Problem, ReferenceChange, StatusNote,
    WindowSetup,
};
use crate::keymap::{Changes, Keymap, Scope, install};
use crate::language::{Language, speak, spoken, tr, tr_format};
use crate::panels::own_brushes::OwnBrushes;
use crate::panels::pen::PenWindow;
use crate::panels::{FileRequest, Mode, PanelContext, Request, Tools};
use crate::pen::{Device, DrawingAids, Pen};
use crate::view::{Outline, SurfaceView, ViewState, fill_rect};
use crate::{floating, pace, theme, view};

/// The studio window. It does not depend on the window system, so you can test it without one.
#[derive(Debug)]
pub struct Studio {
    /// Selected tool, brush and tool settings.
    pub tools: Tools,
    /// View of the canvas.
    pub canvas: SurfaceView,
    /// View of the palette.
    pub palette: SurfaceView,
    /// Visible parts of the window.
    pub visible: VisibleParts,
    /// Input of pen, mouse and touch.
    pub pen: Pen,
    /// Ruler, perspective and symmetry over the canvas.
    pub aids: DrawingAids,
    /// Panels at the right and beside the palette.
    pub panels: Panels,
    /// File dialogs, tasks and preferences.
    pub files: Files,
    /// The crop that you are framing.
    pub crop: Option<CropTool>,
    /// The workspace of scenes, once the first scene was opened.
    pub volumes: Option<Volumes>,
    /// Whether the workspace of scenes is shown instead of the easel.
    pub shows_volumes: bool,
    pub(super) worker: Worker,
    pub(super) painting: Option<Arc<PaintingState>>,
    pub(super) keys: Keys,
    pub(super) keymap: Keymap,
    /// Language and changes of keys for which we made `keymap`; `None` before the first frame.
    pub(super) keymap_changes: Option<(Language, Changes)>,
    /// Faults in the key changes that we have already reported.
    pub(super) key_faults: Vec<String>,
    pub(super) key_editor: KeyEditor,
    pub(super) pen_window: PenWindow,
    pub(super) own_brushes: OwnBrushes,
    pub(super) frames: Frames,
    pub(super) figures: Performance,
    pub(super) head: Option<Arc<HeadOnCanvas>>,
    pub(super) head_rect: Option<Rect>,
    pub(super) hover: Option<Hover>,
    pub(super) hovering: Option<HoveringHead>,
    pub(super) quick: Option<QuickPalette>,
    pub(super) message: Option<Message>,
    pub(super) requests: Vec<Request>,
    pub(super) event_count: u64,
    pub(super) last_recording: Option<(u64, Arc<StrokeScript>)>,
    /// The last pick request: surface, and x and y in mm as the bits of an `f64`. We do not send a
    /// request for the same place again.
    pub(super) last_pick: Option<(SurfaceId, u64, u64)>,
    pub(super) mask_points: Vec<[f64; 2]>,
    pub(super) mask_dashes: Dashes,
    /// Where the handles of the drawing aids were drawn.
    pub(super) aid_handles: Vec<Rect>,
    pub(super) aid_grabbed: [f64; 2],
    pub(super) twins: Option<TwinStrokes>,
    pub(super) stroke_cut: bool,
    pub(super) log: Option<FiguresLog>,
    pub(super) title: String,
    pub(super) tour: Tour,
    pub(super) look: theme::Look,
}

/// Which parts of the window are visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VisibleParts {
    /// Menu bar, toolbar and panels.
    pub panels: bool,
    /// Sheet of panels over the canvas of a narrow window.
    pub sheet: bool,
    /// Palette and tubes.
    pub palette: bool,
    /// Table of keys.
    pub keys: bool,
    /// First steps over the painting.
    pub first_steps: bool,
    /// Window of the pen.
    pub pen: bool,
    /// Window of own brushes.
    pub brush_sets: bool,
    /// Window of the drawing aids.
    pub aids: bool,
}

impl Studio {
    /// Creates the window's state from its parts.
    #[must_use]
    pub fn new(context: &Context, parts: Parts) -> Self {
        let Parts { worker, pen, files, open, log } = parts;
        let look = files.preferences.look();
        theme::apply_look(context, look);
        context.options_mut(|options| {
            // Ctrl and plus zoom the canvas, not the user interface.
            options.zoom_with_keyboard = false;
        });
        context.set_zoom_factor(files.preferences.interface_scale);
        let StartedWorker { worker, window } = worker;
        // The slot is empty, because a worker has only one window.
        let _ = window.set(context.clone());
        let saved = &files.preferences.tools;
        let tools = Tools {
            brush: saved.brush.clone(),
            vehicle: saved.vehicle,
            load_mm: saved.load_mm,
            squeeze_mm3: saved.squeeze_mm3,
            dry_share: saved.dry_share,
            ..Tools::default()
        };
        let subject = open.as_deref().and_then(|path| Subject::from_text(path.to_str()?));
        let open = open.filter(|_| subject.is_none());
        let open = open.map(|path| Request::File(FileRequest::Open(Some(path))));
        let first_steps = !files.preferences.first_steps_seen;
        let mut panels = Panels::default();
        panels.arrange(&files.preferences.arrangement);
        let mut studio = Self {
            tools,
            canvas: SurfaceView::new("Canvas", Outline::Rectangle, 22.0),
            palette: SurfaceView::new("Palette", Outline::Palette, 10.0),
            visible: VisibleParts {
                panels: true,
                sheet: false,
                palette: true,
                keys: false,
                first_steps,
                pen: false,
                brush_sets: false,
                aids: false,
            },
            pen,
            aids: DrawingAids::default(),
            panels,
            files,
            crop: None,
            volumes: None,
            shows_volumes: false,
            worker,
            painting: None,
            keys: Keys::default(),
            keymap: Keymap::default(),
            keymap_changes: None,
            key_faults: Vec::new(),
            key_editor: KeyEditor::default(),
            pen_window: PenWindow::default(),
            own_brushes: OwnBrushes::default(),
            frames: Frames::default(),
            figures: Performance::default(),
            head: None,
            head_rect: None,
            hover: None,
            hovering: None,
            quick: None,
            message: None,
            requests: open.into_iter().collect(),
            event_count: 0,
            last_recording: None,
            last_pick: None,
            mask_points: Vec::new(),
            mask_dashes: Dashes::default(),
            aid_handles: Vec::new(),
            aid_grabbed: [0.0; 2],
            twins: None,
            stroke_cut: false,
            log,
            title: String::new(),
            tour: Tour::default(),
            look,
        };
        if let Some(subject) = subject {
            studio.open_scene(context, subject);
        }
        studio
    }

    /// State of the painting as last reported by the worker; `None` before the first.
    #[must_use]
    pub fn painting(&self) -> Option<&PaintingState> {
        self.painting.as_deref()
    }

    /// Performance figures of the worker.
    #[must_use]
    pub fn figures(&self) -> Performance {
        self.figures
    }

    /// Last message shown to the user.
    #[must_use]
    pub fn message(&self) -> Option<&Message> {
        self.message.as_ref()
    }

    /// Number of worker events handled so far.
    #[must_use]
    pub fn event_count(&self) -> u64 {
        self.event_count
    }

    /// Number of the recording request that the worker answered last.
    #[must_use]
    pub fn last_recording(&self) -> Option<u64> {
        self.last_recording.as_ref().map(|(number, _)| *number)
    }

    /// The recording that the worker answered last.
    #[must_use]
    pub fn recorded(&self) -> Option<&StrokeScript> {
        self.last_recording.as_ref().map(|(_, script)| &**script)
    }

    /// Shows the workspace of scenes. This starts it the first time.
    pub fn show_volumes(&mut self, context: &Context) -> &mut Volumes {
        self.shows_volumes = true;
        self.volumes.get_or_insert_with(|| Volumes::new(context))
    }

    /// Opens a scene in the workspace of scenes.
    pub fn open_scene(&mut self, context: &Context, subject: Subject) {
        self.show_volumes(context).open(subject);
    }

    /// The guided tour.
    #[must_use]
    pub fn tour(&self) -> &Tour {
        &self.tour
    }

    pub(super) fn view(&self, surface: SurfaceId) -> &SurfaceView {
        match surface {
            SurfaceId::Canvas => &self.canvas,
            SurfaceId::Palette => &self.palette,
        }
    }

    /// Surfaces visible in the window, topmost first.
    pub(super) fn visible_surfaces(&self) -> Vec<SurfaceId> {
        let palette = self.visible.palette && self.visible.panels;
        if palette { vec![SurfaceId::Palette, SurfaceId::Canvas] } else { vec![SurfaceId::Canvas] }
    }

    /// Lets the workers work until `deadline`. Use this in a page, which has no threads. Returns
    /// how long they can wait for the next turn.
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
        if let Some(setup) = self.files.take_window_setup() {
            self.set_up(&setup, context);
        }
        self.files.note_window_setup(self.window_setup());
        self.files.note_drawings(self.panels.reference.unsaved_drawings());
        for command in self.files.update(context) {
            self.send(command);
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
            // Only the workspace that asked for an export gets its answer.
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
        // We wait until you release the pointer, because a drag changes the scale at every step.
        if !context.input(|input| input.pointer.any_down()) {
            self.files.preferences.arrangement = self.panels.arrangement();
        }
    }

    /// Applies theme, touch targets and scale if these or the size of the window changed.
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
        keys::show(&context, &mut self.visible.keys, &mut self.key_editor, keymap, changes);
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

    /// Uses the keys of the preferences if they or the language changed. Reports new faults in
    /// them.
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

    pub(super) fn draw(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        let bar = Frame::new().inner_margin(Margin::symmetric(6, 2));
        let painting = self.painting.clone();
        let history = painting.as_ref().map_or((false, false), |painting| {
            (painting.history_done > 0, painting.history_done < painting.history.len())
        });
        let mirror = self.canvas.view.mirror;
        let mut intent = None;
        if self.visible.panels {
            let panels = self.shows_panels(&context);
            let shown = (panels, self.visible.palette, self.tools.figures);
            let scene = self.volumes.is_some();
            let open = painting.is_some();
            let look = self.files.preferences.look();
            let aids = self.aids;
            let state = bars::MenuState { open, scene, history, shown, mirror, aids, look };
            let title = self.title.clone();
            Panel::top("menus").frame(bar).show_separator_line(false).show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                intent = bars::show_menus(ui, state, &title);
            });
            let line = bars::height(&context, self.message.as_ref());
            Panel::bottom("line").frame(bar).exact_size(line).show_separator_line(false).show(
                ui,
                |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                    self.status_line(ui);
                },
            );
            let column = bar.inner_margin(Margin::symmetric(4, 6));
            Panel::left("tools")
                .frame(column)
                .resizable(false)
                .exact_size(bars::width(&context))
                .show_separator_line(false)
                .show(ui, |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                    let mode = self.keys.mode(self.tools.mode);
                    let state = bars::State { mode, mirror, history };
                    intent = intent.or(bars::show_toolbar(ui, state));
                });
            if !theme::is_narrow(&context) {
                self.draw_columns(ui);
            }
        }
        if let Some(intent) = intent {
            self.perform(intent, &context);
        }
        let covered = self.shows_sheet(&context);
        CentralPanel::no_frame()
            .show(ui, |ui| if covered { self.draw_sheet(ui) } else { self.draw_surfaces(ui) });
        if covered {
            let events = context.input(|input| input.events.clone());
            self.update_pen(&context, &events, self.keys.mode(self.tools.mode));
        }
    }

    fn draw_columns(&mut self, ui: &mut Ui) {
        let Some(painting) = self.painting.clone() else { return };
        let context = ui.ctx().clone();
        let mut drawn = Drawn::default();
        for side in Side::ALL {
            let width = self.panels.column_width(&context, side);
            if width == 0.0 {
                continue;
            }
            let column = match side {
                Side::Left => Panel::left("left panels"),
                Side::Right => Panel::right("right panels"),
            };
            let column = column.frame(Frame::NONE).resizable(false).exact_size(width);
            column.show_separator_line(false).show(ui, |ui| {
                let requests = &mut self.requests;
                let mut cx = PanelContext { painting: &painting, tools: &mut self.tools, requests };
                self.panels.show(ui, side, (&mut cx, &self.files), &mut drawn);
            });
        }
        self.panels.drop_dragged(&context, drawn, ui.available_rect_before_wrap());
    }

    fn status_line(&mut self, ui: &mut Ui) {
        let now = Instant::now();
        let Some(painting) = self.painting.clone() else {
            ui.weak(tr("preparing the canvas"));
            return;
        };
        let (width, height) = painting.canvas_cells;
        let [width_mm, height_mm] = [width, height].map(|cells| cells as f64 * painting.cell_mm);
        let view = self.canvas.view;
        let turn = (view.snapped_turn().to_degrees().round() as i64).rem_euclid(360);
        let turn = if turn == 0 { String::new() } else { tr_format!(", {turn} degrees", turn) };
        let mirrored = if view.mirror { tr(", mirrored") } else { "" };
        let second =
            painting.second_lighting.as_ref().map(|second| format!(" | {}", second.illuminant));
        let light = &painting.lighting;
        let state = bars::StatusState {
            message: self.message.as_ref().filter(|message| message.is_displayed(now)),
            view: format!("{:.0} %{turn}{mirrored}", view.zoom * 100.0),
            size: format!("{width} x {height}, {width_mm:.0} x {height_mm:.0} mm"),
            light: format!("{}{}", light.illuminant, second.unwrap_or_default()),
            backend: &painting.backend,
        };
        if bars::show_status(ui, &state) {
            self.message = None;
        }
    }

    /// Handles all events that arrived since the last call.
    pub(super) fn handle_events(&mut self) {
        let events: Vec<Event> = self.worker.events().collect();
        for event in events {
            self.handle_event(event);
        }
    }

    /// Handles one event as if it came from the worker. Tests use this to inject
    /// events.
    pub fn handle_event(&mut self, event: Event) {
        self.event_count += 1;
        self.files.handle_event(&event);
        match event {
            Event::Opened(state) => self.open_painting(state),
            Event::State(state) => self.set_painting(state),
            Event::Tiles { surface, second, tiles, newest } => {
                let view = match surface {
                    SurfaceId::Canvas => &mut self.canvas,
                    SurfaceId::Palette => &mut self.palette,
                };
                for tile in &tiles {
                    view.write(second, tile);
                }
                if let Some(arrived) = newest {
                    self.frames.shows(arrived);
                }
            }
            Event::Head(head) => self.head = head,
            Event::Performance(figures) => self.figures = figures,
            Event::Picked(picked) => {
                self.tools.picked = Some(picked);
                self.panels.select(Tab::Color);
            }
            Event::Recording { number, script } => self.last_recording = Some((number, script)),
            // The files have handled these above.
            Event::Snapshot(_) | Event::Kept(_) | Event::Progress { .. } | Event::Replayed => {}
            Event::DirtyBrush(brush) => {
                let text = tr_format!("the brush \u{201c}{brush}\u{201d} is dirty", brush);
                let [wash, wipe] = ["wash", "wipe"].map(|name| {
                    let row = self.keymap.easel.row(name);
                    let key = row.and_then(|row| row.keys.first());
                    key.map_or_else(String::new, |key| format!(" ({})", key.text()))
                });
                let hint =
                    tr_format!("wash{wash} or wipe{wipe} it before another colour", wash, wipe);
                self.show_message(text, Some(hint), false);
            }
            Event::Message { text, hint, failed } => {
                self.show_message(text, hint.map(|hint| hint.to_string()), failed);
            }
        }
    }

    /// Shows another painting and resets what belongs to the previous one.
    fn open_painting(&mut self, state: Arc<PaintingState>) {
        self.canvas.open(state.canvas_cells);
        self.palette.open(state.palette_cells);
        self.head = None;
        self.hover = None;
        self.tour.forget();
        self.crop = None;
        self.twins = None;
        self.set_painting(state);
        let Some(painting) = &self.painting else { return };
        let exists = painting.brushes.iter().any(|brush| brush.name == self.tools.brush);
        if let Some(first) = painting.brushes.first().filter(|_| !exists) {
            self.tools.brush = first.name.clone();
        }
    }

    fn set_painting(&mut self, state: Arc<PaintingState>) {
        for surface in [&mut self.canvas, &mut self.palette] {
            surface.set_second(state.second_lighting.is_some());
        }
        self.painting = Some(state);
    }

    pub(super) fn show_message(&mut self, text: String, hint: Option<String>, failed: bool) {
        self.message = Some(Message { text, hint, failed, shown_at: Instant::now() });
    }

    /// How the window is set up now.
    #[must_use]
    pub fn window_setup(&self) -> WindowSetup {
        let ViewState { centre, zoom, rotation, mirror, fitted } = self.canvas.view;
        let reference = self.panels.reference.pinned();
        WindowSetup {
            brush: Some(self.tools.brush.clone()),
            tool: Some(self.tools.mode.name().to_owned()),
            view: Some(CanvasView { centre, zoom, rotation, mirror, fitted }),
            aids: Some(self.aids),
            reference: reference.map(|(path, drawings)| PinnedReference::new(path, &drawings)),
        }
    }

    /// Sets the window up as `setup` says. This skips what the painting does not have.
    pub fn set_up(&mut self, setup: &WindowSetup, context: &Context) {
        let brushes = self.painting.iter().flat_map(|painting| &painting.brushes);
        let brush =
            brushes.map(|brush| &brush.name).find(|name| setup.brush.as_ref() == Some(name));
        if let Some(brush) = brush {
            self.tools.brush = brush.clone();
        }
        if let Some(mode) = setup.tool.as_deref().and_then(Mode::named) {
            self.tools.mode = mode;
        }
        if let Some(CanvasView { centre, zoom, rotation, mirror, fitted }) = setup.view {
            self.canvas.view = ViewState { centre, zoom, rotation, mirror, fitted };
        }
        self.aids = setup.aids.unwrap_or(self.aids);
        if let Some(reference) = &setup.reference {
            let picture = reference.picture.clone();
            let drawings = reference.drawn();
            let restored = ReferenceChange::Restore { picture, drawings };
            if let Some(problem) = self.panels.reference.apply(restored, context) {
                self.files.report(problem);
            }
        }
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.worker.ask(Command::Quit);
    }
}

/// A started worker, and the slot for the window that it wakes.
#[derive(Debug)]
pub struct StartedWorker {
    pub(super) worker: Worker,
    pub(super) window: Arc<OnceLock<Context>>,
}

impl StartedWorker {
    /// Starts the worker and sends it `commands`.
    #[must_use]
    pub fn new(options: WorkerOptions, commands: Vec<Command>) -> Self {
        let window: Arc<OnceLock<Context>> = Arc::default();
        let wakes = Arc::clone(&window);
        let wake = move || {
            if let Some(context) = wakes.get() {
                pace::wake(context);
            }
        };
        #[cfg(not(target_arch = "wasm32"))]
        let worker = Worker::start(options, wake);
        #[cfg(target_arch = "wasm32")]
        let worker = Worker::in_turns(options, wake);
        commands.into_iter().for_each(|command| worker.ask(command));
        Self { worker, window }
    }
}

/// Parts that a [`Studio`](super::Studio) is created from.
#[derive(Debug)]
pub struct Parts {
    /// Worker thread, already started.
    pub worker: StartedWorker,
    /// Input of pen, mouse and touch.
    pub pen: Pen,
    /// File dialogs, tasks and preferences.
    pub files: Files,
    /// File to open first.
    pub open: Option<PathBuf>,
    /// Performance log, if asked for.
    pub log: Option<FiguresLog>,
}
