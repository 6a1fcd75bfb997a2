//! The eight tubes, and what is done with them.

use eframe::egui::{
    Button, DragAndDrop, Id, LayerId, Order, Rect, Response, RichText, Sense, Slider, Ui, vec2,
};
use render::layer::SLOTS;

use super::chooser::Chooser;
use super::squeeze::{DraggedTube, load};
use super::tube;
use crate::panels::controls::{back, button, item, slider};
use crate::panels::pigments::{Catalogue, Exchange, Known, Place, card};
use crate::panels::{Desk, Mode};

/// The panel of the tubes.
#[derive(Debug, Clone, Default)]
pub struct Tubes {
    known: Known,
    chooser: Chooser,
    exchange: Exchange,
}

impl Tubes {
    /// Shows it: as many tubes side by side as there is room for.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let catalogue = self.known.of(desk.easel);
        let room = ui.available_width() + 2.0;
        let beside = ((room / (tube::ROOM.x + 2.0)) as usize).clamp(1, SLOTS);
        // Rows of equal length look calmer: 4 and 4, not 5 and 3.
        let beside = SLOTS.div_ceil(SLOTS.div_ceil(beside));
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
            for first in (0..SLOTS).step_by(beside) {
                ui.horizontal(|ui| {
                    for slot in first..(first + beside).min(SLOTS) {
                        self.tube(ui, &catalogue, desk, slot);
                    }
                });
            }
        });
        self.chosen(ui, desk);
        let context = ui.ctx().clone();
        drag(ui, desk);
        self.chooser.show(&context, &catalogue, desk);
        self.exchange.show(&context, "exchange a tube", &catalogue, desk);
    }

    /// Opens the window that chooses the pigments on the palette, for a slot.
    pub fn choose(&mut self, slot: usize) {
        self.chooser.open(slot.min(SLOTS - 1));
    }

    fn tube(&mut self, ui: &mut Ui, catalogue: &Catalogue, desk: &mut Desk<'_>, slot: usize) {
        let (rect, response) = ui.allocate_exact_size(tube::ROOM, Sense::click_and_drag());
        let Some(pigment) = desk.easel.slots[slot] else {
            back(ui, &response, &format!("empty slot {}", slot + 1), false);
            tube::draw_empty(ui, rect);
            if response.clicked() {
                self.chooser.open(slot);
            }
            response.on_hover_text("Puts a pigment of the library on the palette");
            return;
        };
        let name = catalogue.name(pigment);
        back(ui, &response, &format!("tube of {name}"), slot == desk.tools.tube);
        let (masstone, tint) = (desk.easel.masstones[slot], desk.easel.tints[slot]);
        tube::draw(ui, rect, masstone, tint, name);
        response.dnd_set_drag_payload(DraggedTube { slot });
        clicked(&response, desk, slot);
        response.context_menu(|ui| self.menu(ui, desk, slot, pigment));
        let scattering = desk.easel.medium.scattering_per_mm;
        response.on_hover_ui(|ui| {
            card(ui, catalogue, pigment, scattering);
            ui.weak("Click, then click on the palette to squeeze. Double click loads the brush.");
        });
    }

    fn menu(&mut self, ui: &mut Ui, desk: &mut Desk<'_>, slot: usize, pigment: usize) {
        if item(ui, "Load the brush", "Puts this paint on the brush in hand", no_brush(desk)) {
            desk.tools.tube = slot;
            load(desk, slot);
        }
        let tip = "The next clicks on palette or canvas squeeze this paint";
        if item(ui, "Squeeze", tip, None) {
            desk.tools.tube = slot;
            desk.tools.mode = Mode::Squeeze;
        }
        ui.separator();
        let tip = "Puts a pigment of the library into this slot";
        if item(ui, "Put another here...", tip, None) {
            self.chooser.open(slot);
        }
        let tip = "Changes what is painted already, as if with another pigment";
        if item(ui, "Exchange in the painting...", tip, None) {
            self.exchange.open(pigment, Place::Everywhere);
        }
    }

    /// What is done with the tube that was last chosen.
    fn chosen(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let slot = desk.tools.tube.min(SLOTS - 1);
        let held = desk.easel.slots[slot];
        let name = held.map(|pigment| desk.easel.library.pigments[pigment].name.as_str());
        ui.label(RichText::new(name.unwrap_or("no tube chosen")).strong());
        ui.horizontal(|ui| {
            let empty = name.is_none().then_some("the slot is empty");
            let tip = "Puts this paint on the brush in hand, as high and as thinned as set there";
            if button(ui, "Load brush", tip, empty.or(no_brush(desk))) {
                load(desk, slot);
            }
            let squeezing = desk.tools.mode == Mode::Squeeze;
            let tip = "While it is on, a click on palette or canvas squeezes this paint";
            ui.add_enabled_ui(empty.is_none(), |ui| {
                let toggle = ui.add(Button::new("Squeeze").selected(squeezing));
                let toggle = toggle.on_hover_text(tip);
                if toggle.on_disabled_hover_text("the slot is empty").clicked() {
                    desk.tools.mode = if squeezing { Mode::Paint } else { Mode::Squeeze };
                }
            });
            if button(ui, "Tubes...", "Chooses which pigments are on the palette", None) {
                self.chooser.open(slot);
            }
        });
        let amount = Slider::new(&mut desk.tools.squeeze_mm3, 1.0..=1000.0).logarithmic(true);
        let amount = amount.fixed_decimals(0).suffix(" mm3");
        slider(ui, "Amount", "How much one squeeze gives, in cubic millimetres", amount);
    }
}

/// Why no brush can be loaded.
fn no_brush(desk: &Desk<'_>) -> Option<&'static str> {
    let known = desk.easel.brushes.iter().any(|brush| brush.name == desk.tools.brush);
    (!known).then_some("there is no brush in hand")
}

fn clicked(response: &Response, desk: &mut Desk<'_>, slot: usize) {
    if response.double_clicked() {
        desk.tools.tube = slot;
        if no_brush(desk).is_none() {
            load(desk, slot);
        }
    } else if response.clicked() || response.drag_started() {
        desk.tools.tube = slot;
        if response.clicked() {
            desk.tools.mode = Mode::Squeeze;
        }
    }
}

/// A drop of paint at the pointer while a tube is dragged.
fn drag(ui: &Ui, desk: &Desk<'_>) {
    let Some(dragged) = DragAndDrop::payload::<DraggedTube>(ui.ctx()) else { return };
    let Some(pointer) = ui.ctx().pointer_interact_pos() else { return };
    let Some(color) = desk.easel.masstones[dragged.slot] else { return };
    let layer = LayerId::new(Order::Tooltip, Id::unique("dragged tube"));
    let everywhere = Rect::EVERYTHING;
    tube::draw_drop(&ui.ctx().layer_painter(layer).with_clip_rect(everywhere), pointer, color);
}
