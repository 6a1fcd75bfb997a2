//! A window with one panel and a fixed painting.

use eframe::egui::{Frame, Margin, Pos2, Ui, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use paint::layer::SLOTS;
use session::{BrushState, Command, HistoryShots, PaintingState};
use studio::panels::{FileRequest, PanelContext, Request, Tools};
use studio::theme;

use super::fixture::painting;
use super::harness::{has_adapter, keep};

/// A panel with its context and its requests.
pub(crate) struct PanelState<P> {
    pub(crate) panel: P,
    pub(crate) painting: PaintingState,
    pub(crate) tools: Tools,
    pub(crate) requests: Vec<Request>,
}

/// A panel under test.
pub(crate) struct PanelWindow<P: 'static> {
    pub(crate) harness: Harness<'static, PanelState<P>>,
}

impl<P> PanelWindow<P> {
    /// Creates a window of `size` points in which `show` draws `panel`.
    pub(crate) fn new(
        panel: P,
        size: Vec2,
        painting: PaintingState,
        mut show: impl FnMut(&mut P, &mut Ui, &mut PanelContext<'_>) + 'static,
    ) -> Self {
        let scene = PanelState { panel, painting, tools: Tools::default(), requests: Vec::new() };
        let mut harness = Harness::builder()
            .with_size(size)
            .with_pixels_per_point(2.0)
            .with_step_dt(1.0 / 60.0)
            .with_max_steps(60)
            .with_render_cursor(false)
            .with_context_setup(theme::apply)
            .build_ui_state(
                move |ui, scene: &mut PanelState<P>| {
                    let PanelState { panel, painting, tools, requests } = scene;
                    let mut cx = PanelContext { painting, tools, requests };
                    let frame = Frame::new().fill(theme::DARK.panel).inner_margin(Margin::same(10));
                    frame.show(ui, |ui| {
                        ui.take_available_space();
                        show(panel, ui, &mut cx);
                        let used = ui.min_rect().width();
                        let given = ui.max_rect().width();
                        assert!(used <= given + 0.5, "{used} points wide, of {given}");
                    });
                },
                scene,
            );
        harness.run_ok();
        Self { harness }
    }

    pub(crate) fn state(&mut self) -> &mut PanelState<P> {
        self.harness.state_mut()
    }

    /// Clicks the control with this label.
    pub(crate) fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.run();
    }

    /// Draws frames until nothing changes.
    pub(crate) fn run(&mut self) {
        self.harness.step();
        self.harness.run_ok();
    }

    /// Draws frames for `seconds` of the harness's clock.
    pub(crate) fn wait(&mut self, seconds: f64) {
        self.harness.run_steps((seconds * 60.0).ceil() as usize);
    }

    /// Drags the mouse with the primary button, one frame for each position.
    pub(crate) fn drag(&mut self, along: &[Pos2]) {
        self.harness.hover_at(along[0]);
        self.harness.drag_at(along[0]);
        self.harness.step();
        for &place in &along[1..] {
            self.harness.hover_at(place);
            self.harness.step();
        }
        self.harness.drop_at(along[along.len() - 1]);
        self.run();
    }

    /// Commands for the worker since the last call.
    pub(crate) fn commands(&mut self) -> Vec<Command> {
        let requests = std::mem::take(&mut self.state().requests);
        let commands = requests.into_iter().map(|request| match request {
            Request::Worker(command) => command,
            Request::File(request) => panic!("unexpected file request: {request:?}"),
        });
        commands.collect()
    }

    /// File requests since the last call.
    pub(crate) fn requests(&mut self) -> Vec<FileRequest> {
        let requests = std::mem::take(&mut self.state().requests);
        let requests = requests.into_iter().map(|request| match request {
            Request::File(request) => request,
            Request::Worker(command) => panic!("unexpected command: {command:?}"),
        });
        requests.collect()
    }

    /// Renders the panel if there is an adapter, and keeps the picture.
    pub(crate) fn save(&mut self, name: &str) {
        if !has_adapter() {
            return;
        }
        let picture = self.harness.render().expect("the panel is drawn");
        keep(&picture, name);
    }
}

/// A blank canvas of 1920 x 1080 cells with Van Gogh's oils and a clean round brush.
pub(crate) fn made_painting() -> PaintingState {
    let made = painting();
    let mut slots = [None; SLOTS];
    for (slot, pigment) in slots.iter_mut().zip(&TUBES) {
        *slot = Some(made.library.find(pigment).expect("one of Van Gogh's"));
    }
    let round = BrushState {
        amount_mm: 0.0,
        tip_mm: 0.0,
        vehicle: 0.0,
        parts: [0.0; SLOTS],
        color: None,
        swatch: None,
        ..made.brushes[0].clone()
    };
    PaintingState {
        canvas_cells: (1920, 1080),
        palette_cells: (640, 420),
        slots,
        masstones: [None; SLOTS],
        tints: [None; SLOTS],
        layers: Vec::new(),
        history: Vec::new(),
        history_done: 0,
        history_shots: HistoryShots::default(),
        brushes: vec![round],
        ..made
    }
}

/// Pigments on the palette: six, with two free slots.
const TUBES: [&str; 6] =
    ["Zinc White", "Chrome Yellow", "Vermilion", "Ultramarine", "Prussian Blue", "Bone Black"];
