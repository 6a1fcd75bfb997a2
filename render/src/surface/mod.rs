//! What of a mesh is seen, pixel by pixel.

mod visible;

mod screen;

mod fill;

mod raster;

mod attributes;

pub use attributes::position_at;
pub use raster::{Rasteriser, Sides, visible};
pub use visible::{NOTHING, Seen, Visible};
