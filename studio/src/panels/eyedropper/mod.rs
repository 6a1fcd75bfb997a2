//! The eyedropper panel: spectrum, colour and paint at a picked place, and recipes for
//! a colour.

mod layer_paint;

mod target;

mod swatch;

mod picked;

mod found_recipe;

mod search;

mod panel;

pub use panel::Eyedropper;
pub use target::{Color, TargetColor};
