//! Timelapse of a script: its canvas at chosen moments, as GIF, animated PNG, or a folder of frames.
//!
//! A [`Timelapse`] is the plan of the moments. [`Timelapse::play`] plays the script and hands out
//! the frames; [`Timelapse::write`] keeps them in a folder, from which an interrupted run
//! continues, and joins them to one file. The same script gives the same frames.

mod error;
mod settings;
mod kept;
mod moments;
mod plan;
mod write;

#[cfg(test)]
mod tests;

pub use error::TimelapseError;
pub use plan::Timelapse;
pub use settings::{Interval, TimelapseSettings};
pub use write::TimelapseFiles;
