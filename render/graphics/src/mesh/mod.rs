//! Triangle meshes: the model, checks and normals, curvature and fields of directions. You read
//! them from files (OBJ, glTF, PLY) or take a sample model made by code.

mod model;
mod curvature;
mod directions;
mod file;
mod shapes;

#[cfg(test)]
mod test_shapes;

pub use curvature::Curvature;
pub use directions::{
    Along, DirectionFault, DirectionField, DirectionSettings, FlowField, Guide, Line,
};
pub use file::{MeshError, ModelFile};
pub use model::{Material, Mesh, MeshFault, Texture, Triangle};
pub use shapes::{GridSize, SampleModel};
