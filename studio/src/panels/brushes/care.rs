//! What is done with the paint of the brush in hand.

use render::paint::strokes::{Action, Load, Recipe};

use crate::panels::{Desk, Mode};
use session::BrushState;

/// Loads the brush in hand with clear medium alone.
pub fn load_medium(desk: &mut Desk<'_>) {
    let brush = desk.tools.brush.clone();
    let amount_mm = desk.tools.load_mm;
    desk.act(Action::Load(Load { brush, recipe: Recipe::new(), vehicle: 1.0, amount_mm }));
    desk.tools.mode = Mode::Paint;
}

/// Wipes the brush in hand, if there is paint on it.
pub fn wipe(desk: &mut Desk<'_>) {
    if is_loaded(desk) {
        let (brush, keep) = (desk.tools.brush.clone(), desk.tools.wipe_keep);
        desk.act(Action::Wipe { brush, keep });
    }
}

/// Washes the brush in hand, if there is paint on it.
pub fn wash(desk: &mut Desk<'_>) {
    if is_loaded(desk) {
        let brush = desk.tools.brush.clone();
        desk.act(Action::Wash { brush });
    }
}

/// The brush in hand, as the worker last told of it.
pub(super) fn in_hand<'a>(desk: &Desk<'a>) -> Option<&'a BrushState> {
    desk.easel.brushes.iter().find(|brush| brush.name == desk.tools.brush)
}

/// Whether there is paint on the brush in hand.
pub(super) fn is_loaded(desk: &Desk<'_>) -> bool {
    in_hand(desk).is_some_and(|brush| brush.amount_mm > 0.0)
}

/// A load like the paint that is on a brush now; none for a clean one.
pub(super) fn like(desk: &Desk<'_>, brush: &BrushState) -> Option<Load> {
    if brush.amount_mm <= 0.0 {
        return None;
    }
    let pigments = &desk.easel.library.pigments;
    let parts = desk.easel.slots.iter().zip(brush.parts);
    let recipe: Recipe = parts
        .filter(|(_, part)| *part > 0.0)
        .filter_map(|(slot, part)| Some((pigments[(*slot)?].name.clone(), part)))
        .collect();
    // What is left without a pigment is medium.
    let vehicle = if recipe.is_empty() { 1.0 } else { brush.vehicle };
    Some(Load { brush: brush.name.clone(), recipe, vehicle, amount_mm: brush.amount_mm })
}
