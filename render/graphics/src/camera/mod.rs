//! From where a mesh is seen.

mod perspective;

mod framing;

mod path;

pub use framing::Framing;
pub use path::{CameraPath, CameraPathError, Keyframe};
pub use perspective::Camera;
