//! Perspective cameras: single ones, those that frame a model or a picture, and paths through
//! keyframes.

mod perspective;
mod framing;
mod path;
mod picture_view;

pub use framing::Framing;
pub use path::{CameraPath, CameraPathError, Keyframe};
pub use perspective::Camera;
pub use picture_view::PictureView;
