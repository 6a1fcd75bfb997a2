//! A painting at work: a backend, brushes, the light, and undo.
//!
//! Everything that changes paint, layers or light is an action, which undo takes
//! back whole. One is done at a time: while a stroke is open
//! ([`Painting::begin_stroke`]) every other one, undo and redo too, panics;
//! reading paint and pictures is always allowed, and shows the stroke as far as
//! it is.

mod views;

mod state;

mod failure;

mod brushes;

mod strokes;

mod tubes;

mod layers;

mod undoing;

mod lights;

mod showing;

mod merging;

mod sharing;

pub use brushes::Brush;
pub use failure::PaintingError;
pub use layers::LayerRef;
pub use merging::MERGE_TOLERANCE;
pub use state::{DryLayerState, Painting, State, UNDO_BYTES};
pub use strokes::StrokeReport;
