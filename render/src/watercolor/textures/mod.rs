//! What pigment, water and paper look like: fields that change density.
//!
//! All are made with the processor, from seeds or pictures, once; values lie in 0..1
//! about a mean of 0.5.

mod flow;

mod dispersion;

mod paper;

mod set;

pub use dispersion::dispersion;
pub use flow::turbulent_flow;
pub use paper::{PaperTexture, PaperTextureError};
pub use set::{PaperImage, TextureImages, Textures};
