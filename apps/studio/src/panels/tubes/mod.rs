//! The tube panel beside the palette.

mod tube;
mod squeeze;
mod chooser;
mod shelf;

pub use shelf::{Tubes, least_width};
pub use squeeze::{DraggedTube, load, squeeze};
pub(super) use tube::{TUBE_SIZE, draw as draw_tube};
