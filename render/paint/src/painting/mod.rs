//! A painting while it is worked on: an engine, brushes, lights and undo.
//!
//! Every change of paint, layers or light is an action, which one undo takes back. Only one
//! action is open at a time: while a stroke is open ([`OpenStroke`]), all others panic,
//! undo and redo included. Paint and pictures can always be read, and show the stroke as far
//! as it is painted.

mod failure;
mod layer_ref;
mod views;
mod state;
mod undo;
mod brushes;
mod tip_load;
mod batch;
mod taken;
mod clean_head;
mod open_stroke;
mod strokes;
mod heaps;
mod layers;
mod stack;
mod merging;
mod masking;
mod lights;
mod pictures;

#[cfg(test)]
mod layer_tests;

pub use failure::PaintingError;
pub use layer_ref::LayerRef;
pub use masking::MaskChange;
pub use merging::MERGE_TOLERANCE;
pub use open_stroke::{OpenStroke, StrokeReport};
pub use state::{Brush, DryLayerState, Painting, State, UNDO_BYTES};
pub use taken::TakenPaint;
pub use tip_load::TipLoad;

#[cfg(test)]
mod tests;
