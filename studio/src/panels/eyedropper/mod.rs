//! The eyedropper: spectrum, Lab, recipe, thickness, and recipes for a colour.

mod layer_paint;

mod wanted;

mod swatch;

mod picked_place;

mod offers;

mod search;

mod panel;

pub use panel::Eyedropper;
pub use wanted::{Color, Wanted};
