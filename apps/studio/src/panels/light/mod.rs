//! The light panel: illuminant with its white point, direction, gloss and split view.

mod illuminants;
mod direction;

use std::sync::Arc;

use eframe::egui::{Button, ComboBox, Grid, Slider, Ui, vec2};
use paint::document::Lighting;
use paint::light::Light;
use paint::optics::Gloss;
use paint::strokes::Action;
use session::Command;
use spectra::{ColorTemperature, Observer, light_from_text};

use super::context::{Edit, PanelContext, PendingValue};
use crate::files::FileRequest;
use crate::language::{english, tr, tr_format};
use crate::theme;
use direction::{gloss_pad, gloss_text};
use illuminants::labelled_slider;

pub(super) use direction::{Direction, direction_control, direction_text};
pub(super) use illuminants::{IlluminantControl, power_chart};

const DIRECTION_SIZE: f32 = 104.0;

/// First alternative illuminant: A, the common tungsten bulb.
const TUNGSTEN: &str = "A";

/// State of the light panel.
#[derive(Debug)]
pub struct LightPanel {
    first: IlluminantControl,
    second: IlluminantControl,
    previous: String,
    /// Illuminant of the second light when you last switched that off.
    last_second: String,
    lighting: PendingValue<Lighting>,
    gloss: PendingValue<(Gloss, Gloss)>,
    white: Option<WhitePoint>,
}

impl Default for LightPanel {
    fn default() -> Self {
        Self {
            first: IlluminantControl::new(english("Illuminant"), english("Temperature")),
            second: IlluminantControl::new(
                english("Second illuminant"),
                english("Second temperature"),
            ),
            previous: TUNGSTEN.to_owned(),
            last_second: TUNGSTEN.to_owned(),
            lighting: PendingValue::default(),
            gloss: PendingValue::default(),
            white: None,
        }
    }
}

impl LightPanel {
    /// Draws the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let now = ui.input(|input| input.time);
        let reported = &cx.painting.lighting;
        let lighting = self.lighting.shown(reported, same_lighting, now);
        self.illuminant(ui, cx, &lighting);
        self.adaptation(ui, cx, lighting.clone());
        self.spectrum(ui, cx);
        ui.separator();
        self.direction(ui, cx, lighting.clone());
        ui.separator();
        self.gloss_pads(ui, cx);
        ui.separator();
        self.split(ui, cx, &lighting);
    }

    fn illuminant(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, lighting: &Lighting) {
        if let Some(illuminant) = self.first.show(ui, &lighting.illuminant) {
            self.set_lighting(ui, cx, Lighting { illuminant, ..lighting.clone() });
        }
        ui.horizontal(|ui| {
            let lamp = ui.button(tr("Measured lamp\u{2026}"));
            if lamp.on_hover_text(tr("Paint under a lamp measured with an instrument")).clicked() {
                cx.file(FileRequest::OpenLamp);
            }
            let mut observer = lighting.observer.clone();
            let combo = ComboBox::from_id_salt("observer")
                .selected_text(observer.clone())
                .width(ui.available_width());
            let combo = combo.show_ui(ui, |ui| {
                for one in Observer::ALL {
                    let line =
                        ui.selectable_value(&mut observer, one.name().to_owned(), one.name());
                    line.on_hover_text(observer_description(one));
                }
            });
            let response = combo.response.accessible_name(tr("Observer"));
            response.on_hover_text(tr("CIE standard observer and its field of view"));
            if observer != lighting.observer {
                self.set_lighting(ui, cx, Lighting { observer, ..lighting.clone() });
            }
        });
    }

    fn adaptation(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, mut lighting: Lighting) {
        let slider = Slider::new(&mut lighting.adaptation, 0.0..=1.0);
        let slider = slider.fixed_decimals(2).update_while_editing(false);
        let response =
            labelled_slider(ui, tr("Adaptation"), slider).accessible_name(tr("Adaptation"));
        let response = response.on_hover_text(tr(
            "How far the eye has adapted to the light: at 1 white paint is white under every \
             lamp, at 0 the picture has the light's own colour beside daylight. Tubes, recipes \
             and picked colours are shown as at 1",
        ));
        self.adjust_both_lights(ui, cx, Edit::of(&response), lighting);
    }

    /// Queues a change of `lighting`. Once the change is complete, the second light takes it over
    /// too, except for its illuminant.
    fn adjust_both_lights(
        &mut self,
        ui: &Ui,
        cx: &mut PanelContext<'_>,
        edit: Edit,
        lighting: Lighting,
    ) {
        self.lighting.request(ui, cx, edit, Action::Light(lighting.clone()), lighting.clone());
        let finished = matches!(edit, Edit::Released | Edit::Set);
        if let Some(second) = cx.painting.second_lighting.as_ref().filter(|_| finished) {
            let illuminant = second.illuminant.clone();
            cx.command(Command::SetSecondLight(Some(Lighting { illuminant, ..lighting })));
        }
    }

    /// Switches to the previous illuminant. If there was none, this is A.
    pub fn switch_illuminant(&mut self, cx: &mut PanelContext<'_>) {
        let now = &cx.painting.lighting;
        let illuminant = std::mem::replace(&mut self.previous, now.illuminant.clone());
        let lighting = Lighting { illuminant, ..now.clone() };
        cx.command(Command::Apply(Action::Light(lighting)));
    }

    fn set_lighting(&mut self, ui: &Ui, cx: &mut PanelContext<'_>, lighting: Lighting) {
        self.lighting.set(lighting.clone(), ui.input(|input| input.time));
        if lighting.illuminant != cx.painting.lighting.illuminant {
            self.previous.clone_from(&cx.painting.lighting.illuminant);
        }
        cx.command(Command::Apply(Action::Light(lighting)));
    }

    fn spectrum(&mut self, ui: &mut Ui, cx: &PanelContext<'_>) {
        let light = &cx.painting.light;
        let second = cx.painting.second_lighting.as_ref().map(|second| second.illuminant.clone());
        let preview = self.first.preview().or(self.second.preview());
        let colors = theme::colors(ui.ctx());
        let others: Vec<_> = [(second, colors.faint), (preview, colors.strong)]
            .into_iter()
            .filter_map(|(name, color)| Some((light_from_text(&name?).ok()?, color)))
            .collect();
        power_chart(ui, light, &others);
        if !self.white.as_ref().is_some_and(|white| white.is_of(light)) {
            self.white = Some(WhitePoint::of(light));
        }
        if let Some(white) = &self.white {
            white.show(ui);
        }
    }

    fn direction(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, mut lighting: Lighting) {
        let mut edit = Edit::None;
        ui.horizontal(|ui| {
            let mut direction = Direction {
                azimuth_deg: lighting.azimuth_deg,
                elevation_deg: lighting.elevation_deg,
            };
            let (response, edited) = direction_control(ui, DIRECTION_SIZE, &mut direction, lighting.ambient);
            response.on_hover_text(tr("Drag the light over the canvas: degrees clockwise from the top, and above the canvas. \
                 Arrow keys turn and raise it"),
            );
            edit = edited;
            if edit != Edit::None {
                lighting.azimuth_deg = direction.azimuth_deg;
                lighting.elevation_deg = direction.elevation_deg;
            }
            ui.vertical(|ui| {
                ui.label(tr("Direction"));
                ui.weak(direction_text(direction));
                let ambient = Slider::new(&mut lighting.ambient, 0.0..=1.0);
                let ambient = ambient.fixed_decimals(2).update_while_editing(false);
                let ambient = labelled_slider(ui, tr("Ambient"), ambient).accessible_name(tr("Ambient"));
                let ambient = ambient.on_hover_text(tr("Share of undirected light"));
                edit = edit.or(Edit::of(&ambient));
                let relief = Slider::new(&mut lighting.relief, 0.0..=3.0);
                let relief = relief.fixed_decimals(2).update_while_editing(false);
                let relief = labelled_slider(ui, tr("Relief"), relief).accessible_name(tr("Relief"));
                let relief = relief.on_hover_text(tr("Strength of the relief: 0 flat, 1 as painted"));
                edit = edit.or(Edit::of(&relief));
            });
        });
        self.adjust_both_lights(ui, cx, edit, lighting);
    }

    fn gloss_pads(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let now = ui.input(|input| input.time);
        let reported = (cx.painting.medium.wet, cx.painting.medium.dry);
        let (mut wet, mut dry) = self.gloss.shown(&reported, same_gloss, now);
        let mut edit = Edit::None;
        let side = (ui.available_width() - ui.spacing().item_spacing.x) / 2.0;
        ui.horizontal(|ui| {
            for (name, gloss) in [(tr("Wet gloss"), &mut wet), (tr("Dry gloss"), &mut dry)] {
                ui.vertical(|ui| {
                    ui.horizontal(|ui| {
                        ui.label(name);
                        ui.weak(format!("{:.2}, {:.0}", gloss.strength, gloss.exponent));
                    });
                    let (response, edited) = gloss_pad(ui, name, vec2(side, 76.0), gloss);
                    let hover = tr_format!("{name}: {gloss}. Drag to the right for a sharper highlight, up for a stronger \
                         one", name, gloss = gloss_text(*gloss));
                    response.on_hover_text(hover);
                    edit = edit.or(edited);
                });
            }
        });
        self.gloss.request(ui, cx, edit, Action::Gloss { wet, dry }, (wet, dry));
    }

    fn split(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, lighting: &Lighting) {
        let second = cx.painting.second_lighting.clone();
        let mut on = second.is_some();
        ui.horizontal(|ui| {
            let check = ui.checkbox(&mut on, tr("Second light"));
            let check = check.on_hover_text(
                tr("Shows the canvas under two lights, side by side; drag the line between them. A switch on the palette shows it under either"),
            );
            if check.changed() {
                let illuminant = self.last_second.clone();
                let second = on.then(|| Lighting { illuminant, ..lighting.clone() });
                cx.command(Command::SetSecondLight(second));
            }
            let swap = ui.add_enabled(second.is_some(), Button::new(tr("Swap")));
            let swap = swap.on_hover_text(tr("Exchanges the two lights"));
            if let Some(second) = second.clone().filter(|_| swap.clicked()) {
                cx.command(Command::SetSecondLight(Some(lighting.clone())));
                self.set_lighting(ui, cx, second);
            }
        });
        let Some(second) = second else { return };
        self.last_second.clone_from(&second.illuminant);
        if let Some(illuminant) = self.second.show(ui, &second.illuminant) {
            cx.command(Command::SetSecondLight(Some(Lighting { illuminant, ..lighting.clone() })));
        }
    }
}

fn same_lighting(a: &Lighting, b: &Lighting) -> bool {
    let [numbers, others] =
        [a, b].map(|l| [l.azimuth_deg, l.elevation_deg, l.ambient, l.relief, l.adaptation]);
    // Recorded lighting has six digits, so it may differ slightly.
    a.illuminant == b.illuminant
        && a.observer == b.observer
        && numbers.into_iter().zip(others).all(|(a, b)| (a - b).abs() < 1e-3)
}

fn same_gloss(a: &(Gloss, Gloss), b: &(Gloss, Gloss)) -> bool {
    fn near(a: Gloss, b: Gloss) -> bool {
        (a.strength - b.strength).abs() < 1e-3 && (a.exponent / b.exponent - 1.0).abs() < 1e-3
    }
    near(a.0, b.0) && near(a.1, b.1)
}

fn observer_description(observer: Observer) -> &'static str {
    match observer {
        Observer::Cie1931Deg2 => tr("CIE 1931, 2 degrees: small fields, the usual one"),
        Observer::Cie1964Deg10 => tr("CIE 1964, 10 degrees: large fields"),
        Observer::Cie2015Deg2 => tr("CIE 2015, 2 degrees: from cone fundamentals"),
        Observer::Cie2015Deg10 => tr("CIE 2015, 10 degrees: from cone fundamentals"),
    }
}

/// Chromaticity and correlated colour temperature of a light.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WhitePoint {
    light: Arc<Light>,
    /// CIE x, y for the light's observer.
    chromaticity: [f64; 2],
    /// Correlated colour temperature, if defined.
    temperature: Option<ColorTemperature>,
}

impl WhitePoint {
    pub(super) fn of(light: &Arc<Light>) -> Self {
        let white = light.quadrature.rule.white;
        let xyy = white.to_xyy(white);
        Self {
            light: Arc::clone(light),
            chromaticity: [xyy.x, xyy.y],
            temperature: ColorTemperature::of(&light.viewing.illuminant),
        }
    }

    /// Whether we computed this for the same `light` object.
    pub(super) fn is_of(&self, light: &Arc<Light>) -> bool {
        Arc::ptr_eq(&self.light, light)
    }

    /// Chromaticity as text, e.g. `x 0.3127  y 0.3290`.
    fn chromaticity_text(&self) -> String {
        let [x, y] = self.chromaticity;
        format!("x {x:.4}  y {y:.4}")
    }

    /// Temperature as text, e.g. `6504 K  Duv +0.0032`.
    fn temperature_text(&self) -> String {
        self.temperature.map_or_else(
            || tr("none: too far from any black body").to_owned(),
            |temperature| format!("{:.0} K  Duv {:+.4}", temperature.kelvin, temperature.duv),
        )
    }

    /// Draws the white point in two lines.
    pub(super) fn show(&self, ui: &mut Ui) {
        Grid::new("white").num_columns(2).spacing(vec2(10.0, 2.0)).show(ui, |ui| {
            ui.weak(tr("White")).on_hover_text(tr("Chromaticity of the light for the observer"));
            ui.monospace(self.chromaticity_text());
            ui.end_row();
            ui.weak(tr("Looks like")).on_hover_text(tr(
                "Correlated colour temperature, and distance from the black body of \
                 that temperature: above 0 greener, below 0 pinker",
            ));
            ui.monospace(self.temperature_text());
            ui.end_row();
        });
    }
}
