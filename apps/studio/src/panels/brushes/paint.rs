//! Loading, wiping and washing the selected brush.

use paint::strokes::{Action, Load, Recipe};

use crate::panels::PanelContext;
use crate::panels::laying::keep;
use session::BrushState;

/// Loads the selected brush with clear medium only and selects the paint tool.
pub fn load_medium(cx: &mut PanelContext<'_>) {
    cx.load(Recipe::new(), 1.0);
}

/// Wipes the selected brush if it holds paint.
pub fn wipe(cx: &mut PanelContext<'_>) {
    if is_loaded(cx) {
        let brush = cx.tools.brush.clone();
        let keep = cx.tools.wipe_keep;
        cx.act(Action::Wipe { brush, keep });
    }
}

/// Washes the selected brush if it holds paint.
pub fn wash(cx: &mut PanelContext<'_>) {
    if is_loaded(cx) {
        let brush = cx.tools.brush.clone();
        cx.act(Action::Wash { brush });
    }
}

/// State of the selected brush as last reported by the worker.
pub(super) fn selected<'a>(cx: &PanelContext<'a>) -> Option<&'a BrushState> {
    cx.painting.brushes.iter().find(|brush| brush.name == cx.tools.brush)
}

/// Whether the selected brush holds paint.
pub(super) fn is_loaded(cx: &PanelContext<'_>) -> bool {
    selected(cx).is_some_and(|brush| brush.amount_mm > 0.0)
}

/// Keeps what the selected brush holds in the painter's list of mixtures.
pub(super) fn keep_mixture(cx: &mut PanelContext<'_>) {
    let Some(brush) = selected(cx) else { return };
    // Four digits are as fine as a knife can part paint.
    let rounded = recipe(cx, brush).into_iter().map(|(name, part)| (name, round(part)));
    let parts = rounded.filter(|(_, part)| *part > 0.0).collect();
    let vehicle = round(brush.vehicle);
    keep(cx, parts, vehicle);
}

fn round(share: f64) -> f64 {
    (1e4 * share).round() / 1e4
}

/// Parts of the pigments on a brush by name.
fn recipe(cx: &PanelContext<'_>, brush: &BrushState) -> Recipe {
    let library = &cx.painting.library;
    let parts = cx.painting.slots.iter().zip(brush.parts);
    let parts = parts.filter(|(_, part)| *part > 0.0);
    parts.filter_map(|(slot, part)| Some((library[(*slot)?].name.clone(), part))).collect()
}

/// Load action that reproduces the mean of the paint on a brush; `None` for a clean
/// brush.
pub(super) fn load_matching(cx: &PanelContext<'_>, brush: &BrushState) -> Option<Load> {
    if brush.amount_mm <= 0.0 {
        return None;
    }
    let recipe = recipe(cx, brush);
    // Paint without any pigment is clear medium.
    let vehicle = if recipe.is_empty() { 1.0 } else { brush.vehicle };
    Some(Load { brush: brush.name.clone(), recipe, vehicle, amount_mm: brush.amount_mm })
}
