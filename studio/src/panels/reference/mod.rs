//! A picture pinned beside the canvas.

mod picture;

mod placing;

mod panel;

pub use panel::Reference;
