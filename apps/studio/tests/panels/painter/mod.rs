//! Tests of tube, brush, layer and history panels with a real worker.

use std::sync::Arc;
use web_time::{Duration, Instant};

use eframe::egui::{UiBuilder, Vec2, accesskit::Role, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use graphics::gpu::BackendChoice;
use paint::pose::Sample;
use paint::strokes::{SampleDecimals, SurfaceId};
use pigment::library::PigmentLibrary;
use session::{
    BrushState, Command, Event, PaintingState, PenSample, Worker, WorkerOptions, blank_canvas,
};
use studio::panels::brushes::Brushes;
use studio::panels::history::History;
use studio::panels::layers::Layers;
use studio::panels::tubes::{Tubes, squeeze};
use studio::panels::{PanelContext, Request, Tools};
use studio::theme;

use super::harness::{has_adapter, keep};

mod tests;

/// Time limit of every wait.
const PATIENCE: Duration = Duration::from_secs(60);

/// Four panels side by side, and a worker.
struct Studio {
    worker: Worker,
    painting: Option<Arc<PaintingState>>,
    tools: Tools,
    requests: Vec<Request>,
    messages: Vec<(String, Option<String>)>,
    answered: u64,
    panels: (Tubes, Brushes, Layers, History),
}

impl Studio {
    fn new() -> Self {
        let options = WorkerOptions { backend: BackendChoice::Cpu, ..WorkerOptions::default() };
        let worker = Worker::start(options, || {});
        worker.ask(Command::Open(blank_canvas(PigmentLibrary::van_gogh_oils(), 32.0, 20.0, 0.1)));
        Self {
            worker,
            painting: None,
            tools: Tools::default(),
            requests: Vec::new(),
            messages: Vec::new(),
            answered: 0,
            panels: Default::default(),
        }
    }

    fn listen(&mut self) {
        for event in self.worker.events() {
            match event {
                Event::Opened(state) | Event::State(state) => self.painting = Some(state),
                Event::Recording { number, .. } => self.answered = number,
                Event::Message { text, hint, .. } => {
                    self.messages.push((text, hint.map(|hint| hint.to_string())));
                }
                _ => {}
            }
        }
    }

    fn ui(&mut self, ui: &mut eframe::egui::Ui) {
        self.listen();
        let Some(painting) = self.painting.clone() else { return };
        let Self { tools, requests, panels, .. } = self;
        let mut cx = PanelContext { painting: &painting, tools, requests };
        ui.painter().rect_filled(ui.max_rect(), 0.0, theme::DARK.panel);
        for column in 0..4_u8 {
            let corner = pos2(8.0 + f32::from(column) * theme::PANEL_WIDTH, 8.0);
            let room = eframe::egui::Rect::from_min_size(
                corner,
                vec2(theme::PANEL_WIDTH - 16.0, ui.max_rect().height() - 16.0),
            );
            ui.scope_builder(UiBuilder::new().max_rect(room), |ui| match column {
                0 => panels.0.show(ui, &mut cx),
                1 => panels.1.show(ui, &mut cx),
                2 => panels.2.show(ui, &mut cx),
                _ => panels.3.show(ui, &mut cx),
            });
        }
        for request in std::mem::take(&mut self.requests) {
            match request {
                Request::Worker(command) => self.worker.ask(command),
                Request::File(request) => panic!("unexpected file request: {request:?}"),
            }
        }
    }
}

/// A simulated painter who operates the panels.
struct Painter {
    harness: Harness<'static, Studio>,
    fences: u64,
}

impl Painter {
    fn new() -> Self {
        let harness = Harness::builder()
            .with_size(Vec2::new(4.0 * theme::PANEL_WIDTH, 720.0))
            .with_step_dt(1.0 / 60.0)
            .with_max_steps(60)
            .with_context_setup(theme::apply)
            .build_ui_state(|ui, studio: &mut Studio| studio.ui(ui), Studio::new());
        let mut painter = Self { harness, fences: 0 };
        painter.settle();
        painter
    }

    /// Waits until the worker has executed all commands.
    fn settle(&mut self) {
        self.harness.step();
        self.fences += 1;
        self.harness.state().worker.ask(Command::Recording(self.fences));
        let start = Instant::now();
        loop {
            self.harness.step();
            let studio = self.harness.state();
            if studio.answered == self.fences && studio.painting.is_some() {
                break;
            }
            assert!(start.elapsed() < PATIENCE, "the worker does not answer");
            std::thread::sleep(Duration::from_millis(2));
        }
        self.harness.run();
    }

    /// Waits until the reported painting satisfies `is`. The worker answers before it
    /// has measured everything.
    #[track_caller]
    fn wait_until(
        &mut self,
        what: &str,
        is: impl Fn(&PaintingState) -> bool,
    ) -> Arc<PaintingState> {
        let start = Instant::now();
        loop {
            self.harness.step();
            let painting = self.painting();
            if is(&painting) {
                self.harness.run();
                return painting;
            }
            assert!(start.elapsed() < PATIENCE, "not reported: {what}; found {painting:?}");
            std::thread::sleep(Duration::from_millis(3));
        }
    }

    /// Waits until the reported state of a brush satisfies `is`.
    #[track_caller]
    fn wait_until_brush(&mut self, name: &str, is: impl Fn(&BrushState) -> bool) -> BrushState {
        self.wait_until(name, |painting| {
            painting.brushes.iter().any(|brush| brush.name == name && is(brush))
        });
        self.brush(name)
    }

    fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.harness.run();
        self.settle();
    }

    /// Clicks a row of a list, even if it is scrolled out of view.
    fn choose(&mut self, label: &str) {
        self.harness.get_by_label(label).click_accesskit();
        self.harness.run();
        self.settle();
    }

    fn slide(&mut self, label: &str, value: f64) {
        let slider = self.harness.get_by_role_and_label(Role::Slider, label);
        slider.set_value_accesskit(value);
        self.harness.run();
        self.settle();
    }

    /// Squeezes the selected tube.
    fn squeeze(&mut self, on: SurfaceId, x_mm: f64, y_mm: f64) {
        let Studio { painting, tools, requests, .. } = self.harness.state_mut();
        let painting = painting.clone().unwrap();
        let slot = tools.tube;
        squeeze(&mut PanelContext { painting: &painting, tools, requests }, slot, on, x_mm, y_mm);
        self.settle();
    }

    /// Paints a line with the selected brush, at 200 samples per second and 50 mm/s.
    fn stroke(&mut self, surface: SurfaceId, from: (f64, f64), to: (f64, f64)) {
        let studio = self.harness.state();
        let brush = studio.tools.brush.clone();
        studio.worker.ask(Command::PenDown { surface, brush, decimals: SampleDecimals::RECORDING });
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        let count = (length / 50.0 * 200.0).ceil() as u32;
        for index in 0..=count {
            let along = f64::from(index) / f64::from(count);
            let sample = Sample {
                seconds: f64::from(index) / 200.0,
                x_mm: from.0 + along * (to.0 - from.0),
                y_mm: from.1 + along * (to.1 - from.1),
                pressure: 0.5,
                tilt_x_deg: 20.0,
                tilt_y_deg: 10.0,
                twist_deg: 0.0,
            };
            let sample = PenSample { sample, arrived: Instant::now() };
            studio.worker.ask(Command::PenMove(vec![sample]));
        }
        studio.worker.ask(Command::PenUp);
        self.settle();
    }

    fn painting(&self) -> Arc<PaintingState> {
        self.harness.state().painting.clone().unwrap()
    }

    fn brush(&self, name: &str) -> BrushState {
        let painting = self.painting();
        painting.brushes.iter().find(|brush| brush.name == name).unwrap().clone()
    }

    /// Share of a pigment in the paint of a brush.
    fn part(&self, brush: &str, pigment: &str) -> f64 {
        let painting = self.painting();
        let index = painting.library.find(pigment).unwrap();
        let slot = painting.slots.iter().position(|slot| *slot == Some(index)).unwrap();
        self.brush(brush).parts[slot]
    }

    fn save(&mut self, name: &str) {
        if has_adapter() {
            let image = self.harness.render().unwrap();
            keep(&image, &format!("panel-{name}"));
        }
    }
}
