//! Triangle meshes: what they are, files they come from, shapes made here.

mod model;

mod weld;

mod check;

mod normals;

mod file;

mod shapes;

pub use check::MeshFault;
pub use file::MeshError;
pub use model::{Material, Mesh, Texture, Triangle};
pub use shapes::{Cells, Shape};
