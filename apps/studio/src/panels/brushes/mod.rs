//! The brush panel: list of brushes, head shape and size, paint.

mod paint;
mod list;
pub(in crate::panels) mod head;
mod row;
mod tool;
mod swatch;
mod tip;
mod panel;
mod kept;

pub use paint::{load_medium, wash, wipe};
pub use panel::Brushes;
