//! Opacity of a dry layer: a slider whose drag is one action.

use eframe::egui::{Slider, SliderClamping, Ui};
use paint::document::LayerId;
use paint::strokes::{Action, LayerRef};

use crate::language::{layer_label, tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::slider;
use session::{Command, LayerState};

/// Time after which an unconfirmed opacity is dropped, in seconds.
const TIMEOUT_SECONDS: f64 = 1.0;

/// State of the opacity controls.
#[derive(Debug, Clone, Default)]
pub(super) struct Opacity {
    pending: Option<PendingOpacity>,
}

/// A requested opacity that is not confirmed yet.
#[derive(Debug, Clone, Copy)]
struct PendingOpacity {
    layer: LayerId,
    value: f64,
    dragged: bool,
    until: f64,
}

impl Opacity {
    /// Draws the opacity slider of a layer.
    pub(super) fn slider(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, state: &LayerState) {
        let now = ui.input(|input| input.time);
        let layer = state.id;
        let reported = state.opacity;
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
        let tip =
            tr("Factor of the layer's optical thickness: 1 as painted, 0 clear. A hidden layer \
                   keeps it");
        let response = slider(ui, tr("Opacity"), tip, control.update_while_editing(false));
        let response = response
            .accessible_name(tr_format!("opacity of {label}", label = layer_label(&state.label())));
        let dragged = response.dragged();
        if value != shown {
            let action = Action::Opacity { layer: LayerRef::Id(layer), value };
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
}
