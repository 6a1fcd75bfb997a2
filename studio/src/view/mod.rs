//! Canvas and palette on the screen: zoom and rotation, uploading of pictures, cursors.

mod transform;

mod mipmap;

mod pipeline;

mod quad;

mod fills;

mod meshes;

mod picture;

mod outline;

mod head;

mod patch;

mod surface;

mod light_switch;

pub use fills::quicken;
pub use head::HeadLines;
pub use meshes::{draw_meshes, is_processor};
pub use outline::Outline;
pub use patch::Patch;
pub use picture::{DrawnPart, Picture};
pub use quad::fill_rect;
pub use quad::set_format;
pub use surface::{DragMode, Split, SurfaceView};
pub use transform::{Placement, ViewState};
