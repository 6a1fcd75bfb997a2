//! The native part of the calibration page. It passes names, bytes and JSON to the libraries, and
//! reports errors as the crate `told` describes. The page itself is in `../page`.

mod failure;
mod remarks;
mod counts;
mod readings;
mod library;
mod fitting;
mod targets;
mod matching;
mod lab;

pub use fitting::Fit;
pub use lab::plan;
pub use library::Library;
pub use readings::{Readings, formats};
pub use targets::Targets;
pub use told::begin;
