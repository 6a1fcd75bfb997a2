//! The grid that paint spreads over: the surface of the scene in samples, the cells that hold it,
//! which of them are joined by surface, and paint that spills from one to the next.
//!
//! Modules are declared in order of dependence: each uses only those above it.

mod fault;

mod lattice;

mod samples;

pub use fault::WettingError;
pub use lattice::Lattice;
pub use samples::{SAMPLES_PER_CELL, SurfaceSamples};
