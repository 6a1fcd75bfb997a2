//! Draws the wheel panel.

use eframe::egui::{Response, Role, Sense, Slider, Ui, WidgetInfo, vec2};
use pigment::palette::{ColorWheel, PaletteError};
use spectra::color::{Lab, delta_e_ciede2000};

use super::plane::Plane;
use super::plot::{self, Mark};
use super::reach::Reach;
use super::view::WheelView;
use crate::language::{tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::slider;
use crate::panels::eyedropper::{Color, SearchPanel, TargetColor};
use crate::wheel_maker::{MadeWheel, WheelMaker, WheelRequest};
use session::PaintingState;

/// CIEDE2000 up to which a colour counts as reached: hardly visible, even side by side.
const REACHED: f64 = 1.0;

/// Largest side of the plot, in points.
const LARGEST: f32 = 420.0;

/// Side down to which the plot shrinks so that a low panel shows all of it, in points.
const SMALLEST: f32 = 128.0;

/// State of the wheel panel.
#[derive(Debug, Default)]
pub struct Wheel {
    maker: WheelMaker,
    /// L* of the region that is shown; `None` shows all lightnesses.
    lightness: Option<f64>,
    view: WheelView,
    reach: Reach,
    /// Colour that was clicked, and recipes for it.
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

    /// Draws the wheel and its legend; a click begins a search.
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

    /// Draws the wheel. Returns the colour that was clicked.
    fn plot(
        &self,
        ui: &mut Ui,
        cx: &PanelContext<'_>,
        wheel: &ColorWheel,
        wanted: Option<&TargetColor>,
    ) -> Option<TargetColor> {
        // The controls above the plot scroll with it, so that the side does not change.
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
        plot::frame(&painter, &plane);
        if let Some(region) = &self.view.region {
            plot::region(&painter, &plane, wheel, region);
        }
        plot::lines(&painter, &plane, wheel);
        plot::tubes(&painter, &plane, wheel);
        for mark in marks(cx.painting, &cx.tools.brush, wanted) {
            plot::mark(&painter, &plane, mark);
        }
        let clicked = response.interact_pointer_pos().filter(|_| response.clicked());
        tip(response, cx.painting, wheel, &plane);
        clicked.map(|point| self.color_at(wheel, plane.place(point)))
    }

    /// The colour of a place: with the lightness of the region or, if all are shown, with that of
    /// the mixture nearest to it in the plane.
    fn color_at(&self, wheel: &ColorWheel, [a, b]: [f64; 2]) -> TargetColor {
        let away = |lab: &Lab| (lab.a - a).hypot(lab.b - b);
        let nearest = || {
            let labs = wheel.gamut.samples.iter().map(|sample| sample.color.lab);
            labs.min_by(|one, other| away(one).total_cmp(&away(other)))
        };
        let round = |value: f64| (10.0 * value).round() / 10.0;
        let lightness = self.lightness.or_else(|| Some(nearest()?.lightness)).map_or(50.0, round);
        let lab = Lab { lightness, a: round(a), b: round(b) };
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

/// Marks of what the brush holds and of the colour that is wanted.
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

/// Colour of the paint that a brush holds, in a film that hides.
fn held(painting: &PaintingState, brush: &str) -> Option<(Lab, [u8; 3])> {
    let state = painting.brushes.iter().find(|state| state.name == brush)?;
    let opaque = state.swatch.as_ref()?.opaque;
    Some((opaque.lab, opaque.srgb))
}

/// Says how near the tubes come to the colour that is wanted, and the brush to it.
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

/// Tells the tube below the pointer, or the colour there.
fn tip(response: Response, painting: &PaintingState, wheel: &ColorWheel, plane: &Plane) {
    let Some(pointer) = response.hover_pos() else { return };
    let near = |lab: Lab| plane.point([lab.a, lab.b]).distance(pointer) < 7.0;
    let tube = wheel.masstones.iter().find(|(_, color)| near(color.lab));
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
