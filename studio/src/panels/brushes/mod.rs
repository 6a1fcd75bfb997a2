//! The brush panel: list of brushes, head shape and size, paint.

mod paint;

mod list;

mod head;

mod row;

mod panel;

pub use paint::{load_medium, wash, wipe};
pub use panel::Brushes;
