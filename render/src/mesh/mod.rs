//! Triangle meshes: what they are, files they come from, shapes made here.

mod model;

pub use model::{Material, Mesh, Texture, Triangle};
