//! Watercolor of calibrated pigments: each colour a glaze over measured paper.
//!
//! Instead of changing colours, density changes how thick a glaze is, so that
//! granulation, dark edges and overlaid washes are those of Kubelka and Munk; the
//! result is a painting that can be lit anew.

mod thickness;

mod glazes;

pub use glazes::{GlazeError, Glazes};
pub use thickness::thickness;
