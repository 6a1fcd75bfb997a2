//! Brushes: shape, size, what is on them.

mod stand;

mod care;

mod head;

mod place;

mod panel;

pub use care::{load_medium, wash, wipe};
pub use panel::Brushes;
