//! The settings of paint volumes, and their TOML files.

mod setting;
mod motion;
mod grid;
mod drawing;
mod picture;
mod shells;
mod whole;
mod documented;
mod preset;
mod error;
mod file;
mod change;

#[cfg(test)]
mod tests;

pub use drawing::{DrawingTable, HatchingTable, StrokesAlong};
pub use error::SettingsError;
pub use grid::GridTable;
pub use motion::MotionTable;
pub use picture::{GreyTable, LightTable, LightWith, PictureTable};
pub use preset::Preset;
pub use setting::{Setting, Takes};
pub use shells::even_tints;
pub use whole::Settings;

pub(crate) use shells::check_shells;

// The words of some settings are those of the modules that do the work.
pub use crate::drawing::{GreyWeights, MOST_SHELLS};
pub use crate::pigments::{FilmKind as Film, InsidePaint as Inside, UnderPainting as Under};
