//! The reference picture beside the canvas.

mod picture;

mod picture_view;

mod panel;

pub use panel::Reference;
