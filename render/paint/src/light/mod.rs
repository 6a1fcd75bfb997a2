//! A light for painting: eight wavelengths that stand for its spectrum, and
//! mixing two paints under it.

mod mixer;

mod studio;

pub use mixer::Mixer;
pub use studio::{Light, LightFailure};
