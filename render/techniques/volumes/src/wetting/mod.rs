//! The grid that paint spreads over: the surface of the scene in samples, the cells that hold it,
//! which of them are joined by surface, and paint that spills from one to the next.
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
