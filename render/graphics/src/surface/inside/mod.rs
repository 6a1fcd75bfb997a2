//! The closed surfaces that hold each visible point, by counting faces behind it (z-fail, as
//! for shadow volumes: Crow 1977, Heidmann 1991, Everitt and Kilgard 2002).
//!
//! Of every closed surface each face that covers a pixel at or behind the point seen there
//! adds +1 if it faces away and -1 if it faces the eye. The sum is the number of surfaces
//! that hold the point, wherever the eye stands: faces that the near plane cuts off lie
//! before the point and never count, and there is no far plane for them.
//!
//! Vertices are rounded to the 256th of a pixel and every pixel belongs to one of two faces
//! that share an edge, so the faces of a closed surface sum to 0 over every pixel: there are
//! no cracks. Surfaces may overlap; each must be closed, without self-intersections, its
//! faces counter-clockwise seen from outside.

mod surfaces;
mod crossing;
mod gates;
mod sum;
mod on_device;
mod counter;

#[cfg(test)]
mod tests;

pub use counter::InsideCounter;
pub use crossing::{Count, Crossing, CrossingSum, WeighedCount};
pub use gates::Gates;
pub use on_device::{ADD_STENCIL, GATED_FACES, STENCIL_FACES, WEIGHED_FACES};
pub use sum::Crossings;
pub use surfaces::ClosedSurfaces;
