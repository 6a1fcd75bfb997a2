//! Brush heads: bending spines that carry a surface with paint on it.
//!
//! As in Baxter, Wendt and Lin 2004, section 3, and Baxter et al. 2001 ("DAB:
//! interactive haptic painting with 3D virtual brushes"): a skeleton of masses
//! and springs, and around it a subdivision surface. Each sub-step the surface
//! gives one [`Contact`](super::contact::Contact).

mod vector;

mod shape;

mod relief;

mod grip;

mod spines;

mod net;

mod surface;

mod mesh;

mod footprint;

mod head;

pub use head::{BrushError, Head};
pub use mesh::HeadMesh;
pub use relief::{BLOCK, Relief};
pub use shape::{HeadShape, UnknownShape};

#[cfg(test)]
mod tests;
