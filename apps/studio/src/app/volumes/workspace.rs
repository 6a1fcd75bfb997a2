//! State of the workspace of scenes: the picture in the window, input of pen and mouse, events of
//! the worker, and exported files.

use std::path::PathBuf;
use std::sync::Arc;

use documents::file::{disk, write_whole};
use eframe::egui::{
    Color32, Context, CursorIcon, Event, Id, Modifiers, PointerButton, Popup, Pos2, Rect, Response,
    Role, Sense, Stroke, Ui, WidgetInfo, vec2,
};
use glam::Vec3;
use graphics::camera::Camera;
use graphics::export::PictureFormat;
use graphics::tile::Rect as TileRect;
use paint::document::{Document, Lighting};
use paint::light::Light;
use paint::strokes::SurfaceId;
use session::brushes::{BrushOptions, StabiliserMethod};
use session::volumes::{
    Here, SHAPE, SceneImage, ScenePen, ScenePicture, SceneRecording, SceneState, SceneTool,
    Subject, VolumeCommand, VolumeEvent, VolumeWorker,
};
use session::{TilePixels, Wait};
use web_time::Instant;

use super::orbit::Orbit;
use crate::app::bars::Message;
use crate::app::frames::Frames;
use crate::files::{self, Files, Problem, SceneAnswer};
use crate::language::{tr, tr_format};
use crate::panels::volumes::{
    SceneContext, SceneExport, SceneFileRequest, SceneRequest, SceneTools, show_here,
};
use crate::pen::{Device, Pen, PenEvent, PenTargets, SurfaceTransform};
use crate::view::{DrawnPart, Picture, ViewState, fill_rect};
use crate::{pace, theme};

/// A new scene begins with this subject.
const NEW: &str = "village";

/// The camera that we use before a scene is open.
const NOWHERE: Camera = Camera {
    eye: Vec3::Z,
    target: Vec3::ZERO,
    up: Vec3::Y,
    field_of_view_deg: 35.0,
    near: 0.1,
    far: 10.0,
};

/// The workspace of scenes. It starts the worker of scenes.
#[derive(Debug)]
pub struct Volumes {
    /// Tools and panels, as you set them.
    pub tools: SceneTools,
    /// The camera, as you move it.
    pub orbit: Orbit,
    pub(super) worker: VolumeWorker,
    pub(super) state: Option<Arc<SceneState>>,
    /// The last picture, also as textures.
    pub(super) picture: Option<(Arc<ScenePicture>, Picture)>,
    pub(super) rect: Rect,
    /// Camera and size of the picture that we last sent to the worker.
    pub(super) sent_view: (Option<Camera>, [usize; 2]),
    pub(super) device: Option<Device>,
    /// Whether we have told the worker that the pointing device is down.
    pub(super) pours: bool,
    /// The answer to a right click, and where you clicked.
    pub(super) here: Option<(Pos2, Option<Here>)>,
    pub(super) message: Option<Message>,
    pub(super) requests: Vec<SceneRequest>,
    /// Number of received pictures, and the time of the last one.
    pub(super) pictures: u64,
    pub(super) shown_at: Option<Instant>,
    /// Frames of the last second in which a picture arrived.
    pub(super) frames: Frames,
    /// Files that the worker will fill, by the number of the request.
    pub(super) awaited: Vec<(u64, SceneExport, PathBuf)>,
    pub(super) last_request: u64,
}

impl Volumes {
    /// Starts the workspace. Events of the worker repaint `context`.
    #[must_use]
    pub fn new(context: &Context) -> Self {
        let woken = context.clone();
        #[cfg(not(target_arch = "wasm32"))]
        let worker = VolumeWorker::start(move || pace::wake(&woken));
        #[cfg(target_arch = "wasm32")]
        let worker = VolumeWorker::in_turns(move || pace::wake(&woken));
        Self {
            tools: SceneTools::default(),
            orbit: Orbit::around([Vec3::NEG_ONE, Vec3::ONE], NOWHERE),
            worker,
            state: None,
            picture: None,
            rect: Rect::NOTHING,
            sent_view: (None, [0; 2]),
            device: None,
            pours: false,
            here: None,
            message: None,
            requests: Vec::new(),
            pictures: 0,
            shown_at: None,
            frames: Frames::default(),
            awaited: Vec::new(),
            last_request: 0,
        }
    }

    /// Lets the worker of a page work until `deadline`. Returns how long it can wait.
    pub(crate) fn turn(&self, deadline: Instant) -> Wait {
        self.worker.turn(deadline)
    }

    /// State of the scene as last reported; `None` before the first.
    #[must_use]
    pub fn state(&self) -> Option<&SceneState> {
        self.state.as_deref()
    }

    /// The last picture; `None` before the first.
    #[must_use]
    pub fn picture(&self) -> Option<&ScenePicture> {
        self.picture.as_ref().map(|(picture, _)| picture.as_ref())
    }

    /// Number of pictures received.
    #[must_use]
    pub fn pictures(&self) -> u64 {
        self.pictures
    }

    /// Rectangle of the picture in the window, in points.
    #[must_use]
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// The answer to the last right click, while its card is open.
    #[must_use]
    pub fn here(&self) -> Option<&Here> {
        self.here.as_ref()?.1.as_ref()
    }

    /// Queues a command for the worker.
    pub fn ask(&mut self, command: VolumeCommand) {
        self.requests.push(SceneRequest::Worker(command));
    }

    /// Opens a scene in place of the open one.
    pub fn open(&mut self, subject: Subject) {
        self.here = None;
        self.ask(VolumeCommand::Open(subject));
    }

    /// Opens the scene that a new one begins with.
    pub fn open_new(&mut self) {
        self.open(Subject::Shape(NEW.to_owned()));
    }

    /// Whether a scene is open or requested.
    #[must_use]
    pub fn is_used(&self) -> bool {
        self.state.is_some() || !self.requests.is_empty()
    }

    /// Title of the window while a scene is shown.
    #[must_use]
    pub fn title(&self) -> String {
        self.state.as_ref().map_or_else(|| "scene".to_owned(), |state| state.title.clone())
    }

    pub(in crate::app) fn say(&mut self, text: String) {
        self.message = Some(Message { text, hint: None, failed: false, shown_at: Instant::now() });
    }

    pub(super) fn file(&mut self, request: SceneFileRequest) {
        self.requests.push(SceneRequest::File(request));
    }

    /// Calls `ask` with the context of the panels, if a scene is open.
    pub(super) fn with_panels(&mut self, ask: impl FnOnce(&mut SceneContext<'_>)) {
        let Some(state) = self.state.clone() else { return };
        let requests = &mut self.requests;
        ask(&mut SceneContext { state: &state, tools: &mut self.tools, requests });
    }

    /// Place of the picture at a point of the window, for the worker's commands.
    pub(super) fn place(&self, point: Pos2) -> [f32; 2] {
        let from_corner = point - self.rect.min;
        let share = from_corner / self.rect.size().max(vec2(1.0, 1.0));
        [share.x, share.y]
    }

    /// Notes the file and returns the number of the request for its content.
    pub(super) fn await_file(&mut self, export: SceneExport, path: PathBuf) -> u64 {
        self.last_request += 1;
        self.awaited.push((self.last_request, export, path));
        self.last_request
    }

    /// Name of the subject of new scenes, as on the command line.
    #[must_use]
    pub fn new_subject() -> String {
        format!("{SHAPE}{NEW}")
    }

    /// Draws the picture in a rectangle of the window, and lets you use the tool and the camera on
    /// it.
    pub(super) fn show_canvas(&mut self, ui: &mut Ui, rect: Rect, pen: &mut Pen) {
        fill_rect(ui.painter(), rect, theme::SURROUND);
        self.rect = rect;
        let id = Id::unique("scene");
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, tr(NAME)));
        let density = ui.ctx().pixels_per_point();
        let painter = ui.painter_at(rect);
        if let Some((_, picture)) = &mut self.picture {
            let mut view = ViewState::default();
            view.fit(picture.cells(), rect, 0.0, density);
            let mut placement = view.placement(rect, density);
            // While the scene moves, the picture is smaller and we smooth it.
            placement.aligned &= view.zoom == 1.0;
            picture.draw(&painter, &placement, DrawnPart::Whole);
        }
        self.navigate(ui, &response);
        self.use_tool(ui, pen);
        self.draw_reach(ui, &response);
        self.ask_here(ui, &response);
        self.tell_sight(rect, density);
    }

    /// Sends camera and size to the worker if they changed.
    fn tell_sight(&mut self, rect: Rect, density: f32) {
        if self.state.is_none() {
            return;
        }
        let size = [rect.width(), rect.height()].map(|side| (side * density).round().max(1.0));
        self.orbit.set_aspect(size[0] / size[1]);
        let size = size.map(|side| side as usize);
        let camera = self.orbit.camera();
        if self.sent_view.1 != size {
            self.sent_view.1 = size;
            self.ask(VolumeCommand::Size(size));
        }
        if self.sent_view.0 != Some(camera) {
            self.sent_view.0 = Some(camera);
            self.ask(VolumeCommand::Camera(camera));
        }
    }

    /// Draws a ring around the pointer, as wide as the tool reaches.
    fn draw_reach(&self, ui: &Ui, response: &Response) {
        let Some(pointer) = response.hover_pos() else { return };
        let Some(state) = &self.state else { return };
        let grip = self.tools.grip;
        let radius = match grip.tool {
            SceneTool::Pour => 4.0,
            _ => self.orbit.points(grip.radius_mm / state.unit_mm, self.rect.height()),
        };
        let painter = ui.painter_at(self.rect);
        painter.circle_stroke(pointer, radius, Stroke::new(3.0, Color32::from_black_alpha(90)));
        painter.circle_stroke(pointer, radius, Stroke::new(1.0, theme::colors(ui.ctx()).strong));
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
    }

    /// If you click with the right button, this asks what lies there and shows the answer.
    fn ask_here(&mut self, ui: &Ui, response: &Response) {
        if let (Some((at, Some(here))), Some(state)) = (&self.here, &self.state)
            && !show_here(ui.ctx(), *at, here, state)
        {
            self.here = None;
        }
        if response.clicked_by(PointerButton::Secondary)
            && let Some(pointer) = response.interact_pointer_pos()
        {
            self.here = Some((pointer, None));
            let place = self.place(pointer);
            self.ask(VolumeCommand::Pick(place));
        }
    }

    /// The middle button and the wheel turn, move and zoom the camera.
    pub(super) fn navigate(&mut self, ui: &Ui, response: &Response) {
        let height = self.rect.height();
        if response.dragged_by(PointerButton::Middle) {
            let moved = response.drag_delta();
            if ui.input(|input| input.modifiers.shift) {
                self.orbit.pan(moved, height);
            } else {
                self.orbit.turn(moved);
            }
        }
        if !response.contains_pointer() {
            return;
        }
        let (scroll, zoom, pointer) = ui.input(|input| {
            (input.smooth_scroll_delta(), input.zoom_delta(), input.pointer.hover_pos())
        });
        let factor = zoom * (scroll.y / WHEEL_POINTS).exp();
        if let Some(pointer) = pointer.filter(|_| factor != 1.0) {
            self.orbit.zoom(factor, pointer - self.rect.center(), height);
        }
    }

    /// Uses the tool in hand where the pen is down.
    pub(super) fn use_tool(&mut self, ui: &Ui, pen: &mut Pen) {
        let context = ui.ctx();
        let corner = self.rect.min;
        // One point of the window is one unit of the pen's plane.
        let plane = SurfaceTransform::new(SurfaceId::Canvas, self.rect, |point| {
            (f64::from(point.x - corner.x), f64::from(point.y - corner.y))
        });
        let blocked = self.state.is_none()
            || Popup::is_any_open(context)
            || context.memory(|memory| memory.top_modal_layer().is_some());
        let targets = PenTargets {
            surfaces: &[plane],
            covered: &|point| {
                let above = context.layer_id_at(point);
                blocked || above.is_some_and(|layer| layer.order != eframe::egui::Order::Background)
            },
        };
        let events: Vec<Event> = ui.input(|input| input.events.clone());
        // Paint pours at once. It has no brush and no direction that we could wait for.
        pen.settings.follow = false;
        pen.settings.stabiliser.method = StabiliserMethod::Off;
        (pen.options, pen.guide) = (BrushOptions::default(), None);
        let now = Instant::now();
        for event in pen.process_frame(&events, Modifiers::NONE, now, &targets) {
            self.handle_pen(event);
        }
        if let Some(soon) = pen.repaint_after(Instant::now()) {
            pace::frame_after(context, soon, Instant::now());
        }
    }

    fn handle_pen(&mut self, event: PenEvent) {
        match event {
            PenEvent::Down { device, .. } => {
                self.device = Some(device);
                self.pours = false;
            }
            PenEvent::Move(samples) => {
                let measures = self.device.is_some_and(Device::is_pen);
                for sample in samples {
                    let sample = sample.sample;
                    let size = self.rect.size();
                    let pen = ScenePen {
                        at: [sample.x_mm as f32 / size.x, sample.y_mm as f32 / size.y],
                        pressure: if measures { sample.pressure as f32 } else { 1.0 },
                    };
                    if std::mem::replace(&mut self.pours, true) {
                        self.ask(VolumeCommand::PenMove(pen));
                    } else {
                        self.ask(VolumeCommand::PenDown(self.tools.grip, pen));
                    }
                }
            }
            PenEvent::Up => {
                if std::mem::take(&mut self.pours) {
                    self.ask(VolumeCommand::PenUp);
                }
            }
            PenEvent::Hover { .. }
            | PenEvent::Leave
            | PenEvent::Tap { .. }
            | PenEvent::Barrel { .. } => {}
        }
    }

    /// Handles all events that arrived since the last call.
    pub(in crate::app) fn handle_events(&mut self, files: &mut Files) {
        let events: Vec<VolumeEvent> = self.worker.events().collect();
        for event in events {
            self.handle_event(event, files);
        }
    }

    fn handle_event(&mut self, event: VolumeEvent, files: &mut Files) {
        match event {
            VolumeEvent::Opened(state) => {
                let orbit = Orbit::around(state.bounds, state.framed);
                let seen_from = state.seen_from.as_ref();
                self.orbit = seen_from.map_or(orbit, |camera| orbit.seen_by(camera));
                self.sent_view.0 = None;
                (self.here, self.tools.here) = (None, None);
                self.message = None;
                files.scene_opened(&state);
                self.state = Some(state);
            }
            VolumeEvent::State(state) => {
                files.scene_changed(&state);
                self.state = Some(state);
            }
            VolumeEvent::Picture(picture) => self.show_picture(picture),
            VolumeEvent::Here(here) => {
                self.tools.here = Some((*here).clone());
                if let Some((_, answer)) = &mut self.here {
                    *answer = Some(*here);
                }
            }
            VolumeEvent::Recording(number, recording) => {
                self.write_recording(number, &recording, files);
            }
            VolumeEvent::Drawn(number, picture) => self.write_picture(number, picture, files),
            VolumeEvent::Painted(number, document) => self.write_painting(number, document, files),
            VolumeEvent::Message { text, hint, failed: true } => {
                let hint = hint.map(|hint| hint.to_string());
                files.report(Problem { text, hint });
            }
            VolumeEvent::Message { text, hint, failed: false } => {
                let hint = hint.map(|hint| hint.to_string());
                self.message =
                    Some(Message { text, hint, failed: false, shown_at: Instant::now() });
            }
        }
    }

    fn show_picture(&mut self, picture: Arc<ScenePicture>) {
        let ScenePicture { width, height, .. } = *picture;
        let kept = self.picture.take().map(|(_, shown)| shown);
        let kept = kept.filter(|shown| shown.cells() == (width, height));
        let mut shown = kept.unwrap_or_else(|| Picture::new(tr("Scene"), (width, height)));
        let rect = TileRect { x: 0, y: 0, width, height };
        shown.write(&TilePixels { rect, pixels: picture.pixels.clone() });
        self.picture = Some((picture, shown));
        self.pictures += 1;
        self.shown_at = Some(Instant::now());
        self.frames.begin(Instant::now(), None);
    }

    /// Asks for the next frame while we wait for the worker.
    pub(super) fn keep_awake(&self, context: &Context) {
        if let Some(rest) = self.message.as_ref().and_then(|message| message.rest(Instant::now())) {
            context.request_repaint_after(rest);
        }
    }

    /// Does what you chose for a scene.
    pub(in crate::app) fn answer(&mut self, answer: SceneAnswer, files: &mut Files) {
        match answer {
            SceneAnswer::Open(path) => self.open(Subject::of_file(&path)),
            SceneAnswer::Library(path) => self.ask(VolumeCommand::Library(path)),
            SceneAnswer::Export(export, path) => self.export(export, path),
            SceneAnswer::Recover(lost) => {
                let folder = lost.meta.path.clone().unwrap_or_default();
                match disk::read_to_string(lost.script()) {
                    Ok(text) => {
                        self.open(Subject::Text { text, folder });
                        files.recovering_scene(lost);
                    }
                    Err(error) => {
                        let text = tr_format!(
                            "the autosave of {title}: cannot be read: {error}",
                            title = lost.meta.title,
                            error
                        );
                        files.report(Problem { text, hint: None });
                    }
                }
            }
        }
    }

    /// Asks for the recording if an autosave is due.
    pub(in crate::app) fn autosave(&mut self, files: &mut Files) {
        if files.wants_scene_recording() {
            self.worker.ask(VolumeCommand::Recording(AUTOSAVE));
        }
    }

    /// Asks the worker for the content of a file.
    fn export(&mut self, export: SceneExport, path: PathBuf) {
        let size = self.sent_view.1;
        let number = self.await_file(export, path);
        self.ask(match export {
            SceneExport::Picture => VolumeCommand::Draw(number, size),
            SceneExport::Painting | SceneExport::OfPainting(_) => {
                VolumeCommand::Paint(number, size)
            }
            SceneExport::Script | SceneExport::Animation => VolumeCommand::Recording(number),
        });
    }

    /// Removes and returns the file of a request.
    fn take_awaited(&mut self, number: u64) -> Option<(SceneExport, PathBuf)> {
        let at = self.awaited.iter().position(|(own, ..)| *own == number)?;
        let (_, export, path) = self.awaited.remove(at);
        Some((export, path))
    }

    pub(super) fn write_recording(
        &mut self,
        number: u64,
        recording: &Arc<SceneRecording>,
        files: &mut Files,
    ) {
        if number == AUTOSAVE {
            return files.autosave_scene(recording);
        }
        match self.take_awaited(number) {
            Some((SceneExport::Script, path)) => files.save_scene(recording, path),
            Some((SceneExport::Animation, path)) => {
                let recording = Arc::clone(recording);
                let size = self.sent_view.1;
                files.export_scene(path, move |path, task| {
                    session::volumes::animation(&recording, size, path, task)
                        .map_err(Problem::from)?;
                    // Nothing was written if it was cancelled.
                    task.reach(1.0)?;
                    Ok(None)
                });
            }
            _ => {}
        }
    }

    pub(super) fn write_picture(
        &mut self,
        number: u64,
        picture: Arc<SceneImage>,
        files: &mut Files,
    ) {
        let Some((_, path)) = self.take_awaited(number) else { return };
        files.export_scene(path, move |path, _| {
            let format = PictureFormat::from_path(path).unwrap_or(PictureFormat::Png8);
            let bytes = picture.file(format).map_err(Problem::from)?;
            write_whole(path, &bytes).map_err(Problem::from)?;
            Ok(None)
        });
    }

    /// Writes a painting, or an export of it.
    pub(super) fn write_painting(
        &mut self,
        number: u64,
        document: Arc<Document>,
        files: &mut Files,
    ) {
        let Some((export, path)) = self.take_awaited(number) else { return };
        files.export_scene(path, move |path, task| {
            if let SceneExport::OfPainting(export) = export {
                let Lighting { illuminant, observer, .. } = &document.lighting;
                let light = Light::named(&document.library, illuminant, observer);
                let light = light.map_err(|error| Problem::from_error(&error))?;
                return files::export(export, &document, &light, path, task);
            }
            let bytes = paint::file::write(&document);
            let bytes = bytes.map_err(|error| Problem::from_error(&error))?;
            task.reach(0.8)?;
            write_whole(path, &bytes).map_err(Problem::from)?;
            Ok(None)
        });
    }
}

const NAME: &str = "Scene";

/// Scrolling by these points zooms by a factor of e, as on the easel.
const WHEEL_POINTS: f32 = 220.0;

const AUTOSAVE: u64 = 0;
