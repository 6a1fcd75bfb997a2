//! Watercolor of calibrated pigments: each colour a glaze over measured paper.
//!
//! Here density changes the thickness of a glaze instead of its colour, so that
//! granulation, dark edges and overlaid washes follow Kubelka and Munk. The result is a
//! painting that can be relit.

mod thickness;

mod glazes;

mod glaze_painter;

pub use glaze_painter::GlazePainter;
pub use glazes::{GlazeError, Glazes};
pub use thickness::thickness;
