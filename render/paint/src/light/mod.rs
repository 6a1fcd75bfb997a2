//! Light for painting: eight wavelengths that represent a light's spectrum, and mixing of
//! two paints under it.

mod kept;
mod node_light;
mod mixer;

pub use mixer::Mixer;
pub use node_light::{Light, PaintLightError};
