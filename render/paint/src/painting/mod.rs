//! A painting while it is worked on: an engine, brushes, lights and undo. In a session it is one
//! of two surfaces.
//!
//! Every change of paint, layers or light is an action, which one undo takes back. Only one
//! action is open at a time: while a stroke is open ([`OpenStroke`]), all others panic,
//! undo and redo included. Paint and pictures can always be read, and show the stroke as far
//! as it is painted.

mod failure;
mod views;
mod state;
mod tip_load;
mod open_stroke;
mod brushes;
mod actions;

pub use actions::MERGE_TOLERANCE;
pub(crate) use brushes::check_load;
pub use failure::PaintingError;
pub use open_stroke::{OpenStroke, StrokeReport, TakenPaint};
pub use state::{Brush, Painting, State, UNDO_BYTES};
pub use tip_load::TipLoad;

#[cfg(test)]
mod tests;
