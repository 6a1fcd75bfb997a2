//! Squeezing a tube and loading the brush from it.

use paint::strokes::{Action, Recipe, Squeeze, SurfaceId};

use crate::panels::PanelContext;

/// Drag payload of a tube. A drop on a surface squeezes it there with [`squeeze`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DraggedTube {
    /// Slot of the tube.
    pub slot: usize,
}

/// Squeezes the volume set in the tools from a slot's tube onto a surface, at a
/// position in mm from the upper left corner. Does nothing for an empty slot.
pub fn squeeze(cx: &mut PanelContext<'_>, slot: usize, on: SurfaceId, x_mm: f64, y_mm: f64) {
    let Some(recipe) = recipe(cx, slot) else { return };
    let volume_mm3 = cx.tools.squeeze_mm3;
    cx.act(Action::Squeeze(Squeeze { on, recipe, vehicle: 0.0, x_mm, y_mm, volume_mm3 }));
}

/// Loads the selected brush from a slot's tube, with the medium and height set in the
/// tools, and selects the paint tool. Does nothing for an empty slot.
pub fn load(cx: &mut PanelContext<'_>, slot: usize) {
    if let Some(recipe) = recipe(cx, slot) {
        let vehicle = cx.tools.vehicle;
        cx.load(recipe, vehicle);
    }
}

/// Recipe of a slot's pigment alone.
fn recipe(cx: &PanelContext<'_>, slot: usize) -> Option<Recipe> {
    let pigment = (*cx.painting.slots.get(slot)?)?;
    Some(Recipe::from([(cx.painting.library[pigment].name.clone(), 1.0)]))
}
