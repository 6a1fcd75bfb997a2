//! A test bench of the studio's files with a simulated worker.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use web_time::{Duration, Instant};

use egui_kittest::{Harness, kittest::Queryable};
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::layer::Layer;
use paint::light::Light;
use paint::painting::Painting;
use paint::pose::Sample;
use paint::session::RecordingTail;
use paint::strokes::{BrushSpec, KeptBrush, StrokeScript, SurfaceId};
use pigment::library::PigmentLibrary;
use session::{
    Command, Event, HistoryShots, KeptPainting, Origin, PaintingState, Snapshot, blank_canvas,
};
use studio::files::{FileRequest, Files, Home, Preferences};
use studio::panels::{PanelContext, Request, Tools, history};
use studio::theme;

use crate::harness::keep;

pub(super) fn painted(title: &str) -> Document {
    let Origin::Blank { mut script, library } =
        blank_canvas(PigmentLibrary::van_gogh_oils(), 24.0, 16.0, 0.2)
    else {
        panic!("a bare canvas");
    };
    script.title = title.to_owned();
    let resolved = script.resolve(&library).unwrap();
    let (width, height) = script.canvas.cells();
    let ground = script.canvas.ground.build(width, height, 0.2, &library).unwrap();
    let document = script.bare(&library, &resolved, ground);
    let mut painting = opened(document);
    for (pigment, y_mm) in [(3, 4.0), (5, 8.0), (1, 11.0)] {
        let shape = paint::brush::HeadShape::Round;
        let brush = painting.add_brush(shape, 5.0).unwrap();
        let mut parts = [0.0; 8];
        parts[pigment] = 1.0;
        painting.load(brush, &parts, 0.1, 0.3).unwrap();
        let samples = [0.0, 0.5, 1.0].map(|seconds| Sample {
            seconds,
            x_mm: 3.0 + 18.0 * seconds,
            y_mm: y_mm + 2.0 * seconds,
            pressure: 0.6,
            tilt_x_deg: 0.0,
            tilt_y_deg: 10.0,
            twist_deg: 0.0,
        });
        painting.stroke(brush, &samples).unwrap();
        if pigment == 3 {
            assert!(painting.dry(1.0).unwrap(), "there is paint to dry");
        }
    }
    painting.document().unwrap()
}

pub(super) fn opened(document: Document) -> Painting {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    Painting::open(document, engine, 1 << 24).unwrap()
}

/// Two brushes: one with a cell of wet paint, and a clean one.
fn brushes(canvas: &Document) -> Vec<KeptBrush> {
    let mut paint = Layer::empty(7, 5);
    let used = canvas.slots.iter().position(Option::is_some).unwrap();
    paint.pigments[(3, 2)][used] = 1234;
    let brushes = [("big", Some(paint)), ("clean", None)].map(|(name, paint)| KeptBrush {
        name: name.to_owned(),
        spec: BrushSpec { shape: paint::brush::HeadShape::Round, size_mm: 2.0 },
        at: SurfaceId::Palette,
        paint,
    });
    brushes.into()
}

/// State that a worker would report for `document`.
fn painting(document: &Document, revision: u64) -> Arc<PaintingState> {
    let lighting = document.lighting.clone();
    let light = Light::named(&document.library, &lighting.illuminant, &lighting.observer).unwrap();
    let cells = (document.wet.width(), document.wet.height());
    Arc::new(PaintingState {
        title: document.title.clone(),
        canvas_cells: cells,
        palette_cells: cells,
        cell_mm: document.cell_mm,
        library: Arc::new(document.library.clone()),
        slots: document.slots,
        masstones: [None; 8],
        tints: [None; 8],
        layers: Vec::new(),
        lighting,
        light: Arc::new(light),
        second_lighting: None,
        medium: document.medium.clone(),
        ground_reflectance: Arc::new(document.ground.reflectance.clone()),
        history: Vec::new(),
        history_done: 0,
        history_shots: HistoryShots::default(),
        undo_bytes: (0, 0),
        brushes: Vec::new(),
        mask: None,
        backend: "none".to_owned(),
        revision,
        stroke_open: false,
    })
}

/// Files of the window and the simulated worker.
pub(super) struct Bench {
    files: Option<Files>,
    home: Home,
    preferences: Preferences,
    tools: Tools,
    pub(super) canvas: Arc<Document>,
    pub(super) palette: Arc<Document>,
    pub(super) brushes: Arc<Vec<KeptBrush>>,
    pub(super) painting: Arc<PaintingState>,
    events: Vec<Event>,
    requests: Vec<FileRequest>,
    /// The recording so far, if it does not start with a blank canvas.
    pub(super) recorded: Option<StrokeScript>,
    /// Whether answers with a snapshot wait until you clear this.
    pub(super) holds_snapshots: bool,
    /// Commands received, except requests for documents.
    pub(super) commands: Vec<Command>,
}

impl Bench {
    pub(super) fn files(&mut self) -> &mut Files {
        self.files.as_mut().unwrap()
    }

    fn frame(&mut self, ui: &mut eframe::egui::Ui) {
        let files = self.files.get_or_insert_with(|| {
            Files::new(ui.ctx(), self.home.clone(), self.preferences.clone())
        });
        let holds = self.holds_snapshots;
        for event in
            self.events.extract_if(.., |event| !(holds && matches!(event, Event::Snapshot(_))))
        {
            files.handle_event(&event);
        }
        for request in self.requests.drain(..) {
            files.request(request, &self.painting);
        }
        let commands = files.update(ui.ctx());
        let mut requests = Vec::new();
        let painting = self.painting.clone();
        let mut cx =
            PanelContext { painting: &painting, tools: &mut self.tools, requests: &mut requests };
        ui.add_space(ui.available_height() - 340.0);
        history::show(ui, &mut cx, &files.revisions);
        files.show(ui);
        for request in requests {
            if let Request::File(request) = request {
                self.requests.push(request);
            }
        }
        for command in commands {
            self.carry_out(command);
        }
    }

    fn carry_out(&mut self, command: Command) {
        match &command {
            Command::Snapshot(number) => {
                return self.events.push(Event::Snapshot(Snapshot {
                    number: *number,
                    canvas: self.canvas.clone(),
                    palette: self.palette.clone(),
                    brushes: self.brushes.clone(),
                    revision: self.painting.revision,
                }));
            }
            Command::Keep { number, recorded } => {
                let mut header = self.script();
                let actions = header.actions.split_off(*recorded);
                header.actions.clear();
                let canvas = self.canvas.clone();
                let palette = self.palette.clone();
                let number = *number;
                let revision = self.painting.revision;
                let brushes = self.brushes.clone();
                let snapshot = Snapshot { number, canvas, palette, brushes, revision };
                let tail = RecordingTail { header, from: *recorded, actions, open: None };
                let recording = Some(tail);
                let brushes = Vec::new();
                let kept = KeptPainting { snapshot, recording, brushes, mask: None };
                return self.events.push(Event::Kept(Arc::new(kept)));
            }
            Command::Recording(number) => {
                return self
                    .events
                    .push(Event::Recording { number: *number, script: Arc::new(self.script()) });
            }
            Command::Open(Origin::Painting(document)) => {
                self.canvas = Arc::new((**document).clone());
            }
            Command::Open(Origin::WithTable { canvas, table }) => {
                self.canvas = Arc::new((**canvas).clone());
                self.palette = Arc::new(table.palette.clone());
                self.brushes = Arc::new(table.brushes.clone());
            }
            Command::Open(Origin::Recovered { canvas, palette, .. }) => {
                self.canvas = Arc::new((**canvas).clone());
                self.palette = Arc::new((**palette).clone());
            }
            _ => {}
        }
        if let Command::Open(_) | Command::Replay { .. } = &command {
            self.painting = painting(&self.canvas, self.painting.revision + 1);
            self.events.push(Event::Opened(self.painting.clone()));
        }
        self.commands.push(command);
    }

    /// Recording that the worker would return.
    pub(super) fn script(&self) -> StrokeScript {
        if let Some(script) = &self.recorded {
            return script.clone();
        }
        let Origin::Blank { script, .. } =
            blank_canvas(PigmentLibrary::van_gogh_oils(), 24.0, 16.0, 0.2)
        else {
            panic!("a bare canvas");
        };
        *script
    }
}

/// A window that contains the bench.
pub(super) type Window = Harness<'static, Bench>;

/// Opens a window on `document` with its home folder in `home`.
pub(super) fn window(home: &Path, document: Document) -> Window {
    let preferences = Preferences {
        autosave_seconds: 2,
        last_folder: Some(home.to_owned()),
        ..Preferences::default()
    };
    let painting = painting(&document, 1);
    let canvas = Arc::new(document);
    let bench = Bench {
        files: None,
        home: Home::in_folder(&home.join("own")),
        preferences,
        tools: Tools::default(),
        palette: canvas.clone(),
        brushes: Arc::new(brushes(&canvas)),
        canvas,
        events: vec![Event::Opened(painting.clone())],
        painting,
        requests: Vec::new(),
        recorded: None,
        holds_snapshots: false,
        commands: Vec::new(),
    };
    let builder = Harness::builder().with_size([1000.0, 760.0]).wgpu();
    let builder = builder.with_context_setup(theme::apply);
    let mut window = builder.build_ui_state(|ui, bench: &mut Bench| bench.frame(ui), bench);
    window.step();
    window.step();
    window
}

pub(super) fn until(window: &mut Window, what: &str, mut done: impl FnMut(&mut Window) -> bool) {
    let start = Instant::now();
    while !done(window) {
        assert!(start.elapsed() < Duration::from_secs(30), "waited for {what}");
        std::thread::sleep(Duration::from_millis(3));
        window.step();
    }
    window.step();
    window.step();
}

pub(super) fn ask(window: &mut Window, request: FileRequest) {
    window.state_mut().requests.push(request);
    for _ in 0..4 {
        window.step();
    }
}

/// Simulates a change of the painting.
pub(super) fn change(window: &mut Window) {
    let bench = window.state_mut();
    let mut canvas = (*bench.canvas).clone();
    canvas.wet.vehicle.values_mut()[7] += 1;
    bench.canvas = Arc::new(canvas);
    let mut painting = (*bench.painting).clone();
    painting.revision += 1;
    bench.painting = Arc::new(painting);
    let event = Event::State(bench.painting.clone());
    bench.events.push(event);
    window.step();
}

pub(super) fn shows(window: &Window, label: &str) -> bool {
    window.query_all_by_label_contains(label).next().is_some()
}

pub(super) fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    // If this opens a dialog, the following frames lay it out.
    window.run_steps(4);
}

pub(super) fn type_name(window: &mut Window, name: &str) {
    let field = window.get_all_by_role(eframe::egui::accesskit::Role::TextInput).last().unwrap();
    field.focus();
    window.step();
    let ctrl = eframe::egui::Modifiers::COMMAND;
    window.key_press_modifiers(ctrl, eframe::egui::Key::A);
    window.step();
    let field = window.get_all_by_role(eframe::egui::accesskit::Role::TextInput).last().unwrap();
    field.type_text(name);
    window.step();
}

/// If you set the environment variable `IMPASTO_PICTURES`, this renders the window and keeps the
/// picture.
pub(super) fn picture(window: &mut Window, name: &str) {
    if std::env::var_os("IMPASTO_PICTURES").is_some() {
        keep(&window.render().unwrap(), &format!("files-{name}"));
    }
}

pub(super) fn document(path: &Path) -> Document {
    paint::file::read("test", &std::fs::read(path).unwrap()).unwrap()
}

/// A temporary folder and the path of a painting in it.
pub(super) fn folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.exr");
    (folder, path)
}

/// Saves the painting as `path` with the dialog.
pub(super) fn save_as(window: &mut Window, path: &Path) {
    ask(window, FileRequest::SaveAs);
    type_name(window, path.file_stem().unwrap().to_str().unwrap());
    click(window, "Save");
    until(window, "the file", |window| window.state_mut().files().path() == Some(path));
}
