//! The window of the pen: pressure curve with a test field, stabiliser, and options of single
//! brushes.

mod curve_editor;
mod field;
mod rows;
mod window;

pub use window::{PenContext, PenWindow};
