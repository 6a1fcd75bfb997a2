//! Watercolor of calibrated pigments: each colour a glaze over measured paper.
//!
//! Each pixel has the glaze whose colour comes nearest to that of the effects (Kubelka and
//! Munk), so that granulation, dark edges and the dry brush stay. The result is a painting
//! that can be relit.

mod glazes;
mod glaze_painter;

pub use glaze_painter::GlazePainter;
pub use glazes::{GlazeError, Glazes};
