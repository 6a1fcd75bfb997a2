//! Parts of the brush panel: a row of the list, the icon of a head, the preview of its marks, the
//! swatch of its paint, and the settings of the tools that work wet paint.

use eframe::egui::{
    Align, Color32, ColorImage, Context, CornerRadius, Layout, Painter, Pos2, Rect, Response, Role,
    Sense, Shape, Slider, Stroke, StrokeKind, TextStyle, TextureHandle, TextureOptions, Ui,
    WidgetInfo, pos2, vec2,
};
use session::{BrushState, BrushSwatch, FilmColor, PaintingState};

use crate::language::{brush_label, english, tr, tr_format};
use crate::panels::controls::{
    between, button, fits_on_a_line, millimetres, named_button, percent, row, slider, text,
};
use crate::panels::{Mode, PanelContext};
use crate::theme;
use paint::brush::{ContactMark, HeadShape};
use paint::strokes::{Action, BrushSpec, LayerRef, MaskChange};

const HEIGHT: f32 = 31.0;

/// The bar is full at this height of paint, in mm.
const FULL_MM: f64 = 1.0;

/// Contents of the row of a brush. `state` is `None` until the worker has reported the brush.
pub(super) struct Row<'a> {
    pub(super) number: usize,
    pub(super) label: &'a str,
    pub(super) spec: &'a BrushSpec,
    pub(super) state: Option<&'a BrushState>,
    pub(super) is_selected: bool,
}

impl Row<'_> {
    pub(super) fn show(&self, ui: &mut Ui, painting: &PaintingState) -> Response {
        let label = brush_label(self.label);
        let response = row(ui, HEIGHT, &label, self.is_selected);
        let inner = response.rect.shrink2(vec2(6.0, 2.0));
        let faint = if self.is_selected {
            theme::colors(ui.ctx()).text
        } else {
            theme::colors(ui.ctx()).faint
        };
        if self.number <= 9 {
            let key = between(inner, inner.left(), inner.left() + 12.0);
            let number = self.number.to_string();
            text(ui, key, Align::Center, TextStyle::Small, faint, &number);
        }
        let color = self.state.and_then(|state| state.color);
        let icon_rect = between(inner, inner.left() + 18.0, inner.left() + 42.0);
        draw(ui.painter(), icon_rect, self.spec.shape, color);
        let words = between(inner, inner.left() + 50.0, inner.right() - 84.0);
        let strong = theme::colors(ui.ctx()).strong;
        let (name, below) = words.split_top_bottom_at_fraction(0.55);
        if fits_on_a_line(ui, name, TextStyle::Body, &label) {
            text(ui, name, Align::Min, TextStyle::Body, strong, &label);
            let kind = format!("{} {}", tr(self.spec.shape.name()), millimetres(self.spec.size_mm));
            text(ui, below, Align::Min, TextStyle::Small, faint, &kind);
        } else {
            // A long name takes the room of shape and size. You find these in the tooltip.
            text(ui, words, Align::Min, TextStyle::Body, strong, &label);
        }
        let (amount, bar) =
            between(inner, inner.right() - 78.0, inner.right()).split_top_bottom_at_fraction(0.6);
        let amount_text = match self.state {
            Some(state) if state.amount_mm > 0.0 => millimetres(state.tip_mm),
            _ => tr("clean").to_owned(),
        };
        text(ui, amount, Align::Max, TextStyle::Small, faint, &amount_text);
        if let Some(state) = self.state {
            paint_bar(ui.painter(), bar.shrink2(vec2(0.0, 2.5)), state);
        }
        response.on_hover_text(self.tooltip(painting))
    }

    fn tooltip(&self, painting: &PaintingState) -> String {
        let BrushSpec { shape, size_mm } = self.spec;
        let cells = size_mm / painting.cell_mm;
        let head = tr_format!(
            "{shape}, {size} ({cells:.0} cells)",
            shape = tr(shape.name()),
            size = millimetres(*size_mm),
            cells
        );
        match self.state {
            Some(state) if state.amount_mm > 0.0 => format!("{head}\n{}", paint(painting, state)),
            _ => tr_format!("{head}\nclean", head),
        }
    }
}

/// Describes the paint on a brush, e.g. `0.12 mm at the tip, 0.30 mm in all, 15 % medium: ..`.
fn paint(painting: &PaintingState, state: &BrushState) -> String {
    let tip = millimetres(state.tip_mm);
    let mut words =
        tr_format!("{tip} at the tip, {amount} in all", tip, amount = millimetres(state.amount_mm));
    if state.vehicle > 0.0 {
        words += &tr_format!(", {vehicle:.0} % medium", vehicle = 100.0 * state.vehicle);
    }
    let parts = painting.slots.iter().zip(state.parts).filter_map(|(slot, part)| {
        let name = &painting.library[(*slot)?].name;
        (part >= 0.005).then(|| format!("{:.0} % {name}", 100.0 * part))
    });
    let parts: Vec<String> = parts.collect();
    if parts.is_empty() { words } else { format!("{words}: {}", parts.join(", ")) }
}

/// Draws a bar of the amount of paint at the tip: pigment in its colour, then medium in grey.
fn paint_bar(painter: &Painter, bar: Rect, state: &BrushState) {
    painter.rect_filled(bar, 2.0, theme::colors(painter.ctx()).well);
    let filled = (state.tip_mm / FULL_MM).clamp(0.0, 1.0) as f32;
    let (paint, _) = bar.split_left_right_at_fraction(filled);
    let (pigment, medium) = paint.split_left_right_at_fraction(1.0 - state.vehicle as f32);
    painter.rect_filled(medium, 0.0, Color32::from_gray(176));
    if let Some([red, green, blue]) = state.color {
        painter.rect_filled(pigment, 0.0, Color32::from_rgb(red, green, blue));
    }
}

/// Names and pressures of the marks that the preview shows.
const PRESSURES: [(&str, f64); 3] =
    [(english("light"), 0.15), (english("middle"), 0.5), (english("full"), 1.0)];

/// Number of cells along a head in the preview, at most. You would not see more.
const FINEST: f64 = 64.0;

const TIP_HEIGHT: f32 = 54.0;

const LABEL: f32 = 15.0;

/// The marks of one head. We compute them once.
#[derive(Clone, Default)]
pub(super) struct TipPreview {
    shown: Option<(BrushSpec, Vec<Mark>)>,
}

/// A mark with its texture. Its pixels are white where the hair touches.
#[derive(Clone)]
struct Mark {
    size_mm: [f64; 2],
    texture: Option<TextureHandle>,
}

impl std::fmt::Debug for TipPreview {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("TipPreview").field(&self.shown.as_ref().map(|shown| &shown.0)).finish()
    }
}

impl TipPreview {
    /// Draws the three marks to the same scale, as large as the space allows.
    pub(super) fn show(&mut self, ui: &mut Ui, spec: &BrushSpec) {
        if self.shown.as_ref().is_none_or(|(shown, _)| shown != spec) {
            self.shown = Some((spec.clone(), marks(ui.ctx(), spec)));
        }
        let Some((_, marks)) = &self.shown else { return };
        let size = vec2(ui.available_width(), TIP_HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, tr("Marks of the tip")));
        let colors = theme::colors(ui.ctx());
        ui.painter().rect_filled(rect, theme::CORNER_RADIUS, colors.well);
        let field = vec2(rect.width() / PRESSURES.len() as f32, rect.height());
        let room = vec2(field.x - 12.0, field.y - LABEL - 10.0);
        let [widest, highest] = [0, 1].map(|axis: usize| {
            marks.iter().map(|mark| mark.size_mm[axis]).fold(f64::MIN_POSITIVE, f64::max) as f32
        });
        let points_per_mm = (room.x / widest).min(room.y / highest);
        for (at, ((name, _), mark)) in PRESSURES.iter().zip(marks).enumerate() {
            let left = rect.left() + at as f32 * field.x;
            let whole = Rect::from_min_size(pos2(left, rect.top()), field);
            let (upper, label) = whole.split_top_bottom_at_y(whole.bottom() - LABEL - 2.0);
            let [width, height] = mark.size_mm.map(|mm| mm as f32 * points_per_mm);
            let place = Rect::from_center_size(upper.center(), vec2(width, height));
            if let Some(texture) = &mark.texture {
                let all = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                ui.painter().image(texture.id(), place, all, colors.text);
            }
            let words = format!("{} {}", tr(name), millimetres(mark.size_mm[0]));
            text(
                ui,
                label.shrink2(vec2(2.0, 0.0)),
                Align::Center,
                TextStyle::Small,
                colors.faint,
                &words,
            );
        }
        response.on_hover_text(tr(
            "Where the upright head touches a plane at light, middle and full pressure, all to one \
             scale, and how wide that is",
        ));
    }
}

/// The marks of a head at all pressures, or none if the head cannot be made.
fn marks(context: &Context, spec: &BrushSpec) -> Vec<Mark> {
    let cell_mm = spec.size_mm / FINEST;
    let made = PRESSURES.iter().map(|&(name, pressure)| {
        let mark = ContactMark::of(spec.shape, spec.size_mm, cell_mm, pressure).ok()?;
        let width = mark.cells.width();
        let height = mark.cells.height();
        let texture = (width * height > 0).then(|| {
            let pixels = mark.cells.values().iter();
            let pixels =
                pixels.map(|touched| if *touched { Color32::WHITE } else { Color32::TRANSPARENT });
            let image = ColorImage::new([width, height], pixels.collect());
            context.load_texture(format!("mark {name}"), image, TextureOptions::LINEAR)
        });
        Some(Mark { size_mm: mark.size_mm(), texture })
    });
    made.flatten().collect()
}

pub(super) fn has_settings(mode: Mode) -> bool {
    matches!(mode, Mode::Blend | Mode::Erase | Mode::Scrape | Mode::Mask)
}

/// Draws the settings of the tool in use, if it has some.
pub(super) fn show(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    match cx.tools.mode {
        Mode::Blend => {
            let tip = tr("How much blending mixes and moves the wet paint");
            let note = tr("The head is clean; the paint of the brush stays on it");
            let tip = format!("{tip}.\n{note}.");
            percent(ui, tr("Strength"), &tip, &mut cx.tools.blend_strength, 1.0..=100.0);
        }
        Mode::Erase => {
            let tip = tr("How much of the wet paint a rag takes; pressure takes more");
            let tip = format!("{tip}.\n{note}.", note = tr("Dry layers stay as they are"));
            percent(ui, tr("Strength"), &tip, &mut cx.tools.erase_strength, 1.0..=100.0);
        }
        Mode::Scrape => {
            let height = Slider::new(&mut cx.tools.scrape_mm, 0.0..=2.0).suffix(" mm");
            let tip =
                tr("Height of the blade over the ground: 0 scrapes down to it, and so does full \
                 pressure");
            let note = tr("Paint stays in the valleys of the ground");
            let tip = format!("{tip}.\n{note}.");
            slider(ui, tr("Height"), &tip, height.max_decimals(2).step_by(0.01));
        }
        Mode::Mask => mask(ui, cx),
        _ => {}
    }
}

fn mask(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    let covered = cx.painting.mask.as_ref().map(|mask| mask.covered);
    ui.label(covered.map_or_else(
        || tr("No mask: draw one on the canvas, with shift a rectangle").to_owned(),
        |covered| tr_format!("{covered:.0} % of the canvas is covered", covered = 100.0 * covered),
    ));
    let none = covered.is_none().then_some(tr("there is no mask"));
    let mut change = None;
    ui.horizontal(|ui| {
        let tip = tr("Covers what is open, and opens what is covered");
        if button(ui, tr("Invert"), tip, none) {
            change = Some(MaskChange::Inverse(true));
        }
        if button(ui, tr("Take off"), tr("Takes the mask off the canvas"), none) {
            change = Some(MaskChange::Clear {});
        }
    });
    ui.weak(tr("Leave open only where there is:"));
    ui.horizontal_wrapped(|ui| {
        let tip = tr("Locks the bare canvas: strokes change only cells that have paint now");
        if button(ui, tr("Any paint"), tip, None) {
            change = Some(MaskChange::Painted {});
        }
        if button(ui, tr("Wet paint"), tr("Strokes change only cells that are wet now"), None) {
            change = Some(MaskChange::Layer(LayerRef::Wet));
        }
        for layer in cx.painting.layers.iter().rev() {
            let name = layer.label();
            let tip = tr_format!("Strokes change only cells that have paint of {name}", name);
            if button(ui, &name, &tip, None) {
                change = Some(MaskChange::Layer(LayerRef::Id(layer.id)));
            }
        }
    });
    if let Some(change) = change {
        cx.act(Action::Mask(change));
    }
}

/// Draws a head that points up, with ferrule and part of the handle. The hair has the
/// sRGB colour of its paint, or grey if clean.
pub(in crate::panels) fn draw(
    painter: &Painter,
    area: Rect,
    shape: HeadShape,
    color: Option<[u8; 3]>,
) {
    let contour = shape.contour();
    let (length, _) = contour[contour.len() - 1];
    let metal = area.height() * 0.28;
    // We fit long heads to the height and wide ones to the width.
    let scale = (area.width() * 0.78).min((area.height() - metal) / length);
    let foot = pos2(area.center().x, area.top() + area.height() - metal);
    let tip = foot.y - length * scale;
    let drop = (tip - area.top()) * 0.5;
    let foot = foot - vec2(0.0, drop);
    let ferrule = Rect::from_min_max(
        foot - vec2(contour[0].1 * scale, 0.0),
        foot + vec2(contour[0].1 * scale, metal * 0.62),
    );
    let handle = Rect::from_center_size(
        pos2(foot.x, ferrule.bottom() + metal * 0.19),
        vec2((ferrule.width() * 0.6).max(2.5), metal * 0.38),
    );
    painter.rect_filled(handle, 1.0, Color32::from_gray(88));
    painter.rect_filled(ferrule.expand2(vec2(0.75, 0.0)), 1.0, Color32::from_gray(150));
    let hair = match (color, shape) {
        (Some([red, green, blue]), _) => Color32::from_rgb(red, green, blue),
        (None, HeadShape::Knife) => Color32::from_gray(190),
        (None, _) => Color32::from_gray(112),
    };
    // This is dark in both themes, so that light hair stands out.
    let edge = Stroke::new(1.0, theme::DARK.well);
    painter.add(Shape::convex_polygon(outline(&contour, foot, scale), hair, edge));
}

/// Outline of the head as a closed polygon, tip up.
fn outline(contour: &[(f32, f32)], foot: Pos2, scale: f32) -> Vec<Pos2> {
    let up =
        contour.iter().map(|&(along, half)| pos2(foot.x - half * scale, foot.y - along * scale));
    let down = contour
        .iter()
        .rev()
        .filter(|point| point.1 > 0.0)
        .map(|&(along, half)| pos2(foot.x + half * scale, foot.y - along * scale));
    up.chain(down).collect()
}

const SWATCH_HEIGHT: f32 = 50.0;

/// Height of the bare edge above and below the film, in points.
const EDGE: f32 = 7.0;

/// Draws the paint of a brush and its colour in numbers. You see a hiding film at the left, and at
/// the right the film that it lays now, over the ground and over a black and white card. `film`
/// adds the thickness and a button. Returns whether you want to keep the mixture.
pub(super) fn show_swatch(ui: &mut Ui, brush: Option<&BrushState>, film: bool) -> bool {
    let swatch = brush.and_then(|brush| brush.swatch.as_deref());
    let size = vec2(ui.available_width(), SWATCH_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, tr("Paint on the brush")));
    match swatch {
        Some(swatch) => films(ui, rect, swatch),
        None => clean(ui, rect, brush),
    }
    let line = Stroke::new(1.0, theme::colors(ui.ctx()).well);
    ui.painter().rect_stroke(rect, CornerRadius::ZERO, line, StrokeKind::Inside);
    let (Some(swatch), Some(brush)) = (swatch, brush) else { return false };
    tip(response, swatch);
    ui.scope(|ui| {
        // You cannot click in this line, so it is only as high as its text.
        ui.spacing_mut().interact_size.y = 0.0;
        ui.horizontal(|ui| color(ui, swatch));
    });
    film && film_line(ui, swatch, brush)
}

fn films(ui: &Ui, rect: Rect, swatch: &BrushSwatch) {
    let painter = ui.painter_at(rect);
    let (opaque, thin) = rect.split_left_right_at_fraction(0.5);
    painter.rect_filled(opaque, 0.0, screen(swatch.opaque));
    let (ground, card) = thin.split_left_right_at_fraction(0.5);
    let (black, white) = card.split_left_right_at_fraction(0.5);
    let fields = [
        (ground, swatch.ground, swatch.over_ground),
        (black, swatch.cards[0], swatch.over_cards[0]),
        (white, swatch.cards[1], swatch.over_cards[1]),
    ];
    for (field, bare, film) in fields {
        painter.rect_filled(field, 0.0, screen(bare));
        let film_rect = Rect::from_min_max(
            pos2(field.left(), field.top() + EDGE),
            pos2(field.right(), field.bottom() - EDGE),
        );
        painter.rect_filled(film_rect, 0.0, screen(film));
    }
}

fn clean(ui: &Ui, rect: Rect, brush: Option<&BrushState>) {
    let colors = theme::colors(ui.ctx());
    ui.painter().rect_filled(rect, 0.0, colors.well);
    let medium = brush.is_some_and(|brush| brush.amount_mm > 0.0);
    let words = if medium { tr("medium only") } else { tr("the brush is clean") };
    let font = TextStyle::Body.resolve(ui.style());
    let middle = eframe::egui::Align2::CENTER_CENTER;
    ui.painter().text(rect.center(), middle, words, font, colors.faint);
}

fn tip(response: Response, swatch: &BrushSwatch) {
    fn lab(color: FilmColor) -> String {
        let [l, a, b] = color.lab.to_array();
        format!("Lab {l:.1} {a:.1} {b:.1}")
    }
    response.on_hover_text(tr_format!("The paint at the tip, by its measured K and S under the light of the painting.\n\
         Left: a film that hides, {film}.\n\
         Then the film as thick as the paint at the tip: over the ground, {ground}; over a black card, \
         {black}; over a white card, {white}. Their bare edges show above and below.", film = lab(swatch.opaque), ground = lab(swatch.over_ground), black = lab(swatch.over_cards[0]), white = lab(swatch.over_cards[1])));
}

/// Thickness and medium of the film. Returns whether you want to keep the mixture.
fn film_line(ui: &mut Ui, swatch: &BrushSwatch, brush: &BrushState) -> bool {
    let thickness = millimetres(swatch.thickness_mm);
    let medium = tr_format!(
        "{thickness} at the tip, {vehicle:.0} % medium",
        thickness,
        vehicle = 100.0 * brush.vehicle
    );
    let line = ui.horizontal(|ui| {
        let words = ui.weak(medium);
        words
            .on_hover_text(tr("Thickness of the film, and the share of clear medium on the brush"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let tip = tr("Keeps what the brush holds as a mixture in the panel Swatches");
            named_button(ui, tr("Keep"), tr("Keep this mixture"), tip, None)
        })
        .inner
    });
    line.inner
}

fn color(ui: &mut Ui, swatch: &BrushSwatch) {
    let [l, a, b] = swatch.opaque.lab.to_array();
    ui.spacing_mut().item_spacing.x = 10.0;
    let lab = ui.monospace(format!("Lab {l:.1} {a:.1} {b:.1}"));
    lab.on_hover_text(tr("CIELAB of the film that hides, under the light of the painting"));
    let hides = ui.weak(tr_format!("hides {contrast:.0} %", contrast = 100.0 * swatch.contrast));
    hides.on_hover_text(tr(
        "Contrast ratio of the film: its luminance over the black card relative to that over the \
         white one. From 98 % on it hides",
    ));
}

fn screen(color: FilmColor) -> Color32 {
    let [red, green, blue] = color.srgb;
    Color32::from_rgb(red, green, blue)
}
