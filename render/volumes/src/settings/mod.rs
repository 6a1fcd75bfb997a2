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

pub use drawing::{DrawingTable, Film, HatchingTable, Inside, StrokesAlong, Under};
pub use error::SettingsError;
pub use grid::GridTable;
pub use motion::MotionTable;
pub use picture::{GreyTable, GreyWeights, LightTable, LightWith, PictureTable};
pub use preset::Preset;
pub use setting::{Setting, Takes};
pub use shells::{MOST_SHELLS, even_tints};
pub use whole::Settings;

pub(crate) use shells::check_shells;
