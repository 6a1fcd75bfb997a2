//! A script played on a world, step by step.

mod error;
mod picked;
mod settings;
mod player;
mod saved;

#[cfg(test)]
mod tests;

pub use error::PerformanceError;
pub use picked::{FirstView, place_seen};
pub use player::Performance;
