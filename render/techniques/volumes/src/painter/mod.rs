//! Start here: pictures and paintings of a scene with its volumes.

mod error;
mod in_sight;
mod films;
mod drawer;
mod parts_apart;
mod volume_painter;
mod stages;

#[cfg(test)]
mod tests;

pub use error::PaintingError;
pub use films::{CELL_MM, VolumePigments};
pub use stages::{Show, ShowError, Stage};
pub use volume_painter::VolumePainter;
