//! Models made here, of any number of triangles: for samples, tests and figures.

mod grid;

mod round;

pub use grid::Cells;
