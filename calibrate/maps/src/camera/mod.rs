//! A simulated camera: scans of scenes whose exact spectra are known, for trials of maps.
//!
//! ```text
//! exact spectra --> varied surface --> blur --> bands --> drift of the white --> noise
//! ```
//!
//! Every number is drawn from a seed by the place of the pixel, so that a scan has the same values in
//! blocks of any size.

mod settings;
mod surface_variation;
mod blur;
mod bands;
mod sensor;
mod scan;

pub use blur::Blur;
pub use scan::{Camera, Scene, SimulatedRows};
pub use sensor::Sensor;
pub use settings::{CameraError, CameraSettings};
pub use surface_variation::SurfaceVariation;
