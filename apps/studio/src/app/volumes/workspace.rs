//! State of the workspace of scenes.

use std::path::PathBuf;
use std::sync::Arc;
use web_time::Instant;

use eframe::egui::{Context, Pos2, Rect, vec2};
use glam::Vec3;
use graphics::camera::Camera;

use super::orbit::Orbit;
use crate::app::frames::Frames;
use crate::app::status::Message;
use crate::pace;
use crate::panels::volumes::{
    SceneContext, SceneExport, SceneFileRequest, SceneRequest, SceneTools,
};
use crate::pen::Device;
use crate::view::Picture;
use session::Wait;
use session::volumes::{
    Here, SHAPE, ScenePicture, SceneState, Subject, VolumeCommand, VolumeWorker,
};

/// Subject of a new scene.
const NEW: &str = "village";

/// The camera before a scene is open.
const NOWHERE: Camera = Camera {
    eye: Vec3::Z,
    target: Vec3::ZERO,
    up: Vec3::Y,
    field_of_view_deg: 35.0,
    near: 0.1,
    far: 10.0,
};

/// The workspace of scenes. Its worker starts with it.
#[derive(Debug)]
pub struct Volumes {
    /// Tools and panels as they are set.
    pub tools: SceneTools,
    /// The camera, moved by the hand.
    pub orbit: Orbit,
    pub(super) worker: VolumeWorker,
    pub(super) state: Option<Arc<SceneState>>,
    /// The last picture, and it on the screen.
    pub(super) picture: Option<(Arc<ScenePicture>, Picture)>,
    /// Rectangle of the picture in the window, in points.
    pub(super) rect: Rect,
    /// Camera and size of the picture that the worker was told last.
    pub(super) told: (Option<Camera>, [usize; 2]),
    /// The device that is down.
    pub(super) device: Option<Device>,
    /// Whether the worker knows that it is down.
    pub(super) pours: bool,
    /// The answer to a right click, and where it was asked.
    pub(super) here: Option<(Pos2, Option<Here>)>,
    pub(super) message: Option<Message>,
    pub(super) requests: Vec<SceneRequest>,
    /// Pictures received, and when the last one came.
    pub(super) pictures: u64,
    pub(super) shown_at: Option<Instant>,
    /// Frames of the last second in which a picture arrived.
    pub(super) frames: Frames,
    /// Files that the worker was asked to fill, by the number of the request.
    pub(super) awaited: Vec<(u64, SceneExport, PathBuf)>,
    pub(super) last_request: u64,
}

impl Volumes {
    /// Starts the workspace. `context` is drawn again when the worker has news.
    #[must_use]
    pub fn new(context: &Context) -> Self {
        let woken = context.clone();
        let wake = move || pace::wake(&woken);
        #[cfg(not(target_arch = "wasm32"))]
        let worker = VolumeWorker::start(wake);
        #[cfg(target_arch = "wasm32")]
        let worker = VolumeWorker::in_turns(wake);
        Self {
            tools: SceneTools::default(),
            orbit: Orbit::around([Vec3::NEG_ONE, Vec3::ONE], NOWHERE),
            worker,
            state: None,
            picture: None,
            rect: Rect::NOTHING,
            told: (None, [0; 2]),
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

    /// Lets the worker of a page work until `deadline`. Returns how long it may wait.
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

    /// Whether a scene is open or was asked for.
    #[must_use]
    pub fn is_used(&self) -> bool {
        self.state.is_some() || !self.requests.is_empty()
    }

    /// Title of the window while a scene is shown.
    #[must_use]
    pub fn title(&self) -> String {
        self.state.as_ref().map_or_else(|| "scene".to_owned(), |state| state.title.clone())
    }

    /// Shows a message in the status line.
    pub(in crate::app) fn say(&mut self, text: String) {
        self.message = Some(Message { text, hint: None, failed: false, shown_at: Instant::now() });
    }

    /// Queues a request for files.
    pub(super) fn file(&mut self, request: SceneFileRequest) {
        self.requests.push(SceneRequest::File(request));
    }

    /// Calls `ask` with the context of the panels, if a scene is open.
    pub(super) fn with_panels(&mut self, ask: impl FnOnce(&mut SceneContext<'_>)) {
        let Some(state) = self.state.clone() else { return };
        let requests = &mut self.requests;
        ask(&mut SceneContext { state: &state, tools: &mut self.tools, requests });
    }

    /// Place of the picture at a point of the window, as the worker's commands name it.
    pub(super) fn place(&self, point: Pos2) -> [f32; 2] {
        let from_corner = point - self.rect.min;
        let share = from_corner / self.rect.size().max(vec2(1.0, 1.0));
        [share.x, share.y]
    }

    /// Number of a new request for the content of a file.
    pub(super) fn await_file(&mut self, export: SceneExport, path: PathBuf) -> u64 {
        self.last_request += 1;
        self.awaited.push((self.last_request, export, path));
        self.last_request
    }

    /// Name of the subject that new scenes have, as the command line takes it.
    #[must_use]
    pub fn new_subject() -> String {
        format!("{SHAPE}{NEW}")
    }
}
