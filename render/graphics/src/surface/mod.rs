//! The visible surface of a mesh, pixel by pixel.
//!
//! [`Model`] holds a mesh in the memory of a [`crate::compute::Compute`] and draws it into
//! a [`VisibilityBuffer`]; [`SurfacePoint`] then interpolates position, normal and
//! colour where a pixel shows the mesh.

mod visibility;
mod packed;
mod screen;
mod fill;
mod bands;
mod raster;
mod surface_point;
mod four_points;
mod model;
mod inside;

pub use bands::Sides;
pub use four_points::{FourPoints, FourVectors, dot_products};
pub use inside::{
    ADD_STENCIL, ClosedSurfaces, Count, Crossing, CrossingSum, Crossings, GATED_FACES, Gates,
    InsideCounter, STENCIL_FACES, WEIGHED_FACES, WeighedCount,
};
pub use model::{DeviceModel, HostModel, Model};
pub use packed::{PackedMaterial, PackedMesh, Positioned, Vertex};
pub use raster::{RASTER, RasterParams, Rasteriser, visible};
pub use surface_point::{SurfacePoint, position_at};
pub use visibility::{Fragment, NO_TRIANGLE, VisibilityBuffer};
