//! Stiffness of the wet paint: a slider whose drag is one action.

use eframe::egui::{Slider, Ui};
use paint::strokes::Action;

use crate::language::tr;
use crate::panels::PanelContext;
use crate::panels::controls::slider;
use crate::panels::pending_value::{Edit, PendingValue};

/// Draws the slider; `pending` is its value that the worker has not confirmed yet.
pub(super) fn stiffness(ui: &mut Ui, cx: &mut PanelContext<'_>, pending: &mut PendingValue<f64>) {
    let now = ui.input(|input| input.time);
    // Recorded values are rounded to six digits, so they may differ slightly.
    let near = |a: &f64, b: &f64| (a - b).abs() < 1e-3;
    let mut value = pending.shown(&cx.painting.medium.stiffness, near, now);
    let control = Slider::new(&mut value, 0.0..=1.0).fixed_decimals(2);
    let tip =
        tr("How stiff the wet paint is, on canvas and palette: 0 is stand oil, which levels \
               after a stroke, 0.7 paint from the tube, 1 putty, which stays as it is laid");
    let response = slider(ui, tr("Stiffness"), tip, control.update_while_editing(false));
    pending.request(ui, cx, Edit::of(&response), Action::Stiffness { value }, value);
}
