//! Triangle meshes: what they are, files they come from, shapes made here.

mod model;

mod shapes;

pub use model::{Material, Mesh, Texture, Triangle};
pub use shapes::Cells;
