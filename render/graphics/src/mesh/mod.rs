//! Triangle meshes: the model, checks and normals, files (OBJ, glTF, PLY) and sample
//! models made by code.

mod model;

mod weld;

mod check;

mod normals;

mod file;

mod shapes;

pub use check::MeshFault;
pub use file::MeshError;
pub use model::{Material, Mesh, Texture, Triangle};
pub use shapes::{GridSize, SampleModel};
