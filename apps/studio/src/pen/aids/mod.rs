//! Drawing aids as data: a ruler and a perspective guide that lead strokes, and symmetry that
//! repeats them. Positions are in mm of the canvas.

mod place;
mod course;
mod ruler;
mod perspective;
mod symmetry;
mod settings;
mod handles;
mod lines;
mod lead;

pub use handles::AidHandle;
pub(super) use lead::Lead;
pub use lines::AidLines;
pub use perspective::Perspective;
pub use ruler::{Ruler, RulerShape};
pub use settings::{DrawingAids, Guide, GuideKind};
pub use symmetry::{Symmetry, SymmetryKind, Twin};
