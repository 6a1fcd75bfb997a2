//! The panel of the light.

use eframe::egui::{Button, Color32, ComboBox, Grid, Slider, Ui, vec2};
use render::optics::Gloss;
use render::paint::document::Lighting;
use render::paint::strokes::Action;
use spectra::{Observer, light_from_text};

use super::super::desk::Desk;
use super::super::draft::{Draft, Touch};
use super::choice::Choice;
use super::curve::powers;
use super::dome::{Direction, dome, told as told_direction};
use super::gloss_pad::{gloss_pad, told as told_gloss};
use super::row::row;
use super::white::White;
use crate::files::FileRequest;
use crate::theme;
use session::Command;

/// Side of the half sphere, in points.
const DOME: f32 = 104.0;

/// The light that paintings are most often seen under besides daylight.
const BULB: &str = "A";

/// The light as it is being set.
#[derive(Debug)]
pub struct LightPanel {
    first: Choice,
    second: Choice,
    /// The illuminant before the one there is.
    before: String,
    /// What the second light was when it was last switched off.
    kept_second: String,
    lighting: Draft<Lighting>,
    gloss: Draft<(Gloss, Gloss)>,
    white: Option<White>,
}

impl Default for LightPanel {
    fn default() -> Self {
        Self {
            first: Choice::new("Illuminant", "Temperature"),
            second: Choice::new("Second illuminant", "Second temperature"),
            before: BULB.to_owned(),
            kept_second: BULB.to_owned(),
            lighting: Draft::default(),
            gloss: Draft::default(),
            white: None,
        }
    }
}

impl LightPanel {
    /// Shows the panel, and asks for what is changed.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let now = ui.input(|input| input.time);
        let told = &desk.easel.lighting;
        let lighting = self.lighting.shown(told, same_lighting, now);
        self.illuminant(ui, desk, &lighting);
        self.spectrum(ui, desk);
        ui.separator();
        self.direction(ui, desk, lighting.clone());
        ui.separator();
        self.shine(ui, desk);
        ui.separator();
        self.split(ui, desk, &lighting);
    }

    fn illuminant(&mut self, ui: &mut Ui, desk: &mut Desk<'_>, lighting: &Lighting) {
        if let Some(illuminant) = self.first.show(ui, &lighting.illuminant) {
            self.take(ui, desk, Lighting { illuminant, ..lighting.clone() });
        }
        ui.horizontal(|ui| {
            let lamp = ui.button("Measured lamp\u{2026}");
            if lamp.on_hover_text("Paint under a lamp measured with an instrument").clicked() {
                desk.file(FileRequest::OpenLamp);
            }
            let mut observer = lighting.observer.clone();
            let combo = ComboBox::from_id_salt("observer")
                .selected_text(observer.clone())
                .width(ui.available_width());
            let combo = combo.show_ui(ui, |ui| {
                for one in Observer::ALL {
                    let line =
                        ui.selectable_value(&mut observer, one.name().to_owned(), one.name());
                    line.on_hover_text(described(one));
                }
            });
            let response = combo.response.accessible_name("Observer");
            response.on_hover_text("Whose eyes: the CIE's standard observer and its field of view");
            if observer != lighting.observer {
                self.take(ui, desk, Lighting { observer, ..lighting.clone() });
            }
        });
    }

    /// Exchanges the illuminant for the one before; at first for a bulb.
    pub fn exchange(&mut self, desk: &mut Desk<'_>) {
        let now = &desk.easel.lighting;
        let illuminant = std::mem::replace(&mut self.before, now.illuminant.clone());
        let lighting = Lighting { illuminant, ..now.clone() };
        desk.command(Command::Apply(Action::Light(lighting)));
    }

    fn take(&mut self, ui: &Ui, desk: &mut Desk<'_>, lighting: Lighting) {
        self.lighting.set(lighting.clone(), ui.input(|input| input.time));
        if lighting.illuminant != desk.easel.lighting.illuminant {
            self.before.clone_from(&desk.easel.lighting.illuminant);
        }
        desk.command(Command::Apply(Action::Light(lighting)));
    }

    fn spectrum(&mut self, ui: &mut Ui, desk: &Desk<'_>) {
        let light = &desk.easel.light;
        let mut others = Vec::new();
        let mut add = |name: Option<String>, color: Color32| {
            let other = name.and_then(|name| light_from_text(&name).ok());
            others.extend(other.map(|other| (other, color)));
        };
        add(
            desk.easel.second_lighting.as_ref().map(|second| second.illuminant.clone()),
            theme::FAINT,
        );
        add(self.first.wished().or(self.second.wished()), theme::STRONG);
        powers(ui, light, &others);
        if !self.white.as_ref().is_some_and(|white| white.is_of(light)) {
            self.white = Some(White::of(light));
        }
        let Some(white) = &self.white else { return };
        Grid::new("white").num_columns(2).spacing(vec2(10.0, 2.0)).show(ui, |ui| {
            ui.weak("White").on_hover_text("Chromaticity of the light for the observer");
            ui.monospace(white.told_chromaticity());
            ui.end_row();
            ui.weak("Looks like").on_hover_text(
                "Correlated colour temperature, and how far the light is from the black body of \
                 that temperature: above 0 greener, below 0 pinker",
            );
            ui.monospace(white.told_temperature());
            ui.end_row();
        });
    }

    fn direction(&mut self, ui: &mut Ui, desk: &mut Desk<'_>, mut lighting: Lighting) {
        let mut touch = Touch::None;
        ui.horizontal(|ui| {
            let mut direction = Direction {
                azimuth_deg: lighting.azimuth_deg,
                elevation_deg: lighting.elevation_deg,
            };
            let (response, touched) = dome(ui, DOME, &mut direction, lighting.ambient);
            response.on_hover_text("Drag the light over the canvas: degrees clockwise from the top, and above the canvas. \
                 Arrow keys turn and raise it",
            );
            touch = touched;
            if touch != Touch::None {
                lighting.azimuth_deg = direction.azimuth_deg;
                lighting.elevation_deg = direction.elevation_deg;
            }
            ui.vertical(|ui| {
                ui.label("Direction");
                ui.weak(told_direction(direction));
                let ambient = Slider::new(&mut lighting.ambient, 0.0..=1.0);
                let ambient = ambient.fixed_decimals(2).update_while_editing(false);
                let ambient = row(ui, "Ambient", ambient).accessible_name("Ambient");
                let ambient = ambient.on_hover_text("Share of the light that comes from all sides");
                touch = touch.or(Touch::of(&ambient));
                let relief = Slider::new(&mut lighting.relief, 0.0..=3.0);
                let relief = relief.fixed_decimals(2).update_while_editing(false);
                let relief = row(ui, "Relief", relief).accessible_name("Relief");
                let relief = relief.on_hover_text("How much brush marks show: 0 flat, 1 as it is");
                touch = touch.or(Touch::of(&relief));
            });
        });
        let action = Action::Light(lighting.clone());
        adjust(ui, desk, touch, action, &mut self.lighting, lighting.clone());
        let moved = matches!(touch, Touch::LetGo | Touch::Set);
        if let Some(second) = desk.easel.second_lighting.as_ref().filter(|_| moved) {
            let illuminant = second.illuminant.clone();
            desk.command(Command::SetSecondLight(Some(Lighting { illuminant, ..lighting })));
        }
    }

    fn shine(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let now = ui.input(|input| input.time);
        let told = (desk.easel.medium.wet, desk.easel.medium.dry);
        let (mut wet, mut dry) = self.gloss.shown(&told, same_gloss, now);
        let mut touch = Touch::None;
        let side = (ui.available_width() - ui.spacing().item_spacing.x) / 2.0;
        ui.horizontal(|ui| {
            for (name, gloss) in [("Wet gloss", &mut wet), ("Dry gloss", &mut dry)] {
                ui.vertical(|ui| {
                    ui.horizontal(|ui| {
                        ui.label(name);
                        ui.weak(format!("{:.2}, {:.0}", gloss.strength, gloss.exponent));
                    });
                    let (response, touched) = gloss_pad(ui, name, vec2(side, 76.0), gloss);
                    let hover = format!(
                        "{name}: {}. Drag to the right for a sharper highlight, up for a stronger \
                         one",
                        told_gloss(*gloss)
                    );
                    response.on_hover_text(hover);
                    touch = touch.or(touched);
                });
            }
        });
        adjust(ui, desk, touch, Action::Gloss { wet, dry }, &mut self.gloss, (wet, dry));
    }

    fn split(&mut self, ui: &mut Ui, desk: &mut Desk<'_>, lighting: &Lighting) {
        let second = desk.easel.second_lighting.clone();
        let mut on = second.is_some();
        ui.horizontal(|ui| {
            let check = ui.checkbox(&mut on, "Second light");
            let check = check.on_hover_text(
                "Shows the canvas under two lights, side by side; drag the line between them",
            );
            if check.changed() {
                let illuminant = self.kept_second.clone();
                let second = on.then(|| Lighting { illuminant, ..lighting.clone() });
                desk.command(Command::SetSecondLight(second));
            }
            let swap = ui.add_enabled(second.is_some(), Button::new("Swap"));
            let swap = swap.on_hover_text("Exchanges the two lights");
            if let Some(second) = second.clone().filter(|_| swap.clicked()) {
                desk.command(Command::SetSecondLight(Some(lighting.clone())));
                self.take(ui, desk, second);
            }
        });
        let Some(second) = second else { return };
        self.kept_second.clone_from(&second.illuminant);
        if let Some(illuminant) = self.second.show(ui, &second.illuminant) {
            desk.command(Command::SetSecondLight(Some(Lighting {
                illuminant,
                ..lighting.clone()
            })));
        }
    }
}

/// Asks for an action as its control is touched, and keeps its value in `draft`.
fn adjust<T: Clone>(
    ui: &Ui,
    desk: &mut Desk<'_>,
    touch: Touch,
    action: Action,
    draft: &mut Draft<T>,
    value: T,
) {
    let now = ui.input(|input| input.time);
    match touch {
        Touch::None => return,
        Touch::Dragged => {
            desk.command(Command::Adjust(action));
            return draft.drag(value);
        }
        Touch::LetGo => {
            desk.command(Command::Adjust(action));
            desk.command(Command::EndAdjustment);
        }
        Touch::Set => desk.command(Command::Apply(action)),
    }
    draft.set(value, now);
}

fn same_lighting(a: &Lighting, b: &Lighting) -> bool {
    let numbers = |l: &Lighting| [l.azimuth_deg, l.elevation_deg, l.ambient, l.relief];
    // The record keeps six digits.
    let near = |(a, b): (f64, f64)| (a - b).abs() < 1e-3;
    a.illuminant == b.illuminant
        && a.observer == b.observer
        && numbers(a).into_iter().zip(numbers(b)).all(near)
}

fn same_gloss(a: &(Gloss, Gloss), b: &(Gloss, Gloss)) -> bool {
    let near = |a: Gloss, b: Gloss| {
        (a.strength - b.strength).abs() < 1e-3 && (a.exponent / b.exponent - 1.0).abs() < 1e-3
    };
    near(a.0, b.0) && near(a.1, b.1)
}

fn described(observer: Observer) -> &'static str {
    match observer {
        Observer::Cie1931Deg2 => "CIE 1931, 2 degrees: small fields, the usual one",
        Observer::Cie1964Deg10 => "CIE 1964, 10 degrees: large fields",
        Observer::Cie2015Deg2 => "CIE 2015, 2 degrees: from cone fundamentals",
        Observer::Cie2015Deg10 => "CIE 2015, 10 degrees: from cone fundamentals",
    }
}
