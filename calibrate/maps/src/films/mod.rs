//! Films of paint in the bands of a scan: K and S, noise, and the arithmetic of one pixel.

pub mod bands;
pub(crate) mod paints;
pub(crate) mod noise;
pub(crate) mod ground;
pub(crate) mod settings;
pub(crate) mod vectors;
pub(crate) mod whitening;
pub(crate) mod film;

#[cfg(test)]
mod film_tests;
