//! A painting at work: a backend, brushes, the light, and undo.

mod state;

mod failure;

mod brushes;

mod strokes;

mod layers;

mod undoing;

mod showing;

mod merging;

pub use brushes::Brush;
pub use failure::PaintingError;
pub use layers::Coating;
pub use merging::MERGE_TOLERANCE;
pub use state::{DryState, Painting, State, UNDO_BYTES};
pub use strokes::StrokeReport;
