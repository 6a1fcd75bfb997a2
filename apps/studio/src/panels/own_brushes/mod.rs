//! The window of own brushes: sets of kept brushes, and what became of a brush taken over.

mod row;
mod imported;
mod window;

pub use window::{OwnBrushRequest, OwnBrushes};
