//! Films of paint in the bands of a scan: K and S, noise, and the arithmetic of one pixel.

pub mod bands;
pub(crate) mod settings;
pub(crate) mod whitening;
pub(crate) mod film;
