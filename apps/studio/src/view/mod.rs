//! Canvas and palette on the screen: zoom and rotation, uploading of pictures, cursors.

mod transform;
mod mipmap;

#[cfg(feature = "wgpu")]
mod pipeline;
mod texture;
mod canvas;

#[cfg(feature = "wgpu")]
mod meshes;
mod picture;
mod outline;
mod surface;

pub use canvas::{Drawing, fill_rect, quicken, set_drawing};
#[cfg(feature = "wgpu")]
pub use meshes::{draw_meshes, is_processor};
pub use outline::{HeadLines, Outline};
pub use picture::{DrawnPart, Picture};
pub use surface::{DragMode, Patch, Split, SurfaceView};
pub use transform::{Placement, ViewState};
