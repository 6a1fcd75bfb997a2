//! Draws the layer panel.

use eframe::egui::{Frame, Key, Margin, RichText, Ui};
use paint::document::{LayerId, Slots};
use paint::strokes::{Action, LayerRef};

use super::chosen::Chosen;
use super::naming::Naming;
use super::opacity::Opacity;
use super::order::Order;
use super::pigments::pigments;
use super::row::{RowLook, RowParts, row};
use super::stiffness::stiffness;
use super::thumbnails::Thumbnails;
use crate::keymap::hint;
use crate::language::{english, tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::{button, item, named_button, percent};
use crate::panels::pending_value::PendingValue;
use crate::panels::pigments::{Catalogue, CatalogueCache, Exchange, ExchangeScope};
use crate::theme;
use session::LayerState;

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

/// Choice in the menu of a layer that the panel carries out after the row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum MenuChoice {
    Rename,
    Exchange,
}

/// Dries the share of the canvas's wet paint that is set in the tools.
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

    /// Renames the layer that is chosen alone with F2, unless some text is being edited.
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

/// Fills the menu of the dry layer `index`.
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
    let find = |id: LayerId| layers.iter().find(|layer| layer.id == id);
    Some([find(ids[0])?, find(ids[1])?])
}

/// Reason why two dry layers cannot be merged, if it is known before the paint is compared.
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
