//! A test painting as a worker would report it, a window with a single panel, and what you see in
//! such a window.

use std::sync::{Arc, OnceLock};

use eframe::egui::accesskit::Action;
use eframe::egui::{self, Color32, Frame, FullOutput, Margin, Pos2, Rect, Role, Shape, Ui, Vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::{Harness, Node};
use paint::brush::HeadShape;
use paint::document::{LayerId, Lighting, Medium, Slots};
use paint::layer::SLOTS;
use paint::light::Light;
use paint::strokes::BrushSpec;
use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::palette::{Cards, Palette, Recipe, TINT_PARTS};
use session::{
    BrushState, BrushSwatch, Command, FilmColor, HistoryShot, HistoryShots, LayerState,
    PaintingState, Thumbnail,
};
use spectra::color::Lab;
use studio::panels::{FileRequest, PanelContext, Request, Tools};
use studio::theme;

use super::harness::{has_adapter, keep};

/// Pigments in the slots; the last slot is empty.
pub(crate) const PIGMENTS: [&str; 7] = [
    "Zinc White",
    "Chrome Yellow",
    "Vermilion",
    "Eosin Lake",
    "Ultramarine",
    "Viridian",
    "Bone Black",
];

/// State of a painting with seven tubes, three brushes, two dry layers and a history.
pub(crate) fn painting() -> PaintingState {
    static LIBRARY: OnceLock<(Arc<PigmentLibrary>, Arc<Light>)> = OnceLock::new();
    let (library, light) = LIBRARY.get_or_init(|| {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::new(&library, &Viewing::default()).unwrap());
        (library, light)
    });
    let mut slots: Slots = [None; SLOTS];
    for (slot, name) in slots.iter_mut().zip(PIGMENTS) {
        *slot = Some(library.find(name).unwrap());
    }
    let cards = Cards::standard(library.grid);
    let palette = Palette::new(library, &light.viewing, cards).unwrap();
    let srgb = |recipe: &Recipe| {
        let encoded = palette.color(recipe).srgb;
        encoded.0.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
    };
    PaintingState {
        title: "made".to_owned(),
        canvas_cells: (320, 200),
        palette_cells: (160, 120),
        cell_mm: 0.1,
        library: Arc::clone(library),
        slots,
        masstones: slots.map(|slot| Some(srgb(&Recipe::single(slot?)))),
        tints: slots.map(|slot| Some(srgb(&palette.tint(slot?, TINT_PARTS)))),
        layers: vec![layer(1, slots, 1.0), layer(2, slots, 0.5)],
        lighting: Lighting::default(),
        light: Arc::clone(light),
        second_lighting: None,
        medium: Medium::default(),
        ground_reflectance: Arc::new(vec![0.8; library.grid.count()]),
        history: ["load round", "stroke, round", "dry 50 %", "stroke, flat"]
            .map(str::to_owned)
            .to_vec(),
        history_done: 3,
        history_shots: shots(),
        undo_bytes: (96 << 20, 512 << 20),
        brushes: vec![
            brush("round", HeadShape::Round, 6.0, Some(srgb(&Recipe::single(slots[2].unwrap())))),
            brush("flat", HeadShape::Flat, 10.0, None),
            brush("knife", HeadShape::Knife, 14.0, None),
        ],
        mask: None,
        backend: "cpu".to_owned(),
        revision: 1,
        stroke_open: false,
    }
}

/// Pictures of the five states of the history, except the last but one. Each action changes a small
/// square.
fn shots() -> HistoryShots {
    fn shot(state: usize) -> HistoryShot {
        let picture = Thumbnail {
            width: 48,
            height: 30,
            pixels: (0..1440)
                .map(|index: usize| match (index % 48 < 12 * state, index / 48 < 12) {
                    (true, true) => [200, 40 * state as u8, 60, 255],
                    _ => [225, 222, 214, 255],
                })
                .collect(),
        };
        let changed = (state > 0).then(|| [12 * (state - 1), 0, 12, 12]);
        HistoryShot { picture: Arc::new(picture), changed }
    }
    let shots = (0..5).map(|state| (state != 3).then(|| shot(state))).collect();
    HistoryShots { shots, bytes: 3 << 20, most_bytes: 24 << 20 }
}

/// Swatch of a film in this colour that hides the ground in part.
fn swatch([r, g, b]: [u8; 3]) -> BrushSwatch {
    let color =
        |srgb: [u8; 3], lightness| FilmColor { lab: Lab { lightness, a: 52.1, b: 38.4 }, srgb };
    BrushSwatch {
        opaque: color([r, g, b], 47.2),
        ground: color([230, 228, 222], 91.0),
        over_ground: color([r, g / 2 + 60, b / 2 + 60], 55.0),
        cards: [color([63, 63, 63], 26.7), color([231, 231, 231], 91.7)],
        over_cards: [color([r / 2, g / 2, b / 2], 30.0), color([r, g, b / 2 + 80], 60.0)],
        contrast: 0.62,
        thickness_mm: 0.25,
    }
}

fn brush(name: &str, shape: HeadShape, size_mm: f64, color: Option<[u8; 3]>) -> BrushState {
    let mut parts = [0.0; SLOTS];
    parts[0] = 0.25;
    parts[2] = 0.75;
    let loaded = color.is_some();
    BrushState {
        name: name.to_owned(),
        spec: BrushSpec { shape, size_mm },
        amount_mm: if loaded { 0.4 } else { 0.0 },
        tip_mm: if loaded { 0.25 } else { 0.0 },
        most_load_mm: if loaded { 1.5 } else { f64::INFINITY },
        vehicle: if loaded { 0.2 } else { 0.0 },
        parts: if loaded { parts } else { [0.0; SLOTS] },
        color,
        swatch: color.map(|color| Box::new(swatch(color))),
    }
}

fn layer(id: u32, slots: Slots, opacity: f64) -> LayerState {
    let thumbnail = Thumbnail {
        width: 24,
        height: 15,
        pixels: (0..360).map(|index: usize| [(index * 7 % 256) as u8, 90, 60, 255]).collect(),
    };
    let thumbnail = Arc::new(thumbnail);
    LayerState {
        id: LayerId(id),
        name: String::new(),
        visible: true,
        slots,
        opacity,
        mean_mm: 0.123,
        max_mm: 0.81,
        coverage: 0.34,
        thumbnail,
    }
}

pub(crate) struct Fixture<P> {
    pub(crate) panel: P,
    pub(crate) painting: PaintingState,
    pub(crate) tools: Tools,
    pub(crate) requests: Vec<Request>,
}

impl<P> Fixture<P> {
    /// Calls `act` with the panel and its context, as a keyboard shortcut does.
    pub(crate) fn with_panel<T>(
        &mut self,
        act: impl FnOnce(&mut P, &mut PanelContext<'_>) -> T,
    ) -> T {
        let Self { panel, painting, tools, requests } = self;
        act(panel, &mut PanelContext { painting, tools, requests })
    }
}

/// Creates a window of the side panel's width that shows one panel.
pub(crate) fn show_panel<P: 'static>(
    panel: P,
    painting: PaintingState,
    show: impl Fn(&mut P, &mut Ui, &mut PanelContext<'_>) + 'static,
) -> Harness<'static, Fixture<P>> {
    let table = Fixture { panel, painting, tools: Tools::default(), requests: Vec::new() };
    let builder = Harness::builder()
        .with_size(Vec2::new(760.0, 700.0))
        .with_step_dt(1.0 / 60.0)
        .with_max_steps(60);
    let mut harness = builder.with_context_setup(theme::apply).build_ui_state(
        move |ui, table: &mut Fixture<P>| {
            let panel_fill = theme::colors(ui.ctx()).panel;
            ui.painter().rect_filled(ui.max_rect(), 0.0, panel_fill);
            let room = Rect::from_min_size(
                Pos2::new(8.0, 8.0),
                Vec2::new(theme::PANEL_WIDTH - 16.0, 680.0),
            );
            ui.scope_builder(egui::UiBuilder::new().max_rect(room), |ui| {
                let Fixture { panel, painting, tools, requests } = table;
                show(panel, ui, &mut PanelContext { painting, tools, requests });
            });
        },
        table,
    );
    harness.run();
    harness
}

pub(crate) fn click<P>(harness: &mut Harness<'_, Fixture<P>>, label: &str) {
    harness.get_by_label(label).click();
    harness.run();
}

/// Clicks a row of a list, even if you must scroll to see it.
pub(crate) fn click_row<P>(harness: &mut Harness<'_, Fixture<P>>, label: &str) {
    harness.get_by_label(label).click_accesskit();
    harness.run();
}

/// Whether the control with a label is disabled.
pub(crate) fn is_disabled<P>(harness: &Harness<'_, Fixture<P>>, label: &str) -> bool {
    harness.get_by_label(label).accesskit_node().is_disabled()
}

/// Asserts that the requests since the last call are `wanted`.
#[track_caller]
pub(crate) fn assert_requests<P>(harness: &mut Harness<'_, Fixture<P>>, wanted: &[Request]) {
    let requests = std::mem::take(&mut harness.state_mut().requests);
    assert_eq!(format!("{requests:#?}"), format!("{wanted:#?}"), "requests differ");
}

/// Renders the window and keeps the picture; `None` without a graphics adapter.
pub(crate) fn picture<P>(
    harness: &mut Harness<'_, Fixture<P>>,
    name: &str,
) -> Option<image::RgbaImage> {
    if !has_adapter() {
        return None;
    }
    let image = harness.render().unwrap();
    keep(&image, &format!("panel-{name}"));
    Some(image)
}

pub(crate) struct PanelState<P> {
    pub(crate) panel: P,
    pub(crate) painting: PaintingState,
    pub(crate) tools: Tools,
    pub(crate) requests: Vec<Request>,
}

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

    pub(crate) fn requests(&mut self) -> Vec<FileRequest> {
        let requests = std::mem::take(&mut self.state().requests);
        let requests = requests.into_iter().map(|request| match request {
            Request::File(request) => request,
            Request::Worker(command) => panic!("unexpected command: {command:?}"),
        });
        requests.collect()
    }

    /// Renders the panel if there is an adapter, and saves the picture if we keep pictures.
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

#[derive(Debug, Clone)]
pub(crate) struct SeenText {
    pub(crate) words: String,
    pub(crate) rect: Rect,
    /// The clip rectangle in which the text is drawn.
    pub(crate) clip: Rect,
    /// Translucent if the text is disabled.
    pub(crate) color: Color32,
    elided: bool,
}

impl SeenText {
    /// Whether a part of the text is missing at the right or at the left.
    pub(crate) fn is_cut(&self) -> bool {
        let beyond = self.rect.left() < self.clip.left() - 1.5
            || self.rect.right() > self.clip.right() + 1.5;
        self.is_seen() && (self.elided || beyond)
    }

    fn is_seen(&self) -> bool {
        !self.words.trim().is_empty()
            && self.clip.is_positive()
            && self.clip.y_range().intersects(self.rect.y_range())
            && self.clip.x_range().intersects(self.rect.x_range())
    }

    /// Whether you see all of the text: nothing is cut off or beyond its part of the window.
    pub(crate) fn is_wholly_seen(&self) -> bool {
        self.is_seen() && !self.is_cut() && self.clip.expand(1.0).contains_rect(self.rect)
    }
}

/// All text of a frame.
pub(crate) fn texts(output: &FullOutput) -> Vec<SeenText> {
    let mut found = Vec::new();
    for clipped in &output.shapes {
        collect(&clipped.shape, clipped.clip_rect, &mut found);
    }
    found
}

fn collect(shape: &Shape, clip: Rect, found: &mut Vec<SeenText>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, clip, found)),
        Shape::Text(text) => {
            let galley = &text.galley;
            let own = galley.job.sections.first().map_or(Color32::PLACEHOLDER, |s| s.format.color);
            let own = if own == Color32::PLACEHOLDER { text.fallback_color } else { own };
            let color = text.override_text_color.unwrap_or(own);
            found.push(SeenText {
                words: galley.text().to_owned(),
                rect: galley.rect.translate(text.pos.to_vec2()),
                clip,
                color: color.gamma_multiply(text.opacity_factor),
                elided: galley.elided,
            });
        }
        _ => {}
    }
}

/// Something that you click or drag with a finger.
#[derive(Debug, Clone)]
pub(crate) struct Target {
    pub(crate) name: String,
    pub(crate) size: Vec2,
    pub(crate) right: f32,
}

/// Everything below `root` that you can click, and all sliders.
pub(crate) fn targets(root: &Node<'_>) -> Vec<Target> {
    root.children_recursive()
        .filter(|node| {
            let inner = node.accesskit_node();
            // For fingers there are no scroll bars. You drag the content instead.
            let is_bar = inner.role() == Role::ScrollBar;
            let is_clicked = inner.data().supports_action(Action::Click);
            (is_clicked && !is_bar) || inner.role() == Role::Slider
        })
        .map(|node: Node<'_>| {
            let inner = node.accesskit_node();
            let name = inner.label().or(inner.value());
            let name = name.unwrap_or_else(|| format!("{:?} without a name", inner.role()));
            Target { name, size: node.rect().size(), right: node.rect().right() }
        })
        .collect()
}
