//! The opacity of a dry layer: a slider that is one action, and an eye that
//! remembers.

use std::collections::BTreeMap;

use eframe::egui::{Slider, SliderClamping, Ui};
use render::paint::strokes::{Action, LayerRef};

use super::eye::eye;
use crate::panels::Desk;
use crate::panels::controls::slider;
use session::Command;

/// How long the slider shows what was asked for, until the worker tells of it, in
/// seconds.
const PATIENCE: f64 = 1.0;

/// What is being done to opacities.
#[derive(Debug, Clone, Default)]
pub(super) struct Opacity {
    held: Option<Held>,
    /// What a hidden layer had before, by its number.
    before: BTreeMap<usize, f64>,
}

/// A value that was asked for.
#[derive(Debug, Clone, Copy)]
struct Held {
    layer: usize,
    value: f64,
    dragged: bool,
    until: f64,
}

impl Opacity {
    /// The eye of a layer.
    pub(super) fn eye(&mut self, ui: &mut Ui, desk: &mut Desk<'_>, layer: usize) {
        let now = desk.easel.layers[layer].opacity;
        let response = eye(ui, &format!("visibility of dry layer {}", layer + 1), now > 0.0);
        if response.clicked() {
            let value = if now > 0.0 {
                self.before.insert(layer, now);
                0.0
            } else {
                self.before.remove(&layer).unwrap_or(1.0)
            };
            desk.act(Action::Opacity { layer: LayerRef::Dry(layer), value });
        }
        let tip = if now > 0.0 { "Hides this layer" } else { "Shows this layer again" };
        response.on_hover_text(format!("{tip}; what lies above keeps its relief"));
    }

    /// The slider of a layer.
    pub(super) fn slider(&mut self, ui: &mut Ui, desk: &mut Desk<'_>, layer: usize) {
        let now = ui.input(|input| input.time);
        let told = desk.easel.layers[layer].opacity;
        self.held = self.held.filter(|held| {
            held.layer != layer
                || held.dragged
                || (held.until > now && (told - held.value).abs() > 1e-9)
        });
        let held = self.held.filter(|held| held.layer == layer);
        let shown = held.map_or((told * 100.0).round() / 100.0, |held| held.value);
        let mut value = shown;
        let control = Slider::new(&mut value, 0.0..=4.0).logarithmic(true).smallest_positive(0.02);
        let control = control.clamping(SliderClamping::Edits).max_decimals(2);
        let tip = "What the layer's optical thickness is multiplied with: 1 as painted, 0 hidden";
        let response = slider(ui, "Opacity", tip, control.update_while_editing(false));
        let response = response.accessible_name(format!("opacity of dry layer {}", layer + 1));
        let dragged = response.dragged();
        if value != shown {
            let action = Action::Opacity { layer: LayerRef::Dry(layer), value };
            desk.command(if dragged { Command::Adjust(action) } else { Command::Apply(action) });
            self.held = Some(Held { layer, value, dragged, until: now + PATIENCE });
        }
        if let Some(held) = self.held.as_mut().filter(|held| held.layer == layer)
            && held.dragged
            && !dragged
        {
            held.dragged = false;
            held.until = now + PATIENCE;
            desk.command(Command::EndAdjustment);
        }
    }

    /// After a layer became one with the one below it: those above sink by one.
    pub(super) fn merged(&mut self, layer: usize) {
        let before = std::mem::take(&mut self.before);
        let kept = before.into_iter().filter(|(hidden, _)| *hidden != layer);
        self.before =
            kept.map(|(hidden, value)| (hidden - usize::from(hidden > layer), value)).collect();
    }
}
