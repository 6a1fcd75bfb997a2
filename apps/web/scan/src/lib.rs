//! The native part of the panel "Scan": the crate `maps` over slices of files that the browser holds. It is a
//! module of its own, which only those load who open the panel, and runs in a worker: only there is a slice of a
//! file read at once.
//!
//! Errors reach the page as the crate `told` says.

mod failure;
mod slices;
mod options;
mod mapped;
mod scan;

pub use mapped::Mapped;
pub use scan::Scan;
pub use told::begin;
