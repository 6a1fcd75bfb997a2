//! Cropping: a rectangle with handles on the canvas.

mod frame;
mod tool;

pub use tool::{CropAnswer, CropTool};
