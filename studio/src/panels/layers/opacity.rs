//! Opacity of a dry layer: a slider whose drag is one action, and an eye icon that
//! restores the previous opacity.

use std::collections::BTreeMap;

use eframe::egui::{Slider, SliderClamping, Ui};
use render::paint::strokes::{Action, LayerRef};

use super::eye::eye;
use crate::panels::PanelContext;
use crate::panels::controls::slider;
use session::Command;

/// Time after which an unconfirmed opacity is dropped, in seconds.
const TIMEOUT_SECONDS: f64 = 1.0;

/// State of the opacity controls.
#[derive(Debug, Clone, Default)]
pub(super) struct Opacity {
    pending: Option<PendingOpacity>,
    /// Opacity that each hidden layer had before it was hidden, by layer index.
    opacities_before_hiding: BTreeMap<usize, f64>,
}

/// A requested opacity that is not confirmed yet.
#[derive(Debug, Clone, Copy)]
struct PendingOpacity {
    layer: usize,
    value: f64,
    dragged: bool,
    until: f64,
}

impl Opacity {
    /// Draws the eye icon of a layer.
    pub(super) fn eye(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, layer: usize) {
        let now = cx.painting.layers[layer].opacity;
        let response = eye(ui, &format!("visibility of dry layer {}", layer + 1), now > 0.0);
        if response.clicked() {
            let value = if now > 0.0 {
                self.opacities_before_hiding.insert(layer, now);
                0.0
            } else {
                self.opacities_before_hiding.remove(&layer).unwrap_or(1.0)
            };
            cx.act(Action::Opacity { layer: LayerRef::Dry(layer), value });
        }
        let tip = if now > 0.0 { "Hides this layer" } else { "Shows this layer again" };
        response.on_hover_text(format!("{tip}; the layers above keep their relief"));
    }

    /// Draws the opacity slider of a layer.
    pub(super) fn slider(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, layer: usize) {
        let now = ui.input(|input| input.time);
        let reported = cx.painting.layers[layer].opacity;
        self.pending = self.pending.filter(|pending| {
            pending.layer != layer
                || pending.dragged
                || (pending.until > now && (reported - pending.value).abs() > 1e-9)
        });
        let pending = self.pending.filter(|pending| pending.layer == layer);
        let shown = pending.map_or((reported * 100.0).round() / 100.0, |pending| pending.value);
        let mut value = shown;
        let control = Slider::new(&mut value, 0.0..=4.0).logarithmic(true).smallest_positive(0.02);
        let control = control.clamping(SliderClamping::Edits).max_decimals(2);
        let tip = "Factor of the layer's optical thickness: 1 as painted, 0 hidden";
        let response = slider(ui, "Opacity", tip, control.update_while_editing(false));
        let response = response.accessible_name(format!("opacity of dry layer {}", layer + 1));
        let dragged = response.dragged();
        if value != shown {
            let action = Action::Opacity { layer: LayerRef::Dry(layer), value };
            cx.command(if dragged { Command::Adjust(action) } else { Command::Apply(action) });
            self.pending =
                Some(PendingOpacity { layer, value, dragged, until: now + TIMEOUT_SECONDS });
        }
        if let Some(pending) = self.pending.as_mut().filter(|pending| pending.layer == layer)
            && pending.dragged
            && !dragged
        {
            pending.dragged = false;
            pending.until = now + TIMEOUT_SECONDS;
            cx.command(Command::EndAdjustment);
        }
    }

    /// Renumbers the layers above `layer` after it was merged down.
    pub(super) fn merged(&mut self, layer: usize) {
        let opacities_before_hiding = std::mem::take(&mut self.opacities_before_hiding);
        let kept = opacities_before_hiding.into_iter().filter(|(hidden, _)| *hidden != layer);
        self.opacities_before_hiding =
            kept.map(|(hidden, value)| (hidden - usize::from(hidden > layer), value)).collect();
    }
}
