//! Pigment maps of spectral scans: which measured pigments are where, how much, and how sure.

mod numbers;

mod zarr;

pub mod pixel_maps;

pub mod cube;

pub mod store;

pub mod blocks;

pub mod pictures;

pub use blocks::map_cube;
pub use cube::Cube;
pub use store::{MapStore, StoredMaps};
