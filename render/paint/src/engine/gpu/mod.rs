//! The paint engine on a graphics device. All paint stays in the device's memory and
//! is copied back only when asked for.
//!
//! Calls are recorded and submitted together, when enough have gathered or when
//! something is read.

mod buffers;
mod sub_step;
mod drying;
mod undo_tiles;
mod render;
mod tops;
mod kernels;
mod gpu_paint;
mod mask;

pub use gpu_paint::{GpuPaint, max_canvas_cells};
pub use kernels::kernels;
