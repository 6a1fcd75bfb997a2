//! From where a mesh is seen.

mod perspective;

mod framing;

pub use framing::Framing;
pub use perspective::Camera;
