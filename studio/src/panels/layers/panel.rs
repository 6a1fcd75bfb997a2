//! Draws the layer panel.

use eframe::egui::{Frame, Margin, RichText, Sense, Ui, vec2};
use render::paint::document::Slots;
use render::paint::strokes::{Action, LayerRef};

use super::opacity::Opacity;
use super::stiffness::stiffness;
use super::thumbnails::Thumbnails;
use crate::panels::PanelContext;
use crate::panels::controls::{button, millimetres, named_button, patch, percent};
use crate::panels::pending_value::PendingValue;
use crate::panels::pigments::{Catalogue, CatalogueCache, Exchange, ExchangeScope};
use crate::theme;

/// State of the layer panel.
#[derive(Debug, Clone, Default)]
pub struct Layers {
    catalogue: CatalogueCache,
    exchange: Exchange,
    opacity: Opacity,
    stiffness: PendingValue<f64>,
    thumbnails: Thumbnails,
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
        drying(ui, cx);
        self.wet(ui, &catalogue, cx);
        for layer in (0..cx.painting.layers.len()).rev() {
            self.dry_layer(ui, &catalogue, cx, layer);
        }
        if cx.painting.layers.is_empty() {
            ui.weak("There is no dry paint yet.");
        }
        self.thumbnails.keep(cx.painting.layers.iter().map(|layer| &layer.thumbnail));
        let context = ui.ctx().clone();
        self.exchange.show(&context, "exchange in a layer", &catalogue, cx);
    }

    fn wet(&mut self, ui: &mut Ui, catalogue: &Catalogue, cx: &mut PanelContext<'_>) {
        group(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new("Wet").strong());
                pigments(ui, catalogue, &cx.painting.slots);
            });
            stiffness(ui, cx, &mut self.stiffness);
            self.exchange_button(ui, &cx.painting.slots, LayerRef::Wet, "the wet layer");
        });
    }

    fn dry_layer(
        &mut self,
        ui: &mut Ui,
        catalogue: &Catalogue,
        cx: &mut PanelContext<'_>,
        layer: usize,
    ) {
        let state = &cx.painting.layers[layer];
        let name = format!("dry layer {}", layer + 1);
        group(ui, |ui| {
            ui.horizontal(|ui| {
                self.opacity.eye(ui, cx, layer);
                self.thumbnails.show(ui, &state.thumbnail, vec2(60.0, 44.0));
                ui.vertical(|ui| {
                    ui.spacing_mut().item_spacing.y = 2.0;
                    let [mean, max] = [state.mean_mm, state.max_mm].map(millimetres);
                    let covers = format!("covers {:.0} %", 100.0 * state.coverage);
                    ui.horizontal(|ui| {
                        ui.label(RichText::new(format!("Dry {}", layer + 1)).strong());
                        ui.weak(covers).on_hover_text("Share of the canvas covered by this layer");
                    });
                    ui.weak(format!("{mean}, max {max}"))
                        .on_hover_text("Mean height where it has paint, and maximum height");
                    pigments(ui, catalogue, &state.slots);
                });
            });
            self.opacity.slider(ui, cx, layer);
            ui.horizontal(|ui| {
                let disabled_reason = merge_obstacle(cx, layer);
                let tip = "Merges this layer with the one below, without a visible change";
                if named_button(
                    ui,
                    "Merge down",
                    &format!("merge {name} down"),
                    tip,
                    disabled_reason,
                ) {
                    cx.act(Action::Merge { layer });
                    self.opacity.merged(layer);
                }
                self.exchange_button(ui, &state.slots, LayerRef::Dry(layer), &name);
            });
        });
    }

    fn exchange_button(&mut self, ui: &mut Ui, slots: &Slots, layer: LayerRef, name: &str) {
        let first = slots.iter().flatten().next();
        let none = first.is_none().then_some("the layer has no pigment");
        let tip = "Replaces a pigment of this layer, as if painted with the other one";
        let name = format!("exchange in {name}");
        if named_button(ui, "Exchange pigment...", &name, tip, none)
            && let Some(&first) = first
        {
            self.exchange.open(first, ExchangeScope::Layer(layer));
        }
    }
}

fn drying(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    let tip = "Share of the wet paint that dries, from the bottom up";
    percent(ui, "Share", tip, &mut cx.tools.dry_share, 1.0..=100.0);
    ui.horizontal(|ui| {
        let tip = "Dries that share of the wet paint into a new dry layer (key D)";
        if button(ui, "Dry share", tip, None) {
            dry(cx);
        }
        if button(ui, "Dry all", "Dries all wet paint into a new dry layer", None) {
            cx.act(Action::Dry { fraction: 1.0 });
        }
    });
}

/// Reason why a dry layer cannot be merged with the one below, if any.
fn merge_obstacle(cx: &PanelContext<'_>, layer: usize) -> Option<&'static str> {
    let layers = &cx.painting.layers;
    match layer.checked_sub(1) {
        None => Some("there is no dry layer below it"),
        Some(below) if layers[below].opacity != layers[layer].opacity => {
            Some("the layer below has another opacity; set both to the same value")
        }
        Some(_) => None,
    }
}

/// Draws a patch of each pigment's masstone.
fn pigments(ui: &mut Ui, catalogue: &Catalogue, slots: &Slots) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for &pigment in slots.iter().flatten() {
            let (rect, response) = ui.allocate_exact_size(vec2(13.0, 13.0), Sense::hover());
            patch(ui.painter(), rect.shrink(1.0), Some(catalogue.colors(pigment).masstone_srgb));
            response.on_hover_text(catalogue.name(pigment));
        }
    });
}

fn group(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    let frame = Frame::new().fill(ui.visuals().faint_bg_color).corner_radius(theme::CORNER_RADIUS);
    frame.inner_margin(Margin::same(6)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        content(ui);
    });
}
