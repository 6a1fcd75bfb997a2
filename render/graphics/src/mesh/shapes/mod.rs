//! Models made here, of any number of triangles: for samples, tests and figures.

mod grid;

mod round;

mod turned;

mod still_life;

mod village;

mod named;

pub use grid::Cells;
pub use named::Shape;
