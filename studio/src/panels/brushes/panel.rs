//! The panel of the brushes.

use eframe::egui::{Key, Sense, Slider, TextEdit, Ui, vec2};
use render::paint::brush::HeadShape;
use render::paint::strokes::BrushSpec;

use super::care::{is_loaded, load_medium, wash, wipe};
use super::head;
use super::place::Row;
use super::stand::{SIZES_MM, Stand};
use crate::panels::controls::{NAME_WIDTH, back, button, item, percent, slider};
use crate::panels::{Desk, tubes};

/// The panel of the brushes: the stand, the head of the brush in hand, its paint.
#[derive(Debug, Clone, Default)]
pub struct Brushes {
    stand: Stand,
    /// The size while its slider is dragged, in mm.
    dragged_mm: Option<f64>,
    /// The brush that is being renamed, and what was typed.
    renaming: Option<(String, String)>,
}

/// What was asked of a row.
enum Asked {
    Take(usize),
    Keep,
    Rename(usize),
    PutAway(usize),
}

impl Brushes {
    /// Shows it.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        self.stand.follow(desk);
        self.stand(ui, desk);
        ui.separator();
        self.head(ui, desk);
        ui.separator();
        self.paint(ui, desk);
    }

    /// Takes the brush of a number key in hand, from 1; whether there is one.
    pub fn choose(&mut self, number: usize, desk: &mut Desk<'_>) -> bool {
        self.stand.follow(desk);
        let there = (1..=self.stand.places.len()).contains(&number);
        if there {
            self.stand.take(number - 1, desk);
        }
        there
    }

    /// Makes the brush in hand larger or smaller by a factor. The mean of its paint
    /// goes along.
    pub fn resize(&mut self, factor: f64, desk: &mut Desk<'_>) {
        self.stand.follow(desk);
        let Some(spec) = self.stand.spec(desk.easel, &desk.tools.brush) else { return };
        let size_mm = rounded(spec.size_mm * factor).clamp(*SIZES_MM.start(), *SIZES_MM.end());
        self.stand.exchange(BrushSpec { size_mm, ..spec }, desk);
    }

    /// The head of the brush in hand, as it was last asked for.
    #[must_use]
    pub fn in_hand(&self, desk: &Desk<'_>) -> Option<BrushSpec> {
        self.stand.spec(desk.easel, &desk.tools.brush)
    }

    fn stand(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let mut asked = None;
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            for place in 0..self.stand.places.len() {
                let name = self.stand.places[place].name.clone();
                if self.renaming.as_ref().is_some_and(|(renamed, _)| *renamed == name) {
                    self.rename(ui, place);
                } else if let Some(done) = self.place(ui, desk, place) {
                    asked = Some(done);
                }
            }
        });
        let hand = self.stand.find(&desk.tools.brush);
        let none = hand.is_none().then_some("there is no brush in hand");
        ui.horizontal(|ui| {
            let add = ui.menu_button("Add", |ui| self.add(ui, desk));
            add.response.on_hover_text("Takes another brush, clean, into the stand");
            let tip = "Keeps this brush as it is loaded, and takes a clean twin in hand";
            if button(ui, "Keep", tip, none) {
                asked = Some(Asked::Keep);
            }
            if button(ui, "Rename", "Gives this brush another name in the stand", none) {
                asked = hand.map(Asked::Rename);
            }
            let last = (self.stand.places.len() < 2).then_some("the last brush stays");
            let tip = "Takes this brush out of the stand";
            if button(ui, "Remove", tip, none.or(last)) {
                asked = hand.map(Asked::PutAway);
            }
        });
        match asked {
            Some(Asked::Take(place)) => self.stand.take(place, desk),
            Some(Asked::Keep) => self.stand.keep(desk),
            Some(Asked::PutAway(place)) => self.stand.put_away(place, desk),
            Some(Asked::Rename(place)) => {
                let place = &self.stand.places[place];
                self.renaming = Some((place.name.clone(), place.label.clone()));
            }
            None => {}
        }
    }

    fn place(&self, ui: &mut Ui, desk: &Desk<'_>, place: usize) -> Option<Asked> {
        let at = &self.stand.places[place];
        let spec = self.stand.spec(desk.easel, &at.name)?;
        let state = desk.easel.brushes.iter().find(|brush| brush.name == at.name);
        let in_hand = desk.tools.brush == at.name;
        let shown = Row { number: place + 1, label: &at.label, spec: &spec, state, in_hand };
        let response = shown.show(ui, desk.easel);
        let mut asked = response.clicked().then_some(Asked::Take(place));
        response.context_menu(|ui| {
            if item(ui, "Rename", "Gives this brush another name in the stand", None) {
                asked = Some(Asked::Rename(place));
            }
            let last = (self.stand.places.len() < 2).then_some("the last brush stays");
            if item(ui, "Remove", "Takes this brush out of the stand", last) {
                asked = Some(Asked::PutAway(place));
            }
        });
        asked
    }

    fn rename(&mut self, ui: &mut Ui, place: usize) {
        let Some((_, typed)) = &mut self.renaming else { return };
        let response = ui
            .add(TextEdit::singleline(typed).desired_width(f32::INFINITY).char_limit(40))
            .accessible_name("Name of the brush")
            .on_hover_text("Enter takes the name, Escape leaves it as it was");
        let (enter, escape) =
            ui.input(|input| (input.key_pressed(Key::Enter), input.key_pressed(Key::Escape)));
        if response.lost_focus() {
            let typed = typed.trim().to_owned();
            if !escape && !typed.is_empty() {
                self.stand.places[place].label = typed;
            }
            self.renaming = None;
        } else if !response.has_focus() && !enter {
            response.request_focus();
        }
    }

    fn add(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let size_mm = self.in_hand(desk).map_or(6.0, |spec| spec.size_mm);
        for shape in HeadShape::ALL {
            if item(ui, shape.name(), "As large as the brush in hand", None) {
                self.stand.add(shape.name(), BrushSpec { shape, size_mm }, desk);
            }
        }
    }

    fn head(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let Some(spec) = self.in_hand(desk) else {
            ui.weak("no brush in hand");
            return;
        };
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            let width = (ui.available_width() - 14.0) / 8.0;
            for shape in HeadShape::ALL {
                let size = vec2(width, 44.0);
                let (rect, response) = ui.allocate_exact_size(size, Sense::click());
                back(ui, &response, &format!("shape {shape}"), shape == spec.shape);
                head::draw(ui.painter(), rect.shrink(3.0), shape, None);
                if response.clicked() {
                    self.stand.exchange(BrushSpec { shape, ..spec.clone() }, desk);
                }
                response.on_hover_text(format!("{shape}; the mean of the paint goes along"));
            }
        });
        let mut size_mm = self.dragged_mm.unwrap_or_else(|| rounded(spec.size_mm));
        let control = Slider::new(&mut size_mm, SIZES_MM).logarithmic(true).suffix(" mm");
        let control = control.max_decimals(2).update_while_editing(false);
        let tip = "Width of the head; the mean of the paint goes along (keys [ and ])";
        let response = slider(ui, "Size", tip, control);
        ui.horizontal(|ui| {
            ui.add_space(NAME_WIDTH + ui.spacing().item_spacing.x);
            ui.weak(format!("{:.0} cells of the canvas", size_mm / desk.easel.cell_mm));
        });
        if response.changed() {
            self.dragged_mm = Some(rounded(size_mm));
        }
        if let Some(size_mm) = self.dragged_mm
            && !response.dragged()
        {
            self.stand.exchange(BrushSpec { size_mm, ..spec }, desk);
            self.dragged_mm = None;
        }
    }

    fn paint(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let none = self.in_hand(desk).is_none().then_some("there is no brush in hand");
        let height = Slider::new(&mut desk.tools.load_mm, 0.02..=2.0).logarithmic(true);
        let tip = "How high one load lies on the head";
        slider(ui, "Load", tip, height.fixed_decimals(2).suffix(" mm"));
        let tip = "Share of clear medium in a load: more of it is thinner and more transparent";
        percent(ui, "Medium", tip, &mut desk.tools.vehicle, 0.0..=100.0);
        ui.horizontal(|ui| {
            let slot = desk.tools.tube;
            let held = desk.easel.slots.get(slot).copied().flatten();
            let empty = held.is_none().then_some("no tube is chosen");
            let name =
                held.map_or("", |pigment| desk.easel.library.pigments[pigment].name.as_str());
            let tip = format!("Adds paint of the chosen tube to the brush: {name}");
            if button(ui, "Load from tube", &tip, none.or(empty)) {
                tubes::load(desk, slot);
            }
            let tip = "Adds clear medium to the brush, and no pigment";
            if button(ui, "Medium only", tip, none) {
                load_medium(desk);
            }
        });
        let tip = "The share of its paint that wiping leaves on the brush";
        percent(ui, "Wipe to", tip, &mut desk.tools.wipe_keep, 0.0..=100.0);
        ui.horizontal(|ui| {
            let clean = (!is_loaded(desk)).then_some("the brush is clean");
            if button(ui, "Wipe", "Takes paint off with a rag (key X)", none.or(clean)) {
                wipe(desk);
            }
            if button(ui, "Wash", "Takes all paint off (key W)", none.or(clean)) {
                wash(desk);
            }
        });
    }
}

/// A size to a tenth of a millimetre, below 1 mm to a hundredth.
fn rounded(size_mm: f64) -> f64 {
    let steps = if size_mm < 1.0 { 100.0 } else { 10.0 };
    (size_mm * steps).round() / steps
}
