//! The grid that paint spreads over: the surface of the scene in samples, the cells that hold it,
//! which of them are joined by surface, and paint that spills from one to the next.
//!
//! Modules are declared in order of dependence: each uses only those above it.

mod fault;
mod lattice;
mod samples;
mod cells;
mod entering;
mod pieces;
mod bodies;
mod graph;
mod reach;
mod spill;
mod grid;
mod spill_on_device;

pub use bodies::Bodies;
pub use cells::{Cells, MOST_FILMS, QUANTA_PER_FACE};
pub use fault::{MOST_CELLS, WettingError};
pub use graph::Graph;
pub use grid::Grid;
pub use lattice::Lattice;
pub use reach::Reach;
pub use samples::{SAMPLES_PER_CELL, SurfaceSamples};
pub use spill::{Birth, FASTEST_RATE, Spilling};
pub use spill_on_device::DeviceSpilling;

pub(crate) use spill_on_device::SPILL;

#[cfg(test)]
mod tests;

#[cfg(test)]
mod joining_tests;
