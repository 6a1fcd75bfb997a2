//! Plays a script on a world, step by step.

mod error;
mod player;

#[cfg(test)]
mod tests;

pub use error::PerformanceError;
pub use player::{FirstView, Performance, place_seen};
