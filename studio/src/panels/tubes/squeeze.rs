//! Getting paint out of a tube.

use render::paint::strokes::{Action, Load, Recipe, Squeeze, SurfaceId};

use crate::panels::{Desk, Mode};

/// A tube that is being dragged; where it is dropped on a surface, [`squeeze`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DraggedTube {
    /// Its slot.
    pub slot: usize,
}

/// Squeezes paint of a slot on a surface, as much as the painter has set; nothing
/// for an empty slot. The place is in mm from the left and the upper edge.
pub fn squeeze(desk: &mut Desk<'_>, slot: usize, on: SurfaceId, x_mm: f64, y_mm: f64) {
    let Some(recipe) = recipe(desk, slot) else { return };
    let volume_mm3 = desk.tools.squeeze_mm3;
    desk.act(Action::Squeeze(Squeeze { on, recipe, vehicle: 0.0, x_mm, y_mm, volume_mm3 }));
}

/// Loads the brush in hand with paint of a slot, with the share of medium and the
/// height that the painter has set, and takes it up for painting; nothing for an
/// empty slot.
pub fn load(desk: &mut Desk<'_>, slot: usize) {
    let Some(recipe) = recipe(desk, slot) else { return };
    let brush = desk.tools.brush.clone();
    let (vehicle, amount_mm) = (desk.tools.vehicle, desk.tools.load_mm);
    desk.act(Action::Load(Load { brush, recipe, vehicle, amount_mm }));
    desk.tools.mode = Mode::Paint;
}

/// One part of a slot's pigment.
fn recipe(desk: &Desk<'_>, slot: usize) -> Option<Recipe> {
    let pigment = (*desk.easel.slots.get(slot)?)?;
    Some(Recipe::from([(desk.easel.library.pigments[pigment].name.clone(), 1.0)]))
}
