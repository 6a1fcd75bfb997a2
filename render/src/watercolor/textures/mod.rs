//! Textures of pigment, water and paper, which change the density of paint.
//!
//! The processor computes them once, from seeds or scans. Values lie in 0..1 with a mean of
//! about 0.5.

mod flow;

mod dispersion;

mod paper;

mod set;

pub use dispersion::dispersion;
pub use flow::turbulent_flow;
pub use paper::{PaperTexture, PaperTextureError};
pub use set::{PaperImage, TextureImages, Textures};
