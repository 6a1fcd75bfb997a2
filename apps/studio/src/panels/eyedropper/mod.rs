//! The eyedropper panel: spectrum, colour and paint at a picked place, and recipes for
//! a colour.

mod layer_paint;
mod target;
mod swatch;
mod picked;
mod found_recipe;
mod search;
mod panel;

pub(super) use layer_paint::LayerPaint;
pub use panel::Eyedropper;
pub(super) use picked::layer;
pub(super) use search::SearchPanel;
pub(super) use swatch::swatch;
pub use target::{Color, TargetColor};
