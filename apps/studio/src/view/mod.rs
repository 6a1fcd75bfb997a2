//! Canvas and palette on the screen: zoom and rotation, uploading of pictures, cursors.

mod transform;
mod mipmap;

#[cfg(feature = "wgpu")]
mod pipeline;
mod texture;
mod quad;

#[cfg(feature = "wgpu")]
mod shader;
mod canvas;
mod fills;

#[cfg(feature = "wgpu")]
mod meshes;
mod picture;
mod outline;
mod head;
mod patch;
mod surface;
mod light_switch;

pub use canvas::{Drawing, fill_rect, set_drawing};
pub use fills::quicken;
pub use head::HeadLines;
#[cfg(feature = "wgpu")]
pub use meshes::{draw_meshes, is_processor};
pub use outline::Outline;
pub use patch::Patch;
pub use picture::{DrawnPart, Picture};
pub use surface::{DragMode, Split, SurfaceView};
pub use transform::{Placement, ViewState};
