//! Brush heads: bending spines that carry a surface with paint on it.
//!
//! As in Baxter, Wendt and Lin 2004, section 3, and Baxter et al. 2001 ("DAB:
//! interactive haptic painting with 3D virtual brushes"), a head is a skeleton and around it a
//! subdivision surface; the skeleton is laid on the canvas in equilibrium, without masses and
//! springs. Each sub-step the surface gives one [`Contact`](super::contact::Contact).

mod error;
mod vector;
mod b_spline;
mod shape;
mod relief;
mod grip;
mod hair;
mod spines;
mod net;
mod surface;
mod mesh;
mod locks;
mod uptake;
mod sides;
mod footprint;
mod imprint;
mod head;
mod tool;
mod tool_contact;
mod side_by_side;
mod mark;

pub use error::BrushError;
pub use head::Head;
pub use mark::ContactMark;
pub use mesh::HeadMesh;
pub use relief::{BLOCK, Relief};
pub use shape::{HeadShape, UnknownShape};
pub(crate) use side_by_side::SideBySide;
pub use tool::{StrokeTool, ToolError};

#[cfg(test)]
mod tests;

#[cfg(test)]
mod mark_tests;
