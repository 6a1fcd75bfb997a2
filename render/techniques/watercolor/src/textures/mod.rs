//! Textures of pigment, water and paper, which change the density of paint.
//!
//! The processor computes them once, from seeds or scans. Values lie in 0..1 with a mean of
//! about 0.5.

mod flow;
mod dispersion;
mod back_runs;
mod quantiles;
mod paper;
mod brush_touch;
mod set;

pub use back_runs::back_runs;
pub use brush_touch::BrushTouch;
pub use dispersion::dispersion;
pub use flow::turbulent_flow;
pub use paper::{FineHeights, PaperTexture, PaperTextureError};
pub use quantiles::Quantiles;
pub use set::{PaperImage, TextureImages, Textures};
