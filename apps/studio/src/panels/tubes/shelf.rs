//! Draws the tube panel: eight tubes and their commands.

use eframe::egui::{
    Button, DragAndDrop, Id, LayerId, Order, Rect, Response, RichText, Sense, Slider, Ui, Vec2,
    vec2,
};
use paint::layer::SLOTS;
use pigment::PigmentId;

use super::chooser::Chooser;
use super::squeeze::{DraggedTube, load};
use super::tube;
use crate::language::{tr, tr_format};
use crate::panels::controls::{button, button_background, item, slider};
use crate::panels::pigments::{Catalogue, CatalogueCache, Exchange, ExchangeScope, card};
use crate::panels::{Mode, PanelContext};

/// Space between tubes, in points.
const GAP: f32 = 2.0;

/// Largest tube, as a factor of its usual size.
const LARGEST: f32 = 2.0;

/// Most that a tube is wider than its height asks for, as a factor.
const WIDER: f32 = 1.4;

/// Height of the name below the tubes, and of the gaps between the controls, in points.
const CONTROLS: f32 = 44.0;

/// State of the tube panel.
#[derive(Debug, Clone, Default)]
pub struct Tubes {
    catalogue: CatalogueCache,
    chooser: Chooser,
    exchange: Exchange,
}

impl Tubes {
    /// Draws the panel, with as many tubes in a row as fit.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let catalogue = self.catalogue.get(cx.painting);
        let area = ui.available_width() + 2.0;
        let per_row = ((area / (tube::TUBE_SIZE.x + 2.0)) as usize).clamp(1, SLOTS);
        // Rows of equal length: 4 and 4 instead of 5 and 3.
        let rows = SLOTS.div_ceil(per_row);
        let per_row = SLOTS.div_ceil(rows);
        let room = vec2(area, ui.clip_rect().bottom() - ui.cursor().top() - controls_height(ui));
        let size = tube_size(room, per_row, rows);
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
            for first in (0..SLOTS).step_by(per_row) {
                ui.horizontal(|ui| {
                    for slot in first..(first + per_row).min(SLOTS) {
                        self.tube(ui, &catalogue, cx, (slot, size));
                    }
                });
            }
        });
        self.chosen(ui, cx);
        let context = ui.ctx().clone();
        drag(ui, cx);
        self.chooser.show(&context, &catalogue, cx);
        self.exchange.show(&context, tr("exchange a tube"), &catalogue, cx);
    }

    /// Opens the window that chooses the pigment of a slot.
    pub fn choose(&mut self, slot: usize) {
        self.chooser.open(slot.min(SLOTS - 1));
    }

    fn tube(
        &mut self,
        ui: &mut Ui,
        catalogue: &Catalogue,
        cx: &mut PanelContext<'_>,
        (slot, size): (usize, Vec2),
    ) {
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        let Some(pigment) = cx.painting.slots[slot] else {
            button_background(
                ui,
                &response,
                &tr_format!("empty slot {slot}", slot = slot + 1),
                false,
            );
            tube::draw_empty(ui, rect);
            if response.clicked() {
                self.chooser.open(slot);
            }
            response.on_hover_text(tr("Puts a pigment of the library on the palette"));
            return;
        };
        let name = catalogue.name(pigment);
        button_background(
            ui,
            &response,
            &tr_format!("tube of {name}", name),
            slot == cx.tools.tube,
        );
        let masstone = cx.painting.masstones[slot];
        let tint = cx.painting.tints[slot];
        tube::draw(ui, rect, masstone, tint, name);
        response.dnd_set_drag_payload(DraggedTube { slot });
        clicked(&response, cx, slot);
        response.context_menu(|ui| self.menu(ui, cx, slot, pigment));
        let scattering = cx.painting.medium.scattering_per_mm;
        response.on_hover_ui(|ui| {
            card(ui, catalogue, pigment, scattering);
            ui.weak(tr(
                "Click, then click on the palette to squeeze. Double click loads the brush.",
            ));
        });
    }

    fn menu(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, slot: usize, pigment: PigmentId) {
        if item(
            ui,
            tr("Load the brush"),
            tr("Loads the selected brush with this paint"),
            no_brush(cx),
        ) {
            cx.tools.tube = slot;
            load(cx, slot);
        }
        let tip = tr("The next clicks on palette or canvas squeeze this tube");
        if item(ui, tr("Squeeze"), tip, None) {
            cx.tools.tube = slot;
            cx.tools.mode = Mode::Squeeze;
        }
        ui.separator();
        let tip = tr("Puts a pigment of the library into this slot");
        if item(ui, tr("Put another here..."), tip, None) {
            self.chooser.open(slot);
        }
        let tip = tr("Replaces the pigment in existing paint");
        if item(ui, tr("Exchange in the painting..."), tip, None) {
            self.exchange.open(pigment, ExchangeScope::AllLayers);
        }
    }

    /// Draws the commands of the selected tube.
    fn chosen(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let slot = cx.tools.tube.min(SLOTS - 1);
        let held = cx.painting.slots[slot];
        let name = held.map(|pigment| cx.painting.library[pigment].name.as_str());
        ui.label(RichText::new(name.unwrap_or(tr("no tube selected"))).strong());
        ui.horizontal(|ui| {
            let empty = name.is_none().then_some(tr("the slot is empty"));
            let tip = tr("Loads the selected brush, with the height and medium set in its panel");
            if button(ui, tr("Load brush"), tip, empty.or(no_brush(cx))) {
                load(cx, slot);
            }
            let squeezing = cx.tools.mode == Mode::Squeeze;
            let tip =
                tr("A click on palette or canvas squeezes this tube, until another tool is chosen");
            ui.add_enabled_ui(empty.is_none(), |ui| {
                let button = ui.add(Button::new(tr("Squeeze")).selected(squeezing));
                let button = button.on_hover_text(tip);
                if button.on_disabled_hover_text(tr("the slot is empty")).clicked() {
                    cx.tools.mode = Mode::Squeeze;
                }
            });
            if button(ui, tr("Tubes..."), tr("Chooses which pigments are on the palette"), None) {
                self.chooser.open(slot);
            }
        });
        let amount = Slider::new(&mut cx.tools.squeeze_mm3, 1.0..=1000.0).logarithmic(true);
        let amount = amount.fixed_decimals(0).suffix(" mm3");
        slider(ui, tr("Amount"), tr("Volume of one squeeze, in cubic millimetres"), amount);
    }
}

/// Least width at which all tubes and their controls are seen in a panel `height` points high.
#[must_use]
pub fn least_width(ui: &Ui, height: f32) -> f32 {
    let row = tube::TUBE_SIZE.y + GAP;
    let rows = ((height - controls_height(ui)) / row).floor().clamp(1.0, SLOTS as f32);
    (SLOTS as f32 / rows).ceil() * (tube::TUBE_SIZE.x + GAP)
}

/// Height of the controls below the tubes, in points.
fn controls_height(ui: &Ui) -> f32 {
    2.0 * ui.spacing().interact_size.y + CONTROLS
}

/// Size of a tube where `rows` of `per_row` tubes have `room` points: as large as they fit,
/// up to twice their usual size.
fn tube_size(room: Vec2, per_row: usize, rows: usize) -> Vec2 {
    let usual = tube::TUBE_SIZE;
    let wide = (room.x / per_row as f32 - GAP) / usual.x;
    let high = (room.y / rows as f32 - GAP) / usual.y;
    // Wider tubes have room for their names, also where they cannot be higher.
    let high = high.min(wide).clamp(1.0, LARGEST);
    vec2(usual.x * wide.clamp(1.0, LARGEST.min(WIDER * high)), usual.y * high)
}

/// Reason why no brush can be loaded, if any.
fn no_brush(cx: &PanelContext<'_>) -> Option<&'static str> {
    let known = cx.painting.brushes.iter().any(|brush| brush.name == cx.tools.brush);
    (!known).then_some(tr("no brush is selected"))
}

fn clicked(response: &Response, cx: &mut PanelContext<'_>, slot: usize) {
    if response.double_clicked() {
        cx.tools.tube = slot;
        if no_brush(cx).is_none() {
            load(cx, slot);
        }
    } else if response.clicked() || response.drag_started() {
        cx.tools.tube = slot;
        if response.clicked() {
            cx.tools.mode = Mode::Squeeze;
        }
    }
}

/// Draws a drop of paint at the pointer while a tube is dragged.
fn drag(ui: &Ui, cx: &PanelContext<'_>) {
    let Some(dragged) = DragAndDrop::payload::<DraggedTube>(ui.ctx()) else { return };
    let Some(pointer) = ui.ctx().pointer_interact_pos() else { return };
    let Some(color) = cx.painting.masstones[dragged.slot] else { return };
    let layer = LayerId::new(Order::Tooltip, Id::unique("dragged tube"));
    let everywhere = Rect::EVERYTHING;
    tube::draw_drop(&ui.ctx().layer_painter(layer).with_clip_rect(everywhere), pointer, color);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tubes_grow_with_the_room_up_to_twice_their_size() {
        let size = |x: f32, y: f32| tube_size(vec2(x, y), 8, 1) / tube::TUBE_SIZE;
        assert_eq!(size(100.0, 100.0), vec2(1.0, 1.0));
        assert_eq!(size(4000.0, 4000.0), vec2(2.0, 2.0));
        let high = size(8.0 * (1.5 * tube::TUBE_SIZE.x + GAP), 4000.0);
        assert!((high - vec2(1.5, 1.5)).length() < 1e-5, "as wide as there is room: {high}");
        assert_eq!(size(4000.0, 10.0), vec2(1.4, 1.0), "wider, for the names");
    }
}
