//! Start here: pictures and paintings of a scene with its volumes.

mod error;
mod in_sight;
mod films;
mod drawer;
mod parts_apart;
mod volume_painter;
mod stages;
mod subject;

#[cfg(test)]
mod tests;

pub use error::PaintingError;
pub use films::{CELL_MM, VolumePigments};
pub use paint::technique::Stage;
pub use stages::{Show, ShowError};
pub use subject::{Subject, View};
pub use volume_painter::VolumePainter;
