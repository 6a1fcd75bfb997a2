//! The layer panel: drying, and names, order, visibility, opacity and merging of layers.

mod row;

use eframe::egui::{
    Frame, Key, Margin, Modifiers, Rect, Response, RichText, Slider, Stroke, Ui, pos2,
};
use paint::document::{LayerId, Slots};
use paint::strokes::{Action, LayerRef};
use session::LayerState;

use crate::keymap::hint;
use crate::language::{english, tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::context::{Edit, PendingValue};
use crate::panels::controls::{button, item, named_button, percent, slider};
use crate::panels::pigments::{Catalogue, CatalogueCache, Exchange, ExchangeScope};
use crate::theme;
use row::{Naming, Opacity, RowLook, RowParts, Thumbnails, pigments, row};

/// State of the layer panel.
#[derive(Debug, Clone, Default)]
pub struct Layers {
    catalogue: CatalogueCache,
    exchange: Exchange,
    opacity: Opacity,
    stiffness: PendingValue<f64>,
    thumbnails: Thumbnails,
    chosen: Chosen,
    naming: Naming,
    order: Order,
}

/// Choice in the menu of a layer. The panel carries it out after the row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum MenuChoice {
    Rename,
    Exchange,
}

/// Dries a share of the canvas's wet paint, as set in the tools.
pub fn dry(cx: &mut PanelContext<'_>) {
    let fraction = cx.tools.dry_share;
    cx.act(Action::Dry { fraction });
}

impl Layers {
    /// Draws the panel: drying, the wet layer, then dry layers from the top down.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let catalogue = self.catalogue.get(cx.painting);
        self.chosen.keep(&cx.painting.layers);
        drying(ui, cx);
        self.wet(ui, &catalogue, cx);
        for layer in (0..cx.painting.layers.len()).rev() {
            self.dry_layer(ui, &catalogue, cx, layer);
        }
        self.order.finish(ui, cx);
        self.rename_by_key(ui, cx);
        match cx.painting.layers.len() {
            0 => _ = ui.weak(tr("There is no dry paint yet.")),
            1 => {}
            _ => self.merge_button(ui, cx),
        }
        self.thumbnails.keep(cx.painting.layers.iter().map(|layer| &layer.thumbnail));
        let context = ui.ctx().clone();
        self.exchange.show(&context, tr("exchange in a layer"), &catalogue, cx);
    }

    fn wet(&mut self, ui: &mut Ui, catalogue: &Catalogue, cx: &mut PanelContext<'_>) {
        group(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new(tr("Wet")).strong());
                pigments(ui, catalogue, &cx.painting.slots);
            });
            stiffness(ui, cx, &mut self.stiffness);
            let first = cx.painting.slots.iter().flatten().next();
            let none = first.is_none().then_some(tr("the layer has no pigment"));
            let name = tr("exchange in the wet layer");
            if named_button(ui, tr("Exchange pigment..."), name, tr(EXCHANGE), none) {
                self.open_exchange(&cx.painting.slots, LayerRef::Wet);
            }
        });
    }

    fn dry_layer(
        &mut self,
        ui: &mut Ui,
        catalogue: &Catalogue,
        cx: &mut PanelContext<'_>,
        index: usize,
    ) {
        let state = cx.painting.layers[index].clone();
        let id = state.id;
        let look = RowLook { chosen: self.chosen.contains(id), dragged: self.order.is_dragged(id) };
        let mut parts = RowParts {
            naming: &mut self.naming,
            opacity: &mut self.opacity,
            thumbnails: &mut self.thumbnails,
            catalogue,
        };
        let mut choice = None;
        let drawn = row(ui, cx, &mut parts, (&state, look), |ui, cx| {
            choice = menu(ui, cx, index);
        });
        self.order.row(id, &drawn.response);
        if drawn.response.clicked() {
            self.chosen.click(id, ui.input(|input| input.modifiers));
        }
        let on_name = drawn.name.zip(drawn.response.interact_pointer_pos());
        let on_name = on_name.is_some_and(|(name, at)| name.contains(at));
        let by_key = drawn.response.has_focus() && ui.input(|input| input.key_pressed(Key::F2));
        if choice == Some(MenuChoice::Rename)
            || (drawn.response.double_clicked() && on_name)
            || by_key
        {
            self.naming.begin(&state);
        }
        if choice == Some(MenuChoice::Exchange) {
            self.open_exchange(&state.slots, LayerRef::Id(id));
        }
    }

    /// If one layer is chosen and you are not editing text, F2 renames it.
    fn rename_by_key(&mut self, ui: &Ui, cx: &PanelContext<'_>) {
        let Some(id) = self.chosen.one().filter(|id| !self.naming.is_of(*id)) else { return };
        let typing = ui.ctx().text_edit_focused();
        if !typing
            && ui.input(|input| input.key_pressed(Key::F2))
            && let Some(layer) = cx.painting.layers.iter().find(|layer| layer.id == id)
        {
            self.naming.begin(layer);
        }
    }

    fn merge_button(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let two = self.chosen.two();
        let disabled_reason = match two.and_then(|two| states(&cx.painting.layers, two)) {
            None => Some(tr("choose two layers: click one, Ctrl+click the other")),
            Some([a, b]) => merge_obstacle(a, b),
        };
        let tip = tr("Merges the two chosen layers into one, without a visible change");
        if button(ui, tr("Merge chosen"), tip, disabled_reason)
            && let Some([layer, with]) = two
        {
            let layer = LayerRef::Id(layer);
            let with = Some(LayerRef::Id(with));
            cx.act(Action::Merge { layer, with });
        }
    }

    fn open_exchange(&mut self, slots: &Slots, layer: LayerRef) {
        if let Some(&first) = slots.iter().flatten().next() {
            self.exchange.open(first, ExchangeScope::Layer(layer));
        }
    }
}

const EXCHANGE: &str =
    english("Replaces a pigment of this layer, as if painted with the other one");

fn menu(ui: &mut Ui, cx: &mut PanelContext<'_>, index: usize) -> Option<MenuChoice> {
    let layers = &cx.painting.layers;
    let state = &layers[index];
    let top = layers.len() - 1;
    let layer = LayerRef::Id(state.id);
    let below = index.checked_sub(1).map(|below| &layers[below]);
    let obstacle = match below {
        None => Some(tr("there is no dry layer below it")),
        Some(below) => merge_obstacle(state, below),
    };
    let merge = Action::Merge { layer, with: below.map(|below| LayerRef::Id(below.id)) };
    let empty = state.slots.iter().all(Option::is_none).then_some(tr("the layer has no pigment"));
    let highest = (index == top).then_some(tr("it is the topmost dry layer"));
    let lowest = (index == 0).then_some(tr("it is the lowest layer"));
    let mut choice = None;
    if item(ui, tr("Rename (F2)"), tr("Edits the name of this layer"), None) {
        choice = Some(MenuChoice::Rename);
    }
    let up = tr("Lays this film over the next one above; wet paint stays above all");
    if item(ui, tr("Move up"), up, highest) {
        cx.act(Action::Order { layer, to: index + 1 });
    }
    if item(ui, tr("Move down"), tr("Lays this film under the next one below"), lowest) {
        cx.act(Action::Order { layer, to: index - 1 });
    }
    let tip = tr("Merges this layer with the one below, without a visible change");
    if item(ui, tr("Merge down"), tip, obstacle) {
        cx.act(merge);
    }
    if item(ui, tr("Exchange pigment..."), tr(EXCHANGE), empty) {
        choice = Some(MenuChoice::Exchange);
    }
    choice
}

fn drying(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    let tip = tr("Share of the wet paint that dries, from the bottom up");
    percent(ui, tr("Share"), tip, &mut cx.tools.dry_share, 1.0..=100.0);
    ui.horizontal(|ui| {
        let key = hint(ui.ctx(), "dry");
        let tip = &tr_format!("Dries that share of the wet paint into a new dry layer{key}", key);
        if button(ui, tr("Dry share"), tip, None) {
            dry(cx);
        }
        if button(ui, tr("Dry all"), tr("Dries all wet paint into a new dry layer"), None) {
            cx.act(Action::Dry { fraction: 1.0 });
        }
    });
}

fn states(layers: &[LayerState], ids: [LayerId; 2]) -> Option<[&LayerState; 2]> {
    let [first, second] = ids.map(|id| layers.iter().find(|layer| layer.id == id));
    Some([first?, second?])
}

/// Why two dry layers cannot be merged, if we know it before comparing the paint.
fn merge_obstacle(a: &LayerState, b: &LayerState) -> Option<&'static str> {
    (a.visible != b.visible).then_some(tr("one of the two is hidden; show both, or hide both"))
}

fn group(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    let frame = Frame::new().fill(ui.visuals().faint_bg_color).corner_radius(theme::CORNER_RADIUS);
    frame.inner_margin(Margin::same(6)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        content(ui);
    });
}

/// The chosen layers, in the order in which you chose them.
#[derive(Debug, Clone, Default)]
struct Chosen(Vec<LayerId>);

impl Chosen {
    fn contains(&self, layer: LayerId) -> bool {
        self.0.contains(&layer)
    }

    /// Chooses a layer by a click. With Ctrl, this adds the layer to the others or removes it from
    /// them.
    fn click(&mut self, layer: LayerId, modifiers: Modifiers) {
        if !modifiers.command {
            self.0 = vec![layer];
        } else if self.contains(layer) {
            self.0.retain(|other| *other != layer);
        } else {
            self.0.push(layer);
        }
    }

    fn keep(&mut self, layers: &[LayerState]) {
        self.0.retain(|chosen| layers.iter().any(|layer| layer.id == *chosen));
    }

    /// The chosen layer, if there is just one.
    fn one(&self) -> Option<LayerId> {
        if let [one] = self.0[..] { Some(one) } else { None }
    }

    /// Both chosen layers, if there are two.
    fn two(&self) -> Option<[LayerId; 2]> {
        self.0[..].try_into().ok()
    }
}

/// The layer that you drag, and the rows of all layers in this frame.
#[derive(Debug, Clone, Default)]
struct Order {
    dragged: Option<LayerId>,
    /// Rows from the top down.
    rows: Vec<(LayerId, Rect)>,
}

impl Order {
    fn is_dragged(&self, layer: LayerId) -> bool {
        self.dragged == Some(layer)
    }

    fn row(&mut self, layer: LayerId, response: &Response) {
        self.rows.push((layer, response.rect));
        if response.drag_started() {
            self.dragged = Some(layer);
        }
    }

    /// While you drag a row, draws a line where it would go, and moves its layer there when you
    /// release it. Call this after all rows.
    fn finish(&mut self, ui: &Ui, cx: &mut PanelContext<'_>) {
        let rows = std::mem::take(&mut self.rows);
        let Some(dragged) = self.dragged else { return };
        let (at, released, cancelled) = ui.input(|input| {
            let pointer = &input.pointer;
            (pointer.latest_pos(), !pointer.primary_down(), input.key_pressed(Key::Escape))
        });
        let from = rows.iter().position(|(layer, _)| *layer == dragged);
        let (Some(at), Some(from), false) = (at, from, cancelled) else {
            self.dragged = None;
            return;
        };
        let gap = gap(&rows, at.y);
        let to = place(rows.len(), from, gap);
        if released {
            self.dragged = None;
            if to != place(rows.len(), from, from) {
                cx.act(Action::Order { layer: LayerRef::Id(dragged), to });
            }
            return;
        }
        let y = match rows.get(gap) {
            Some((_, below)) => below.top() - ui.spacing().item_spacing.y / 2.0,
            None => rows.last().map_or(at.y, |(_, last)| last.bottom() + 1.0),
        };
        let room = rows[from].1.x_range();
        let line = Rect::from_min_max(pos2(room.min, y - 24.0), pos2(room.max, y + 24.0));
        ui.scroll_to_rect(line, None);
        let stroke = Stroke::new(2.0, theme::colors(ui.ctx()).strong);
        ui.painter().hline(room, y, stroke);
        ui.painter().circle_filled(pos2(room.min + 2.0, y), 3.0, stroke.color);
    }
}

/// Index of the gap between rows that is nearest to `y`. 0 is the gap above the first row.
fn gap(rows: &[(LayerId, Rect)], y: f32) -> usize {
    rows.iter().filter(|(_, row)| row.center().y < y).count()
}

/// New index of a layer, counted from the lowest, if you drop row `from` of `count` rows into the
/// gap `gap`. Rows and gaps count from the top.
fn place(count: usize, from: usize, gap: usize) -> usize {
    let row = if gap > from { gap - 1 } else { gap };
    count - 1 - row
}

/// Draws the slider for the stiffness of wet paint. `pending` is a value that the worker has not
/// confirmed yet.
fn stiffness(ui: &mut Ui, cx: &mut PanelContext<'_>, pending: &mut PendingValue<f64>) {
    let now = ui.input(|input| input.time);
    // Recorded values have six digits, so they may differ slightly.
    let mut value = pending.shown(&cx.painting.medium.stiffness, |a, b| (a - b).abs() < 1e-3, now);
    let control = Slider::new(&mut value, 0.0..=1.0).fixed_decimals(2);
    let tip =
        tr("How stiff the wet paint is, on canvas and palette: 0 is stand oil, which levels \
               after a stroke, 0.7 paint from the tube, 1 putty, which stays as it is laid");
    let response = slider(ui, tr("Stiffness"), tip, control.update_while_editing(false));
    pending.request(ui, cx, Edit::of(&response), Action::Stiffness { value }, value);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ctrl_adds_and_removes_and_a_plain_click_chooses_one() {
        let mut chosen = Chosen::default();
        let [a, b, c] = [1, 2, 3].map(LayerId);
        chosen.click(a, Modifiers::NONE);
        assert_eq!((chosen.one(), chosen.two()), (Some(a), None));
        chosen.click(b, Modifiers::COMMAND);
        assert_eq!((chosen.one(), chosen.two()), (None, Some([a, b])));
        chosen.click(c, Modifiers::COMMAND);
        assert_eq!(chosen.two(), None);
        chosen.click(a, Modifiers::COMMAND);
        assert_eq!(chosen.two(), Some([b, c]));
        chosen.click(c, Modifiers::NONE);
        assert_eq!(chosen.one(), Some(c));
        chosen.keep(&[]);
        assert_eq!(chosen.one(), None);
    }

    #[test]
    fn a_gap_above_or_below_the_dragged_row_leaves_it() {
        // There are three rows, and the topmost layer has place 2.
        for from in 0..3 {
            let places = [0, 1, 2, 3].map(|gap| place(3, from, gap));
            let wanted = [[2, 2, 1, 0], [2, 1, 1, 0], [2, 1, 0, 0]][from];
            assert_eq!(places, wanted, "row {from}");
        }
    }
}
