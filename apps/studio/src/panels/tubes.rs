//! The tube panel beside the palette. You squeeze paint from eight tubes, load brushes from them,
//! and choose their pigments in a window.

use eframe::egui::{
    Align, Button, Color32, Context, CornerRadius, DragAndDrop, Id, LayerId, Mesh, Order, Painter,
    Pos2, Rect, Response, RichText, Sense, Shape, Slider, Stroke, StrokeKind, TextStyle, Ui, Vec2,
    pos2, vec2,
};
use paint::layer::SLOTS;
use paint::strokes::{Action, PaletteSpec, Recipe, Squeeze, SurfaceId};
use pigment::PigmentId;

use crate::language::{tr, tr_format};
use crate::panels::controls::{
    button, button_background, item, patch, slider, text, text_from_top,
};
use crate::panels::pigments::{
    Catalogue, CatalogueCache, Exchange, ExchangeScope, PigmentList, card,
};
use crate::panels::{FileRequest, Mode, PanelContext};
use crate::{floating, theme};

pub(super) use draw as draw_tube;

const GAP: f32 = 2.0;

/// Largest tube, as a multiple of its usual size.
const LARGEST: f32 = 2.0;

/// Tubes may be wider than in proportion to their height, by this factor at most.
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
        let per_row = ((area / (TUBE_SIZE.x + 2.0)) as usize).clamp(1, SLOTS);
        // We make rows of equal length, e.g. 4 and 4 instead of 5 and 3.
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
            draw_empty(ui, rect);
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
        draw(ui, rect, masstone, tint, name);
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

/// Smallest width of a panel `height` points high in which you see all tubes and their controls.
#[must_use]
pub fn least_width(ui: &Ui, height: f32) -> f32 {
    let row = TUBE_SIZE.y + GAP;
    let rows = ((height - controls_height(ui)) / row).floor().clamp(1.0, SLOTS as f32);
    (SLOTS as f32 / rows).ceil() * (TUBE_SIZE.x + GAP)
}

fn controls_height(ui: &Ui) -> f32 {
    2.0 * ui.spacing().interact_size.y + CONTROLS
}

/// Size of a tube if `rows` of `per_row` tubes share `room` points. Tubes grow up to twice their
/// usual size.
fn tube_size(room: Vec2, per_row: usize, rows: usize) -> Vec2 {
    let usual = TUBE_SIZE;
    let wide = (room.x / per_row as f32 - GAP) / usual.x;
    let high = (room.y / rows as f32 - GAP) / usual.y;
    // Wider tubes have room for their names, even if they cannot be higher.
    let high = high.min(wide).clamp(1.0, LARGEST);
    vec2(usual.x * wide.clamp(1.0, LARGEST.min(WIDER * high)), usual.y * high)
}

/// Why you cannot load a brush, if so.
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

fn drag(ui: &Ui, cx: &PanelContext<'_>) {
    let Some(dragged) = DragAndDrop::payload::<DraggedTube>(ui.ctx()) else { return };
    let Some(pointer) = ui.ctx().pointer_interact_pos() else { return };
    let Some(color) = cx.painting.masstones[dragged.slot] else { return };
    let layer = LayerId::new(Order::Tooltip, Id::unique("dragged tube"));
    let everywhere = Rect::EVERYTHING;
    draw_drop(&ui.ctx().layer_painter(layer).with_clip_rect(everywhere), pointer, color);
}

/// Size of a tube with its name, in points.
pub(super) const TUBE_SIZE: Vec2 = vec2(61.0, 118.0);

const NAME_HEIGHT: f32 = 34.0;

/// From this factor on, names have the font of buttons.
const LARGE: f32 = 1.35;

/// Shading of the metal: position from left (0) to right (1), and grey level.
const METAL: [(f32, u8); 6] =
    [(0.0, 96), (0.12, 168), (0.32, 214), (0.55, 186), (0.85, 126), (1.0, 82)];

/// Draws a tube standing on its cap, with masstone and tint (sRGB) on its label.
pub(super) fn draw(
    ui: &Ui,
    area: Rect,
    masstone: Option<[u8; 3]>,
    tint: Option<[u8; 3]>,
    name: &str,
) {
    let painter = ui.painter_at(area);
    let body = body(area);
    crimp(&painter, body);
    tapered(&painter, body);
    let cap = Rect::from_center_size(
        pos2(body.center().x, body.bottom() + 11.0),
        vec2(body.width() * 0.42, 12.0),
    );
    shoulder(&painter, body, cap);
    painter.rect_filled(cap, 2.0, Color32::from_gray(22));
    for ridge in 1..6 {
        let x = cap.left() + cap.width() * ridge as f32 / 6.0;
        painter.vline(x, cap.y_range().shrink(2.0), Stroke::new(1.0, Color32::from_gray(52)));
    }
    let label = Rect::from_min_max(
        pos2(body.left() + 3.0, body.top() + 9.0),
        pos2(body.right() - 3.0, body.bottom() - 5.0),
    );
    let (full, light) = label.split_top_bottom_at_fraction(0.62);
    patch(&painter, light, tint);
    patch(&painter, full, masstone);
    names(ui, area, name);
}

fn draw_empty(ui: &Ui, area: Rect) {
    let body = body(area).shrink(1.0);
    let painter = ui.painter();
    let line = Stroke::new(1.0, theme::colors(ui.ctx()).line);
    painter.rect(body, CornerRadius::same(3), Color32::TRANSPARENT, line, StrokeKind::Inside);
    let plus = Stroke::new(1.5, theme::colors(ui.ctx()).faint);
    let middle = body.center();
    painter.hline(middle.x - 6.0..=middle.x + 6.0, middle.y, plus);
    painter.vline(middle.x, middle.y - 6.0..=middle.y + 6.0, plus);
    names(ui, area, tr("empty"));
}

/// Draws the drop of paint that follows the pointer while a tube is dragged.
fn draw_drop(painter: &Painter, at: Pos2, [red, green, blue]: [u8; 3]) {
    let drop = at + vec2(14.0, 14.0);
    painter.circle(
        drop,
        8.0,
        Color32::from_rgb(red, green, blue),
        Stroke::new(1.5, theme::colors(painter.ctx()).strong),
    );
}

fn body(area: Rect) -> Rect {
    let width = (area.width() * 0.68).min(area.height() * 0.42);
    let left = area.center().x - width / 2.0;
    Rect::from_min_max(
        pos2(left, area.top() + 5.0),
        pos2(left + width, area.bottom() - NAME_HEIGHT - 19.0),
    )
}

fn crimp(painter: &Painter, body: Rect) {
    let fold = Rect::from_min_max(
        pos2(body.left() - 1.0, body.top()),
        pos2(body.right() + 1.0, body.top() + 5.0),
    );
    painter.rect_filled(fold, 1.0, Color32::from_gray(150));
    painter.hline(fold.x_range(), fold.center().y, Stroke::new(1.0, Color32::from_gray(104)));
}

fn tapered(painter: &Painter, body: Rect) {
    let mut mesh = Mesh::default();
    for (index, (place, grey)) in METAL.into_iter().enumerate() {
        let color = Color32::from_gray(grey);
        let [top, bottom] =
            [0.0, 1.5].map(|inset: f32| body.left() + inset + (body.width() - 2.0 * inset) * place);
        mesh.colored_vertex(pos2(top, body.top() + 5.0), color);
        mesh.colored_vertex(pos2(bottom, body.bottom()), color);
        let last = 2 * index as u32;
        if index > 0 {
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last + 1, last);
        }
    }
    painter.add(Shape::mesh(mesh));
}

fn shoulder(painter: &Painter, body: Rect, cap: Rect) {
    let points = vec![
        pos2(body.left() + 1.5, body.bottom()),
        pos2(body.right() - 1.5, body.bottom()),
        pos2(cap.right() - 2.0, cap.top()),
        pos2(cap.left() + 2.0, cap.top()),
    ];
    painter.add(Shape::convex_polygon(points, Color32::from_gray(136), Stroke::NONE));
}

/// Draws the name below the tube, in as many lines as it needs.
fn names(ui: &Ui, area: Rect, name: &str) {
    let below = Rect::from_min_max(pos2(area.left() + 1.0, area.bottom() - NAME_HEIGHT), area.max);
    let large = area.width() > LARGE * TUBE_SIZE.x;
    let style = if large { TextStyle::Body } else { TextStyle::Small };
    let color = theme::colors(ui.ctx()).text;
    text_from_top(ui, below.shrink2(vec2(1.0, 1.0)), Align::Center, style, color, name);
}

const WIDTH: f32 = 400.0;

#[derive(Debug, Clone, Default)]
struct Chooser {
    open: bool,
    slot: usize,
    list: PigmentList,
}

impl Chooser {
    /// Opens the window for a slot.
    fn open(&mut self, slot: usize) {
        *self = Self { open: true, slot, list: PigmentList::default() };
    }

    fn show(&mut self, context: &Context, catalogue: &Catalogue, cx: &mut PanelContext<'_>) {
        let mut open = self.open;
        floating::show(context, tr("Choose tubes"), tr("choose tubes"), &mut open, |ui| {
            ui.set_width(WIDTH);
            self.contents(ui, catalogue, cx);
        });
        self.open = open;
    }

    fn contents(&mut self, ui: &mut Ui, catalogue: &Catalogue, cx: &mut PanelContext<'_>) {
        ui.horizontal(|ui| {
            for slot in 0..SLOTS {
                self.slot(ui, catalogue, cx.painting.slots[slot], slot);
            }
        });
        ui.horizontal(|ui| {
            let held = cx.painting.slots[self.slot];
            let name = held.map_or(tr("empty"), |pigment| catalogue.name(pigment));
            ui.label(tr_format!("Slot {slot}: {name}", slot = self.slot + 1, name));
            let disabled_reason = match held {
                None => Some(tr("the slot is empty")),
                Some(_) if cx.painting.slots.iter().flatten().count() == 1 => {
                    Some(tr("the palette needs at least one pigment"))
                }
                Some(_) => None,
            };
            let tip = tr("Empties the slot; there must be no wet paint of it");
            if button(ui, tr("Take off"), tip, disabled_reason) {
                set_slot(cx, self.slot, None);
            }
        });
        ui.separator();
        ui.horizontal(|ui| {
            ui.label(&catalogue.library.title);
            let tip = tr("Opens a pigment library or a painting with its own");
            if button(ui, tr("Open another library..."), tip, None) {
                cx.file(FileRequest::Open(None));
            }
        });
        let slots = cx.painting.slots;
        let scattering = cx.painting.medium.scattering_per_mm;
        let chosen = self.list.show(ui, catalogue, scattering, |pigment| {
            let slot = slots.iter().position(|&held| held == Some(pigment))?;
            Some(tr_format!("it is already in slot {slot}", slot = slot + 1))
        });
        if let Some(pigment) = chosen {
            set_slot(cx, self.slot, Some(pigment));
        }
    }

    fn slot(&mut self, ui: &mut Ui, catalogue: &Catalogue, held: Option<PigmentId>, slot: usize) {
        let (rect, response) =
            ui.allocate_exact_size(theme::at_least(ui, vec2(42.0, 42.0)), Sense::click());
        button_background(
            ui,
            &response,
            &tr_format!("slot {slot}", slot = slot + 1),
            slot == self.slot,
        );
        let (upper, lower) = rect.shrink(5.0).split_top_bottom_at_fraction(0.6);
        let color = held.map(|pigment| catalogue.colors(pigment).masstone_srgb);
        patch(ui.painter(), upper, color);
        let number = (slot + 1).to_string();
        text(ui, lower, Align::Center, TextStyle::Small, theme::colors(ui.ctx()).text, &number);
        if response.clicked() {
            self.slot = slot;
        }
        let name = held.map_or(tr("empty"), |pigment| catalogue.name(pigment));
        response.on_hover_text(tr_format!("{name}: choose the pigment of this slot", name));
    }
}

/// Queues a palette with another pigment in one slot, or none.
fn set_slot(cx: &mut PanelContext<'_>, slot: usize, pigment: Option<PigmentId>) {
    let mut slots = cx.painting.slots;
    slots[slot] = pigment;
    let library = &cx.painting.library;
    let names = slots.iter().flatten().map(|&pigment| library[pigment].name.as_str());
    cx.act(Action::Palette(PaletteSpec::from_names(names)));
}

/// Drag payload of a tube. If you drop it on a surface, this squeezes paint there with [`squeeze`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DraggedTube {
    /// Slot of the tube.
    pub slot: usize,
}

/// Squeezes the volume set in the tools from a slot's tube onto a surface. Pass the position in mm
/// from the upper left corner. This does nothing for an empty slot.
pub fn squeeze(cx: &mut PanelContext<'_>, slot: usize, on: SurfaceId, x_mm: f64, y_mm: f64) {
    let Some(recipe) = recipe(cx, slot) else { return };
    let volume_mm3 = cx.tools.squeeze_mm3;
    cx.act(Action::Squeeze(Squeeze { on, recipe, vehicle: 0.0, x_mm, y_mm, volume_mm3 }));
}

/// Loads the selected brush from a slot's tube, with the medium and height set in the tools, and
/// selects the paint tool. This does nothing for an empty slot.
pub fn load(cx: &mut PanelContext<'_>, slot: usize) {
    if let Some(recipe) = recipe(cx, slot) {
        let vehicle = cx.tools.vehicle;
        cx.load(recipe, vehicle);
    }
}

/// Recipe with only the pigment of this slot.
fn recipe(cx: &PanelContext<'_>, slot: usize) -> Option<Recipe> {
    let pigment = (*cx.painting.slots.get(slot)?)?;
    Some(Recipe::from([(cx.painting.library[pigment].name.clone(), 1.0)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tubes_grow_with_the_room_up_to_twice_their_size() {
        let size = |x: f32, y: f32| tube_size(vec2(x, y), 8, 1) / TUBE_SIZE;
        assert_eq!(size(100.0, 100.0), vec2(1.0, 1.0));
        assert_eq!(size(4000.0, 4000.0), vec2(2.0, 2.0));
        let high = size(8.0 * (1.5 * TUBE_SIZE.x + GAP), 4000.0);
        assert!((high - vec2(1.5, 1.5)).length() < 1e-5, "as wide as there is room: {high}");
        assert_eq!(size(4000.0, 10.0), vec2(1.4, 1.0), "wider, for the names");
    }
}
