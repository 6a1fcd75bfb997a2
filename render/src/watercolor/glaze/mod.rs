//! Watercolor of calibrated pigments: each colour a glaze over measured paper.
//!
//! Density does not change colours here but the thickness of a glaze, so that granulation,
//! dark edges and overlaid washes follow Kubelka and Munk. The result is a painting that
//! can be relit.

mod thickness;

mod glazes;

mod glaze_painter;

pub use glaze_painter::GlazePainter;
pub use glazes::{GlazeError, Glazes};
pub use thickness::thickness;
