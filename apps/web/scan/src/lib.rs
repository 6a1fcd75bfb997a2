//! The native part of the panel "Scan": it runs the crate `maps` on slices of files in the browser,
//! and reports errors as the crate `told` describes. You load this module only when you open the
//! panel. It runs in a worker, because only there a slice of a file can be read synchronously.

mod failure;
mod slices;
mod mapped;
mod scan;
mod points;

pub use mapped::Mapped;
pub use points::identify;
pub use scan::Scan;
pub use told::begin;
