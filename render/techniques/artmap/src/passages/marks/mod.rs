//! Marks: lines and rectangles by which a painter says where the samples of a picture are.
//!
//! They are written in a TOML file:
//!
//! ```toml
//! painting = "orchard.png"
//!
//! [[sample]]
//! name = "sky"
//! scribble = [[40, 32], [180, 60], [240, 58]]
//! spacing = [[90, 40], [92, 52]]
//!
//! [[sample]]
//! name = "grass"
//! rectangle = [20, 300, 120, 90]
//! ```
//!
//! Places are pixels from the upper left corner of the picture, which may be fractions. `spacing`
//! holds two points one stroke apart. A picture of coloured lines over the painting does as well
//! ([`Marks::from_overlay`]).

mod mark;
mod error;
mod drawn;
mod text;
mod overlay;

pub(super) use drawn::DrawnArea;
pub use error::{MarkFault, MarksError};
pub use mark::{Mark, MarkedArea, Marks};
