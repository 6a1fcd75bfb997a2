//! What of a mesh is seen, pixel by pixel.

mod visible;

mod packed;

mod screen;

mod fill;

mod raster;

mod attributes;

pub use attributes::{Facet, position_at};
pub use packed::{Coating, PackedMesh, Placed, Vertex};
pub use raster::{RASTER, Rasteriser, Sides, View, visible};
pub use visible::{NOTHING, Seen, Visible};
