//! Reflectance out of counts: a sample, a white of known reflectance, and the dark.

mod error;

mod integration_time;

mod saturation;

mod reference;

pub use error::ReferencingError;
pub use integration_time::integration_time_ms;
pub use reference::{Dark, Referencing, Tile};
