//! The front door: pictures and paintings of a scene with its volumes.

mod error;

mod averaged;

mod looks;

mod region_counts;

mod films;

mod drawer;

mod volume_painter;

mod shown;

mod passes;

pub use error::PaintingError;
pub use films::{CELL_MM, VolumePigments};
pub use shown::{Show, ShowError};
pub use volume_painter::VolumePainter;
