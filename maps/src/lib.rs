//! Pigment maps of spectral scans: which measured pigments are where, how much, and how sure.

pub mod pixel_maps;

pub mod cube;
