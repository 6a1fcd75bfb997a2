//! The native part of the calibration page: the front doors of the libraries over names, bytes and JSON.
//! The page itself is in `../page`.
//!
//! Errors reach the page as the crate `told` says.

mod failure;
mod remarks;
mod files;
mod counts;
mod readings;
mod library;
mod fitting;
mod targets;
mod matching;
mod report;

pub use fitting::Fit;
pub use library::Library;
pub use readings::{Readings, formats};
pub use targets::Targets;
pub use told::begin;
