//! Perspective cameras: single ones, those that frame a model, and paths through
//! keyframes.

mod perspective;

mod framing;

mod path;

pub use framing::Framing;
pub use path::{CameraPath, CameraPathError, Keyframe};
pub use perspective::Camera;
