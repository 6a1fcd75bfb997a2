//! The wheel panel shows the colours that your tubes can mix, by measured colour, and how near they
//! come to a wanted one. The plane is a* and b*.

use std::sync::Arc;

use eframe::egui::{
    Align2, Color32, Context, FontId, Mesh, Painter, Pos2, Rect, Response, Role, Sense, Shape,
    Slider, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, vec2,
};
use pigment::matching::{RecipeLimits, Target, ViewingCondition};
use pigment::palette::{Appearance, Boundary, ColorWheel, PaletteError};
use session::PaintingState;
use spectra::color::{Lab, Rgb, delta_e_ciede2000};

use crate::language::{tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::slider;
use crate::panels::eyedropper::{Color, SearchPanel, TargetColor};
use crate::recipe_search::{RecipeSearch, SearchRequest};
use crate::theme;
use crate::wheel_maker::{MadeWheel, WheelMaker, WheelRequest};

/// A colour counts as reached up to this CIEDE2000. You hardly see it, even side by side.
const REACHED: f64 = 1.0;

/// Largest side of the plot, in points.
const LARGEST: f32 = 420.0;

/// The plot shrinks to this side in a low panel, in points, so that you see all of it.
const SMALLEST: f32 = 128.0;

/// State of the wheel panel.
#[derive(Debug, Default)]
pub struct Wheel {
    maker: WheelMaker,
    /// L* of the shown region; `None` shows all lightnesses.
    lightness: Option<f64>,
    view: WheelView,
    reach: Reach,
    /// Colour that you clicked, and recipes for it.
    target: Option<TargetColor>,
    search: SearchPanel,
}

impl Wheel {
    /// Draws the panel. `wanted` is the target colour of the eyedropper.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, wanted: Option<&TargetColor>) {
        let context = ui.ctx().clone();
        let request = request(cx.painting);
        let made = self.maker.get(&request, move || context.request_repaint());
        self.lightness_row(ui);
        let target = self.target.clone();
        let wanted = target.as_ref().or(wanted);
        match made.as_deref() {
            None => {
                ui.weak(tr("Mixing the tubes ..."));
            }
            Some(Err(error)) => reason(ui, error),
            Some(Ok(_)) => self.wheel(ui, cx, made.as_ref(), wanted),
        }
        ui.separator();
        match self.target.clone() {
            None => {
                ui.weak(tr("Click a colour in the wheel to find its recipes."));
            }
            Some(target) => {
                ui.horizontal(|ui| {
                    ui.label(&target.name);
                    let clear = ui
                        .small_button(tr("Clear"))
                        .accessible_name(tr("Clear the wheel's colour"));
                    if clear.on_hover_text(tr("Forgets the colour that was clicked")).clicked() {
                        self.search.forget();
                        self.target = None;
                    }
                });
                self.search.show(ui, cx, Some(&target));
            }
        }
    }

    fn lightness_row(&mut self, ui: &mut Ui) {
        let mut all = self.lightness.is_none();
        ui.horizontal(|ui| {
            let response = ui.checkbox(&mut all, tr("All lightnesses"));
            response.on_hover_text(tr("Shows what the tubes reach at any lightness, or at one"));
        });
        let mut lightness = self.lightness.unwrap_or(50.0);
        ui.add_enabled_ui(!all, |ui| {
            let control = Slider::new(&mut lightness, 5.0..=95.0).fixed_decimals(0);
            let tip = tr("L* of the region: mixtures whose lightness is within 5 of it");
            slider(ui, tr("Lightness"), tip, control);
        });
        self.lightness = (!all).then_some(lightness);
    }

    /// Draws the wheel and its legend. A click on a colour starts a search for recipes.
    fn wheel(
        &mut self,
        ui: &mut Ui,
        cx: &PanelContext<'_>,
        made: Option<&MadeWheel>,
        wanted: Option<&TargetColor>,
    ) {
        let Some(Ok(wheel)) = made.map(|made| made.as_ref().as_ref()) else { return };
        self.view.update(made, self.lightness);
        self.reach.update(
            ui.ctx(),
            cx.painting,
            wanted.map(|color: &TargetColor| {
                color.lab(cx.painting.library.grid, &cx.painting.light.viewing)
            }),
        );
        if let Some(clicked) = self.plot(ui, cx, wheel, wanted) {
            self.search.begin(ui, cx.painting, &clicked);
            self.target = Some(clicked);
        }
        legend(ui, cx, self.reach.delta_e(), wanted);
    }

    /// Draws the wheel. Returns the clicked colour.
    fn plot(
        &self,
        ui: &mut Ui,
        cx: &PanelContext<'_>,
        wheel: &ColorWheel,
        wanted: Option<&TargetColor>,
    ) -> Option<TargetColor> {
        // The controls above scroll with the plot, so that its side does not change.
        let above = ui.cursor().top() - ui.min_rect().top();
        let seen = (ui.clip_rect().height() - above).max(SMALLEST);
        let side = ui.available_width().min(LARGEST).min(seen);
        let (rect, response) = ui
            .vertical_centered(|ui: &mut Ui| {
                ui.allocate_exact_size(vec2(side, side), Sense::click())
            })
            .inner;
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, tr("Colour wheel")));
        let plane = Plane::with_chroma(rect, self.view.chroma);
        let painter = ui.painter_at(rect);
        frame(&painter, &plane);
        if let Some(region) = &self.view.region {
            self::region(&painter, &plane, wheel, region);
        }
        lines(&painter, &plane, wheel);
        tubes(&painter, &plane, wheel);
        for mark in marks(cx.painting, &cx.tools.brush, wanted) {
            self::mark(&painter, &plane, mark);
        }
        let clicked = response.interact_pointer_pos().filter(|_| response.clicked());
        tip(response, cx.painting, wheel, &plane);
        clicked.map(|point| self.color_at(wheel, plane.place(point)))
    }

    /// The colour of a place. Its lightness comes from the shown region. If you see all
    /// lightnesses, it comes from the mixture with the nearest a* and b*.
    fn color_at(&self, wheel: &ColorWheel, [a, b]: [f64; 2]) -> TargetColor {
        let nearest = self.lightness.or_else(|| {
            let labs = wheel.gamut.samples.iter().map(|sample| sample.color.lab);
            let away = labs.map(|lab| ((lab.a - a).hypot(lab.b - b), lab.lightness));
            Some(away.min_by(|one, other| one.0.total_cmp(&other.0))?.1)
        });
        let [lightness, a, b] =
            [nearest.unwrap_or(50.0), a, b].map(|value| (10.0 * value).round() / 10.0);
        let lab = Lab { lightness, a, b };
        let name = format!("Lab {lightness} {} {}", lab.a, lab.b);
        TargetColor { name, color: Color::Lab(lab) }
    }
}

fn request(painting: &PaintingState) -> WheelRequest {
    let mut tubes: Vec<_> = painting.slots.iter().copied().flatten().collect();
    tubes.sort_unstable();
    tubes.dedup();
    let viewing = painting.light.viewing.clone();
    WheelRequest { library: painting.library.clone(), tubes, viewing }
}

fn reason(ui: &mut Ui, error: &PaletteError) {
    ui.label(format!("{error}."));
    ui.weak(tr("Put tubes on the palette whose mixtures were measured."));
}

/// Marks of the paint on the brush and of the wanted colour.
fn marks(painting: &PaintingState, brush: &str, wanted: Option<&TargetColor>) -> Vec<Mark> {
    let held = held(painting, brush).map(|(lab, srgb)| Mark { lab, srgb, wanted: false });
    let grid = painting.library.grid;
    let viewing = &painting.light.viewing;
    let wanted = wanted.map(|wanted| {
        let srgb = wanted.shown(grid, viewing).linear().mapped_into_gamut().encoded().to_bytes();
        Mark { lab: wanted.lab(grid, viewing), srgb, wanted: true }
    });
    held.into_iter().chain(wanted).collect()
}

/// Colour of the paint on a brush, in a film that hides.
fn held(painting: &PaintingState, brush: &str) -> Option<(Lab, [u8; 3])> {
    let state = painting.brushes.iter().find(|state| state.name == brush)?;
    let opaque = state.swatch.as_ref()?.opaque;
    Some((opaque.lab, opaque.srgb))
}

/// Explains how near the tubes and the brush come to the wanted colour.
fn legend(ui: &mut Ui, cx: &PanelContext<'_>, nearest: Option<f64>, wanted: Option<&TargetColor>) {
    let Some(wanted) = wanted else {
        ui.weak(tr("Ring: what the brush holds."));
        return;
    };
    let words = match nearest {
        None => tr_format!("Square: {name}.", name = wanted.name),
        Some(nearest) if nearest <= REACHED => {
            tr_format!("Square: {name}. The tubes reach it.", name = wanted.name)
        }
        Some(nearest) => {
            tr_format!(
                "Square: {name}. The tubes come within \u{2206}E {nearest:.1}.",
                name = wanted.name,
                nearest
            )
        }
    };
    let tip = tr("CIEDE2000 to the nearest mixture of up to four tubes, in shares of any size");
    ui.label(words).on_hover_text(tip);
    if let Some((held, _)) = held(cx.painting, &cx.tools.brush) {
        let lab = wanted.lab(cx.painting.library.grid, &cx.painting.light.viewing);
        let apart = delta_e_ciede2000(lab, held);
        ui.weak(tr_format!("Ring: what the brush holds, \u{2206}E {apart:.1} from it.", apart));
    }
}

/// Names the tube below the pointer, or the colour there.
fn tip(response: Response, painting: &PaintingState, wheel: &ColorWheel, plane: &Plane) {
    let Some(pointer) = response.hover_pos() else { return };
    let tube = wheel
        .masstones
        .iter()
        .find(|(_, color)| plane.point([color.lab.a, color.lab.b]).distance(pointer) < 7.0);
    let words = match tube {
        Some((pigment, color)) => {
            let [l, a, b] = color.lab.to_array();
            format!("{}: Lab {l:.1} {a:.1} {b:.1}", painting.library[*pigment].name)
        }
        None => {
            let [a, b] = plane.place(pointer);
            tr_format!(
                "a* {a:.0}, b* {b:.0}. Lines: mixtures of two tubes; small dots: tints with white. \
                 Click to find recipes for this colour.",
                a,
                b
            )
        }
    };
    response.on_hover_text_at_pointer(words);
}

const MARK: f32 = 6.0;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Mark {
    lab: Lab,
    srgb: [u8; 3],
    /// True for the wanted colour, a square. False for the brush, a ring.
    wanted: bool,
}

/// Draws rings of chroma and the axes.
fn frame(painter: &Painter, plane: &Plane) {
    let colors = theme::colors(painter.ctx());
    painter.rect_filled(plane.rect, theme::CORNER_RADIUS, colors.well);
    let line = Stroke::new(1.0, colors.line);
    let middle = plane.rect.center();
    let rect = plane.rect;
    painter.hline(rect.x_range(), middle.y, line);
    painter.vline(middle.x, rect.y_range(), line);
    let rings = (plane.reach / RING) as usize;
    for ring in 1..=rings {
        painter.circle_stroke(middle, plane.point([ring as f64 * RING, 0.0]).x - middle.x, line);
    }
    let font = FontId::proportional(10.0);
    let names = [
        (rect.right_center(), Align2::RIGHT_BOTTOM, tr("+a* red")),
        (rect.left_center(), Align2::LEFT_BOTTOM, tr("green")),
        (rect.center_top(), Align2::LEFT_TOP, tr(" +b* yellow")),
        (rect.center_bottom(), Align2::LEFT_BOTTOM, tr(" blue")),
    ];
    for (at, align, name) in names {
        painter.text(at, align, name, font.clone(), colors.faint);
    }
}

/// Fills the region that the tubes reach, and draws its outline. It has the colours of the
/// outermost mixtures, and in the middle a grey of their mean lightness.
fn region(painter: &Painter, plane: &Plane, wheel: &ColorWheel, region: &Boundary) {
    let held: Vec<(Pos2, &Appearance)> = region
        .sectors
        .iter()
        .flatten()
        .map(|(place, index)| (plane.point(*place), &wheel.gamut.samples[*index].color))
        .collect();
    if held.len() < 2 {
        return;
    }
    let lightness =
        held.iter().map(|(_, color)| color.lab.lightness).sum::<f64>() / held.len() as f64;
    // The grey of this L*: Y by CIELAB, encoded.
    let grey = Rgb([((lightness + 16.0) / 116.0).powi(3).clamp(0.0, 1.0); 3]).encoded();
    let mut mesh = Mesh::default();
    mesh.colored_vertex(plane.rect.center(), screen(grey));
    for (point, color) in &held {
        mesh.colored_vertex(*point, screen(color.srgb));
    }
    let outline: Vec<Pos2> = region.polygon().into_iter().map(|place| plane.point(place)).collect();
    let middle = plane.rect.center();
    let count = held.len() as u32;
    for at in 0..count {
        let next = (at + 1) % count;
        let [from, to] = [held[at as usize].0, held[next as usize].0].map(|point| point - middle);
        // If we filled wide gaps, this would show colours that the tubes do not reach.
        if from.normalized().dot(to.normalized()) > 0.9 {
            mesh.add_triangle(0, 1 + at, 1 + next);
        }
    }
    painter.add(Shape::mesh(mesh));
    let line = Stroke::new(1.0, theme::colors(painter.ctx()).text);
    painter.add(Shape::closed_line(outline, line));
}

/// Draws the mixing lines of all pairs and the tints, each piece in its own colour.
fn lines(painter: &Painter, plane: &Plane, wheel: &ColorWheel) {
    let at = |color: &Appearance| plane.point([color.lab.a, color.lab.b]);
    for line in &wheel.lines {
        for two in line.colors.windows(2) {
            let ends = [at(&two[0].1), at(&two[1].1)];
            painter.line_segment(ends, Stroke::new(2.5, Color32::from_black_alpha(90)));
            painter.line_segment(ends, Stroke::new(1.5, screen(two[0].1.srgb)));
        }
    }
    for color in wheel.tints.iter().flat_map(|ladder| ladder.colors.iter().skip(1)) {
        let edge = Stroke::new(0.5, Color32::from_black_alpha(160));
        painter.circle(at(color), 2.2, screen(color.srgb), edge);
    }
}

fn tubes(painter: &Painter, plane: &Plane, wheel: &ColorWheel) {
    let edge = Stroke::new(1.5, theme::colors(painter.ctx()).strong);
    for (_, color) in &wheel.masstones {
        let point = plane.point([color.lab.a, color.lab.b]);
        painter.circle(point, 5.0, screen(color.srgb), edge);
    }
}

/// Draws the paint on the brush, or the wanted colour.
fn mark(painter: &Painter, plane: &Plane, mark: Mark) {
    let [r, g, b] = mark.srgb;
    let fill = Color32::from_rgb(r, g, b);
    let point = plane.rect.shrink(MARK).clamp(plane.point([mark.lab.a, mark.lab.b]));
    // You see white over black on any colour.
    for stroke in [Stroke::new(3.0, Color32::BLACK), Stroke::new(1.5, Color32::WHITE)] {
        if mark.wanted {
            let square = Rect::from_center_size(point, Vec2::splat(2.0 * MARK));
            painter.rect(square, 0.0, fill, stroke, StrokeKind::Middle);
        } else {
            painter.circle(point, MARK, fill, stroke);
        }
    }
}

/// Screen colour of an encoded colour, moved into the gamut of the screen.
fn screen(srgb: Rgb) -> Color32 {
    let [r, g, b] = srgb.linear().mapped_into_gamut().encoded().to_bytes();
    Color32::from_rgb(r, g, b)
}

/// Steps of the rings of equal chroma.
const RING: f64 = 20.0;

/// Maps between a*, b* and points of the window: a* to the right, b* upwards, grey in the middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Square on the screen.
    pub rect: Rect,
    /// Chroma at the middle of each side.
    pub reach: f64,
}

impl Plane {
    /// A plane that shows everything up to this chroma.
    #[must_use]
    pub fn with_chroma(rect: Rect, chroma: f64) -> Self {
        let half = 0.5 * RING;
        Self { rect, reach: ((chroma / half).ceil() * half).max(2.0 * RING) }
    }

    /// Point of a* and b*.
    #[must_use]
    pub fn point(&self, [a, b]: [f64; 2]) -> Pos2 {
        let scale = 0.5 * f64::from(self.rect.width()) / self.reach;
        self.rect.center() + vec2((a * scale) as f32, (-b * scale) as f32)
    }

    /// Values of a* and b* at a point.
    #[must_use]
    pub fn place(&self, point: Pos2) -> [f64; 2] {
        let scale = 2.0 * self.reach / f64::from(self.rect.width());
        let away = point - self.rect.center();
        [f64::from(away.x) * scale, -f64::from(away.y) * scale]
    }
}

/// Search for the mixture of the tubes nearest to a wanted colour.
#[derive(Debug, Default)]
struct Reach {
    search: RecipeSearch,
    of: Option<SearchRequest>,
}

impl Reach {
    /// Updates the search if wanted colour, tubes or light changed.
    fn update(&mut self, context: &Context, painting: &PaintingState, wanted: Option<Lab>) {
        self.search.update();
        let request = wanted.map(|wanted| request_for(painting, wanted));
        if self.of == request {
            return;
        }
        self.of.clone_from(&request);
        let context = context.clone();
        match request {
            Some(request) => self.search.start(request, move || context.request_repaint()),
            None => self.search.cancel(),
        }
    }

    /// CIEDE2000 from the wanted colour to the nearest mixture; `None` while the search runs.
    fn delta_e(&self) -> Option<f64> {
        let result =
            self.search.result().filter(|result| Some(&result.request) == self.of.as_ref())?;
        let nearest = result.recipes.as_ref().ok()?.first()?;
        nearest.delta_e.first().copied()
    }
}

/// Search for the best recipe of the tubes, with shares of any size.
fn request_for(painting: &PaintingState, wanted: Lab) -> SearchRequest {
    let library = Arc::clone(&painting.library);
    let viewing = painting.light.viewing.clone();
    let conditions = vec![ViewingCondition { viewing, weight: 1.0 }];
    let target = Target::from_lab("wanted", wanted, &conditions);
    let film = RecipeLimits::usual_film(&library, painting.ground_reflectance.to_vec());
    let mut limits = RecipeLimits::new(&library, conditions, film);
    limits.allowed = painting
        .slots
        .iter()
        .copied()
        .flatten()
        .filter(|pigment: &_| library[*pigment].identified)
        .collect();
    limits.allowed.sort_unstable();
    limits.allowed.dedup();
    (limits.least_share, limits.count) = (0.0, 1);
    SearchRequest { library, target, limits }
}

#[derive(Debug, Default)]
struct WheelView {
    made: Option<MadeWheel>,
    lightness: Option<f64>,
    /// Colours that the tubes reach at this lightness.
    region: Option<Boundary>,
    /// Largest chroma of all mixtures.
    chroma: f64,
}

impl WheelView {
    /// Updates this if wheel or lightness changed.
    fn update(&mut self, made: Option<&MadeWheel>, lightness: Option<f64>) {
        let Some(Ok(wheel)) = made.map(|made| made.as_ref().as_ref()) else { return };
        let same = self.made.as_ref().zip(made).is_some_and(|(own, made)| Arc::ptr_eq(own, made));
        if !same {
            let chroma =
                wheel.gamut.samples.iter().map(|one| one.color.lab.a.hypot(one.color.lab.b));
            self.chroma = chroma.fold(0.0, f64::max);
            self.made = made.cloned();
        }
        if !same || self.lightness != lightness || self.region.is_none() {
            self.region = Some(wheel.region(lightness));
            self.lightness = lightness;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    #[test]
    fn a_point_is_found_again_and_red_lies_right_of_yellow() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(200.0, 200.0));
        let plane = Plane::with_chroma(rect, 71.0);
        assert!((plane.reach - 80.0).abs() < 1e-12, "{}", plane.reach);
        assert_eq!(plane.point([0.0, 0.0]), rect.center());
        assert_eq!(plane.point([0.0, 80.0]), rect.center_top());
        assert_eq!(plane.point([80.0, 0.0]), rect.right_center());
        for place in [[12.5, -40.0], [-7.0, 66.0]] {
            let found = plane.place(plane.point(place));
            let near = found.iter().zip(place).all(|(found, wanted)| (found - wanted).abs() < 1e-4);
            assert!(near, "{found:?} {place:?}");
        }
        assert!((Plane::with_chroma(rect, 3.0).reach - 40.0).abs() < 1e-12, "never too near");
    }
}
