//! Reflectance from counts: a sample, a white of known reflectance, and the dark.

mod error;
mod integration_time;
mod saturation;
mod tile;
mod reading;
mod reference;
mod files;

pub use error::ReferencingError;
pub use files::{DarkFiles, OpenedReferences, ReferenceFiles, ReferenceFilesError, TileSource};
pub use integration_time::integration_time_ms;
pub use reference::Referencing;
pub use tile::{Dark, Tile};
