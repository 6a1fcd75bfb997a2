//! Triangle meshes: the model, checks and normals, curvature and fields of directions, files (OBJ,
//! glTF, PLY) and sample models made by code.

mod model;
mod weld;
mod check;
mod neighbours;
mod closed_parts;
mod normals;
mod places;
mod tangent_plane;
mod shape_tensor;
mod curvature;
mod directions;
mod file;
mod shapes;

#[cfg(test)]
mod test_shapes;

pub use check::MeshFault;
pub use curvature::Curvature;
pub use directions::{
    Along, DirectionFault, DirectionField, DirectionSettings, FlowField, Guide, Line,
};
pub use file::MeshError;
pub use model::{Material, Mesh, Texture, Triangle};
pub use shapes::{GridSize, SampleModel};
