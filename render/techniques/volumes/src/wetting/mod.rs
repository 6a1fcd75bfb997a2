//! The grid over which paint spreads. It has the surface of the scene in samples, and the cells
//! that hold this surface. It knows which cells are joined by surface, and spills paint from one
//! to the next.
//!
//! Modules are declared in order of dependence: each uses only those above it.
mod lattice;
mod samples;
mod pieces;
mod graph;
mod grid;
mod spill;
mod spill_on_device;
#[cfg(test)]
mod tests;

pub use graph::Graph;
pub use grid::{Cells, Grid, MOST_FILMS, QUANTA_PER_FACE, Reach};
pub use lattice::{Lattice, MOST_CELLS, WettingError};
pub use pieces::Bodies;
pub use samples::{SAMPLES_PER_CELL, SurfaceSamples};
pub use spill::{Birth, FASTEST_RATE, Spilling};
pub use spill_on_device::DeviceSpilling;

pub(crate) use spill_on_device::SPILL;
