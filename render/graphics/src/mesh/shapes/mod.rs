//! Sample models made by code with any number of triangles: for examples, tests and
//! figures.

mod grid;
mod sphere;
mod sweep;
mod still_life;
mod village;
mod named;
mod photograph;

pub use grid::GridSize;
pub use named::SampleModel;
