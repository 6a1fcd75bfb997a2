//! The panel of the layers.

use eframe::egui::{Frame, Margin, RichText, Sense, Ui, vec2};
use render::paint::document::Slots;
use render::paint::strokes::{Action, LayerRef};

use super::opacity::Opacity;
use super::thumbnails::Thumbnails;
use crate::panels::Desk;
use crate::panels::controls::{button, millimetres, named_button, patch, percent};
use crate::panels::pigments::{Catalogue, Exchange, Known, Place};
use crate::theme;

/// The panel of wet and dry paint.
#[derive(Debug, Clone, Default)]
pub struct Layers {
    known: Known,
    exchange: Exchange,
    opacity: Opacity,
    thumbnails: Thumbnails,
}

/// Dries the share that the painter has set of all wet paint on the canvas.
pub fn dry(desk: &mut Desk<'_>) {
    let fraction = desk.tools.dry_share;
    desk.act(Action::Dry { fraction });
}

impl Layers {
    /// Shows it: drying, the wet layer, dry layers from the topmost down.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let catalogue = self.known.of(desk.easel);
        drying(ui, desk);
        self.wet(ui, &catalogue, desk);
        for layer in (0..desk.easel.layers.len()).rev() {
            self.dry_layer(ui, &catalogue, desk, layer);
        }
        if desk.easel.layers.is_empty() {
            ui.weak("No paint is dry yet.");
        }
        self.thumbnails.keep(desk.easel.layers.iter().map(|layer| &layer.thumbnail));
        let context = ui.ctx().clone();
        self.exchange.show(&context, "exchange in a layer", &catalogue, desk);
    }

    fn wet(&mut self, ui: &mut Ui, catalogue: &Catalogue, desk: &Desk<'_>) {
        group(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new("Wet").strong());
                pigments(ui, catalogue, &desk.easel.slots);
            });
            self.exchange_button(ui, &desk.easel.slots, LayerRef::Wet, "the wet layer");
        });
    }

    fn dry_layer(&mut self, ui: &mut Ui, catalogue: &Catalogue, desk: &mut Desk<'_>, layer: usize) {
        let state = &desk.easel.layers[layer];
        let name = format!("dry layer {}", layer + 1);
        group(ui, |ui| {
            ui.horizontal(|ui| {
                self.opacity.eye(ui, desk, layer);
                self.thumbnails.show(ui, &state.thumbnail, vec2(60.0, 44.0));
                ui.vertical(|ui| {
                    ui.spacing_mut().item_spacing.y = 2.0;
                    let [mean, most] = [state.mean_mm, state.max_mm].map(millimetres);
                    let covers = format!("covers {:.0} %", 100.0 * state.coverage);
                    ui.horizontal(|ui| {
                        ui.label(RichText::new(format!("Dry {}", layer + 1)).strong());
                        ui.weak(covers).on_hover_text("Share of the canvas that has its paint");
                    });
                    ui.weak(format!("{mean}, most {most}"))
                        .on_hover_text("Mean height where it has paint, and the greatest");
                    pigments(ui, catalogue, &state.slots);
                });
            });
            self.opacity.slider(ui, desk, layer);
            ui.horizontal(|ui| {
                let hindered = unmergeable(desk, layer);
                let tip = "Makes one layer of this and the one below it, where nobody can see it";
                if named_button(ui, "Merge down", &format!("merge {name} down"), tip, hindered) {
                    desk.act(Action::Merge { layer });
                    self.opacity.merged(layer);
                }
                self.exchange_button(ui, &state.slots, LayerRef::Dry(layer), &name);
            });
        });
    }

    fn exchange_button(&mut self, ui: &mut Ui, slots: &Slots, layer: LayerRef, name: &str) {
        let first = slots.iter().flatten().next();
        let none = first.is_none().then_some("it has no pigment");
        let tip = "Changes a pigment of this layer for another, as if painted with that";
        let name = format!("exchange in {name}");
        if named_button(ui, "Exchange pigment...", &name, tip, none)
            && let Some(&first) = first
        {
            self.exchange.open(first, Place::In(layer));
        }
    }
}

fn drying(ui: &mut Ui, desk: &mut Desk<'_>) {
    let tip = "Which share of the wet paint dries, from the bottom up";
    percent(ui, "Share", tip, &mut desk.tools.dry_share, 1.0..=100.0);
    ui.horizontal(|ui| {
        let tip = "Dries that share of the wet paint into a new dry layer (key D)";
        if button(ui, "Dry share", tip, None) {
            dry(desk);
        }
        if button(ui, "Dry all", "Dries all wet paint into a new dry layer", None) {
            desk.act(Action::Dry { fraction: 1.0 });
        }
    });
}

/// Why a dry layer cannot become one with the one below it.
fn unmergeable(desk: &Desk<'_>, layer: usize) -> Option<&'static str> {
    let layers = &desk.easel.layers;
    match layer.checked_sub(1) {
        None => Some("there is no dry layer below it"),
        Some(below) if layers[below].opacity != layers[layer].opacity => {
            Some("the one below has another opacity; give both the same")
        }
        Some(_) => None,
    }
}

/// A patch of each pigment's masstone.
fn pigments(ui: &mut Ui, catalogue: &Catalogue, slots: &Slots) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for &pigment in slots.iter().flatten() {
            let (rect, response) = ui.allocate_exact_size(vec2(13.0, 13.0), Sense::hover());
            patch(ui.painter(), rect.shrink(1.0), Some(catalogue.look(pigment).masstone_srgb));
            response.on_hover_text(catalogue.name(pigment));
        }
    });
}

fn group(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    let frame = Frame::new().fill(ui.visuals().faint_bg_color).corner_radius(theme::ROUND);
    frame.inner_margin(Margin::same(6)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        content(ui);
    });
}
