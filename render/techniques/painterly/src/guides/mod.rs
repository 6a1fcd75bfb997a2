//! Guides: lines drawn by hand along which strokes run, over a view of a model or over a picture.
//!
//! They are written in a TOML file:
//!
//! ```toml
//! picture = "view.png"
//! size_px = [800, 600]
//! camera = [30.0, 20.0, 30.0]
//!
//! [[guide]]
//! points = [[10, 20], [40, 25], [90, 60]]
//! ```
//!
//! Places are pixels from the upper left corner of a picture of `size_px`, which may be fractions.
//! Strokes run along a line; what flows, flows from its first point to its last. `camera` belongs
//! to views of models: degrees around the model, above the horizon, and of the field of view.

mod error;
mod lines;
mod text;
mod walk;
mod on_mesh;
mod on_picture;

pub use error::{GuideFault, GuidesError};
pub use lines::Guides;
pub use on_picture::GuideSample;
