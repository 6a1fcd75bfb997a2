//! The wheel panel: what the tubes on hand can mix, by measured colour.

mod plane;
mod plot;
mod view;
mod reach;
mod panel;

pub use panel::Wheel;
pub use plane::Plane;
