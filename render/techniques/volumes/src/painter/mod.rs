//! The front door: pictures and paintings of a scene with its volumes.

mod error;
mod averaged;
mod looks;
mod in_sight;
mod loaded_scene;
mod region_counts;
mod films;
mod parts;
mod drawer;
mod parts_apart;
mod volume_painter;
mod shown;
mod passes;
mod stages;

#[cfg(test)]
mod tests;

#[cfg(test)]
mod bodies_tests;

pub use error::PaintingError;
pub use films::{CELL_MM, VolumePigments};
pub use shown::{Show, ShowError};
pub use stages::Stage;
pub use volume_painter::VolumePainter;
