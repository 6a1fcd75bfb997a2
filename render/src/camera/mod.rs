//! From where a mesh is seen.

mod perspective;

pub use perspective::Camera;
