//! Tests of tube, brush, layer and history panels with a real worker: typical working steps and
//! the paint and layers that result.

use std::sync::Arc;

use eframe::egui::accesskit::Role;
use eframe::egui::{UiBuilder, Vec2, pos2, vec2};
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
use web_time::{Duration, Instant};

use super::harness::{has_adapter, keep};

const PATIENCE: Duration = Duration::from_secs(60);

/// Four panels side by side, with a worker.
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

    /// Waits until the reported painting satisfies `is`. The first report may come before the
    /// worker has measured everything.
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

    /// Clicks a row of a list, even if you must scroll to see it.
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

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.01
}

#[test]
fn paint_is_squeezed_mixed_and_picked_up() {
    let mut painter = Painter::new();
    painter.click("tube of Chrome Yellow");
    painter.squeeze(SurfaceId::Palette, 20.0, 20.0);
    painter.click("tube of Ultramarine");
    painter.squeeze(SurfaceId::Palette, 34.0, 20.0);
    painter.wait_until("two heaps", |painting| painting.history.len() == 2);
    painter.click("knife");
    assert_eq!(painter.brush("knife").amount_mm, 0.0);
    for y_mm in [18.0, 20.0, 22.0] {
        painter.stroke(SurfaceId::Palette, (14.0, y_mm), (40.0, y_mm));
        painter.stroke(SurfaceId::Palette, (40.0, y_mm), (14.0, y_mm));
    }
    painter.wait_until("six strokes more", |painting| {
        painting.history.len() == 8 && !painting.stroke_open
    });
    let knife = painter.wait_until_brush("knife", |knife| knife.amount_mm > 0.0);
    let both = [painter.part("knife", "Chrome Yellow"), painter.part("knife", "Ultramarine")];
    assert!(both[0] > 0.02 && both[1] > 0.02, "both are on the knife: {both:?}, {knife:?}");
    assert!((both[0] + both[1] - 1.0).abs() < 1e-9, "no other pigment: {both:?}");
    painter.click("Wash");
    painter.wait_until_brush("knife", |knife| knife.amount_mm == 0.0);
    assert_eq!(painter.harness.state().messages, []);
}

#[test]
fn a_brush_is_loaded_thinned_wiped_duplicated_and_resized() {
    let mut painter = Painter::new();
    painter.harness.state_mut().tools.tube = 3;
    painter.harness.run();
    painter.slide("Medium", 20.0);
    painter.click("Load from tube");
    let is = |mm, share| {
        move |brush: &BrushState| near(brush.amount_mm, mm) && near(brush.vehicle, share)
    };
    painter.wait_until_brush("round", is(0.3, 0.2));
    assert_eq!(painter.part("round", "Vermilion"), 1.0);
    painter.click("Medium only");
    painter.wait_until_brush("round", is(0.6, 0.6));

    // A larger head keeps the paint.
    painter.slide("Size", 9.0);
    let larger =
        painter.wait_until_brush("round", |brush| brush.spec.size_mm == 9.0 && is(0.6, 0.6)(brush));
    painter.slide("Wipe to", 50.0);
    painter.click("Wipe");
    let wiped = painter.wait_until_brush("round", is(0.3, 0.6));

    painter.click("Keep");
    assert_eq!(painter.harness.state().tools.brush, "round 2");
    let twin = painter.wait_until_brush("round 2", |twin| twin.amount_mm == 0.0);
    assert_eq!(twin.spec, larger.spec);
    assert_eq!(painter.brush("round"), wiped, "the original brush keeps its paint");
    assert_eq!(painter.harness.state().messages, []);
}

#[test]
fn dried_layers_are_dimmed_merged_and_undone() {
    let mut painter = Painter::new();
    painter.click("tube of Vermilion");
    painter.click("Load brush");
    let loaded = painter.wait_until_brush("round", |brush| near(brush.amount_mm, 0.3));
    painter.stroke(SurfaceId::Canvas, (6.0, 6.0), (26.0, 12.0));
    painter.wait_until_brush("round", |brush| brush.amount_mm < loaded.amount_mm);
    painter.slide("Share", 50.0);
    painter.click("Dry share");
    painter.click("Dry all");
    let painting = painter.wait_until("two layers, measured", |painting| {
        painting.layers.len() == 2 && painting.layers.iter().all(|layer| layer.mean_mm > 0.0)
    });
    for layer in &painting.layers {
        assert!(layer.mean_mm <= layer.max_mm, "{layer:?}");
        assert!((0.01..0.6).contains(&layer.coverage), "{}", layer.coverage);
    }
    painter.save("painter");

    // A drag is one action with its final value.
    let before = painting.history.len();
    let rail = painter.harness.get_by_role_and_label(Role::Slider, "opacity of Layer 1");
    let start = rail.rect().left_center() + vec2(30.0, 0.0);
    painter.harness.hover_at(start);
    painter.harness.drag_at(start);
    painter.harness.run();
    for step in 1..6_u8 {
        painter.harness.hover_at(start + vec2(6.0 * f32::from(step), 0.0));
        painter.harness.run();
        std::thread::sleep(Duration::from_millis(20));
    }
    painter.harness.drop_at(start + vec2(30.0, 0.0));
    painter.settle();
    let dimmed = painter.wait_until("one action", |painting| painting.history.len() == before + 1);
    let opacity = dimmed.layers[0].opacity;
    assert!(opacity != 1.0 && opacity > 0.0, "{opacity}");

    painter.click("visibility of Layer 1");
    let hidden = painter.wait_until("hidden", |painting| !painting.layers[0].visible);
    assert_eq!(hidden.layers[0].opacity, opacity, "hiding leaves the opacity");
    painter.click("visibility of Layer 1");
    painter.wait_until("shown", |painting| painting.layers[0].visible);

    for _ in 0..3 {
        painter.click("Undo");
    }
    painter.wait_until("as before the drag", |painting| {
        painting.history_done == before && painting.layers[0].opacity == 1.0
    });
    painter.click("menu of Layer 2");
    painter.click("Merge down");
    let both = painting.layers[0].mean_mm + painting.layers[1].mean_mm;
    let is_merged = |painting: &PaintingState| {
        painting.layers.len() == 1 && (painting.layers[0].mean_mm / both - 1.0).abs() < 0.05
    };
    let merged = painter.wait_until("one layer as high as both", is_merged);

    let history = merged.history.clone();
    painter.click("0 beginning");
    painter.wait_until("bare", |painting| painting.history_done == 0 && painting.layers.is_empty());
    assert_eq!(painter.brush("round"), loaded, "as before the stroke");
    painter.click(&format!("{} {}", history.len(), history[history.len() - 1]));
    let again = painter.wait_until("all done again", |painting| {
        painting.history_done == history.len() && is_merged(painting)
    });
    assert_eq!(again.history, history);
    assert_eq!(again.layers[0].mean_mm, merged.layers[0].mean_mm);
    assert_eq!(again.brushes, merged.brushes);
    assert_eq!(painter.harness.state().messages, []);
}

#[test]
fn tubes_change_without_wet_paint_and_exchange_in_the_painting() {
    let mut painter = Painter::new();
    painter.click("tube of Vermilion");
    painter.click("Load brush");
    painter.stroke(SurfaceId::Canvas, (6.0, 6.0), (26.0, 12.0));
    painter.wait_until("a stroke", |painting| painting.history.len() == 1);

    // You cannot change a slot while its paint is wet.
    let slots = painter.painting().slots;
    painter.click("Tubes...");
    painter.click("slot 4");
    painter.choose("Cobalt Blue");
    let start = Instant::now();
    while painter.harness.state().messages.is_empty() {
        assert!(start.elapsed() < PATIENCE, "no message");
        painter.settle();
    }
    let (text, hint) = painter.harness.state_mut().messages.pop().unwrap();
    assert!(text.contains("Vermilion") && hint.is_some(), "{text}, {hint:?}");
    assert_eq!(painter.painting().slots, slots, "the slot is unchanged");

    // You can change another slot.
    painter.click("slot 5");
    painter.choose("Cobalt Blue");
    let mut wanted = slots;
    wanted[4] = Some(painter.painting().library.find("Cobalt Blue").unwrap());
    painter.wait_until("Cobalt Blue in slot 5", |painting| painting.slots == wanted);
    painter.click("Close window");

    // This exchanges the pigment in the painting, wet and dry.
    painter.slide("Share", 50.0);
    painter.click("Dry share");
    painter.wait_until("a dry layer", |painting| painting.layers.len() == 1);
    painter.harness.get_by_label("tube of Vermilion").click_secondary();
    painter.harness.run();
    painter.click("Exchange in the painting...");
    painter.choose("Minium");
    let minium = Some(painter.painting().library.find("Minium").unwrap());
    painter.wait_until("Minium, wet and dry", |painting| {
        painting.slots[3] == minium && painting.layers[0].slots[3] == minium
    });
    assert_eq!(painter.harness.state().messages, []);
}
