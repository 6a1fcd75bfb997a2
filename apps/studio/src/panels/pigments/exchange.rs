//! The window that replaces a pigment in existing paint.

use eframe::egui::{ComboBox, Context, Ui};
use paint::document::Slots;
use paint::strokes::{Action, LayerRef};
use pigment::PigmentId;

use super::catalogue::Catalogue;
use super::list::PigmentList;
use crate::floating;
use crate::language::{layer_label, tr};
use crate::panels::PanelContext;
use session::{LayerState, PaintingState};

/// Width of the contents, in points.
const WIDTH: f32 = 380.0;

/// Layers in which a pigment is exchanged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::panels) enum ExchangeScope {
    /// All layers that contain the pigment.
    AllLayers,
    /// A single layer, wet or dry.
    Layer(LayerRef),
}

/// State of the window: layers, pigment to replace, and list of replacements.
#[derive(Debug, Clone)]
pub(in crate::panels) struct Exchange {
    open: bool,
    from: PigmentId,
    scope: ExchangeScope,
    list: PigmentList,
}

impl Default for Exchange {
    fn default() -> Self {
        Self {
            open: false,
            from: PigmentId(0),
            scope: ExchangeScope::AllLayers,
            list: PigmentList::default(),
        }
    }
}

impl Exchange {
    /// Opens the window for a pigment.
    pub(in crate::panels) fn open(&mut self, from: PigmentId, scope: ExchangeScope) {
        *self = Self { open: true, from, scope, ..Self::default() };
    }

    /// Draws the window if it is open, and queues the exchange.
    pub(in crate::panels) fn show(
        &mut self,
        context: &Context,
        id: &str,
        catalogue: &Catalogue,
        cx: &mut PanelContext<'_>,
    ) {
        if self.open && !self.is_valid(cx.painting) {
            self.open = false;
        }
        let mut open = self.open;
        let chosen = floating::show(context, tr("Exchange a pigment"), id, &mut open, |ui| {
            ui.set_width(WIDTH);
            self.contents(ui, catalogue, cx.painting)
        });
        self.open = open;
        if let Some(to) = chosen.flatten() {
            for layer in layers(cx.painting, self.scope, self.from, to) {
                let name = |pigment: PigmentId| catalogue.name(pigment).to_owned();
                cx.act(Action::Swap { layer, from: name(self.from), to: name(to) });
            }
            self.open = false;
        }
    }

    /// Whether the layer and its pigment still exist.
    fn is_valid(&self, painting: &PaintingState) -> bool {
        pigments(painting, self.scope).contains(&self.from)
    }

    fn contents(
        &mut self,
        ui: &mut Ui,
        catalogue: &Catalogue,
        painting: &PaintingState,
    ) -> Option<PigmentId> {
        ui.horizontal(|ui| {
            ui.label(tr("In"));
            let tip = tr("Layers in which the pigment is replaced");
            let shown =
                ComboBox::from_id_salt("scope").selected_text(scope_name(painting, self.scope));
            let scopes = shown.show_ui(ui, |ui| {
                for scope in all_scopes(painting) {
                    ui.selectable_value(&mut self.scope, scope, scope_name(painting, scope))
                        .on_hover_text(tip);
                }
            });
            scopes.response.accessible_name(tr("In")).on_hover_text(tip);
            let here = pigments(painting, self.scope);
            if !here.contains(&self.from) {
                self.from = here.first().copied().unwrap_or(self.from);
            }
            ui.label(tr("exchange"));
            let tip = tr("The pigment to replace");
            let shown = ComboBox::from_id_salt("from").width(150.0);
            let shown = shown.selected_text(catalogue.name(self.from));
            let from = shown.show_ui(ui, |ui| {
                for pigment in here {
                    let name = catalogue.name(pigment);
                    ui.selectable_value(&mut self.from, pigment, name).on_hover_text(tip);
                }
            });
            from.response.accessible_name(tr("Exchange")).on_hover_text(tip);
        });
        ui.label(tr("for"));
        let scope = self.scope;
        let from = self.from;
        self.list.show(ui, catalogue, painting.medium.scattering_per_mm, |to| {
            if to == from {
                Some(tr("it is the pigment to replace").to_owned())
            } else if layers(painting, scope, from, to).is_empty() {
                Some(tr("every such layer already has it").to_owned())
            } else {
                None
            }
        })
    }
}

/// Display name of the layers.
fn scope_name(painting: &PaintingState, scope: ExchangeScope) -> String {
    match scope {
        ExchangeScope::AllLayers => tr("all layers").to_owned(),
        ExchangeScope::Layer(LayerRef::Wet) => tr("the wet layer").to_owned(),
        ExchangeScope::Layer(layer) => match state(painting, layer) {
            Some(state) => layer_label(&state.label()),
            None => tr("no layer").to_owned(),
        },
    }
}

fn all_scopes(painting: &PaintingState) -> Vec<ExchangeScope> {
    let dry = painting.layers.iter().rev();
    let dry = dry.map(|layer| ExchangeScope::Layer(LayerRef::Id(layer.id)));
    [ExchangeScope::AllLayers, ExchangeScope::Layer(LayerRef::Wet)].into_iter().chain(dry).collect()
}

/// State of a dry layer.
fn state(painting: &PaintingState, layer: LayerRef) -> Option<&LayerState> {
    match layer {
        LayerRef::Wet => None,
        LayerRef::Dry(index) => painting.layers.get(index),
        LayerRef::Id(id) => painting.layers.iter().find(|layer| layer.id == id),
    }
}

fn slots(painting: &PaintingState, layer: LayerRef) -> Slots {
    match layer {
        LayerRef::Wet => painting.slots,
        _ => state(painting, layer).map_or([None; 8], |layer| layer.slots),
    }
}

fn scope_layers(painting: &PaintingState, scope: ExchangeScope) -> Vec<LayerRef> {
    match scope {
        ExchangeScope::Layer(layer) => vec![layer],
        ExchangeScope::AllLayers => {
            let dry = painting.layers.iter().map(|layer| LayerRef::Id(layer.id));
            dry.chain([LayerRef::Wet]).collect()
        }
    }
}

/// Pigments of the given layers in slot order, without duplicates.
fn pigments(painting: &PaintingState, scope: ExchangeScope) -> Vec<PigmentId> {
    let mut found = Vec::new();
    let layers = scope_layers(painting, scope);
    for pigment in layers.into_iter().flat_map(|layer| slots(painting, layer)).flatten() {
        if !found.contains(&pigment) {
            found.push(pigment);
        }
    }
    found
}

/// Layers in which `from` can be replaced by `to`: those that contain `from` and not
/// `to`.
fn layers(
    painting: &PaintingState,
    scope: ExchangeScope,
    from: PigmentId,
    to: PigmentId,
) -> Vec<LayerRef> {
    let mut found = scope_layers(painting, scope);
    found.retain(|&layer| {
        let slots = slots(painting, layer);
        slots.contains(&Some(from)) && !slots.contains(&Some(to))
    });
    found
}
